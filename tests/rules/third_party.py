"""Rule: docs/reference/third-party.md has every third-party part: third_party.py ROOT

Parts are the packages and modules of CMake, the listed Debian packages, the dependencies of the operator panel, the
headers that C++ includes and the modules that Python imports. The installed version begins with the one on the page.
"""

from __future__ import annotations

import ast
import json
import re
import subprocess
import sys
from pathlib import Path

from found import files_of, finish, text_of

ROOT = Path(sys.argv[1])
PAGE = "docs/reference/third-party.md"
FILES = files_of(ROOT)
HOW = {"dynamic", "headers", "bundled", "loaded", "tool"}
MADE = {"sample.h", "rtc5sim_cards.h"}  # made by idlc and CMake in the build folder
# Headers that need no row on the page: those of Linux and POSIX in these folders, the listed ones of C, POSIX and the
# compiler, and those of C++, whose names have neither a folder nor an ending.
SYSTEM = re.compile(
    r"(sys|linux|netinet|arpa)/.*"
    r"|(dlfcn|errno|fcntl|immintrin|math|poll|sched|std\w+|string|termios|ucontext|unistd)\.h|\w+"
)


class Page:
    """Rows of all tables on the page, cells by the heading of their column; names are in backquotes."""

    def __init__(self) -> None:
        self.rows: list[dict[str, str]] = []
        heads: list[str] = []
        for line in text_of(ROOT / PAGE).splitlines():
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if not line.startswith("|"):
                heads = []
            elif not heads:
                heads = cells
            elif set(line) - set("|-"):
                self.rows.append(dict(zip(heads, cells)))
        self.names = {name for row in self.rows for key in ("for CMake", "npm") for name in self.code(row, key)}
        self.packages = {name for row in self.rows for name in self.debian(row)}
        self.headers = {name for row in self.rows for name in self.code(row, "headers")}

    @staticmethod
    def code(row: dict[str, str], key: str) -> list[str]:
        return re.findall(r"`([^`]+)`", row.get(key, ""))

    def debian(self, row: dict[str, str]) -> list[str]:
        return self.code(row, "Debian packages") + self.code(row, "Debian package")


def cmake_names() -> set[str]:
    """Returns the packages and modules that the project's own CMake files look for."""
    text = text_of(ROOT / "cmake/dependencies.cmake")
    names = set()
    for variable in ("public_packages", "private_packages", "private_modules", "nats_module", "hdf5_names"):
        listed = re.search(rf"set\(motionrack_{variable}\s+([^)]*)\)", text)
        if listed is None:
            sys.exit(f"cmake/dependencies.cmake has no motionrack_{variable}")
        words = re.findall(r'"([^"]+)"|(\S+)', listed[1])
        found = [re.split(r"[ >=]", quoted or bare)[0] for quoted, bare in words]
        names |= set(found[:1] if variable == "hdf5_names" else found)
    for path in FILES:
        if path.name == "CMakeLists.txt" or path.suffix == ".cmake":
            text = re.sub(r"#.*", "", text_of(ROOT / path))
            names |= set(re.findall(r"find_package\((\w[\w+-]*)", text)) - {"motionrack"}
            for module in re.findall(r"pkg_check_modules\(([^)]*)\)", text):
                names |= {word for word in module.split()[1:] if re.fullmatch(r"[a-z][\w.-]*", word)}
    return names


def debian_names() -> set[str]:
    """Returns the packages that cmake/setup.sh lists or that scripts pass to need_packages."""
    lists = re.findall(r"^\w+_packages=\(([^)]*)\)", text_of(ROOT / "cmake/setup.sh"), re.MULTILINE)
    for path in FILES:
        if path.suffix in ("", ".sh") and "need_packages" in (text := text_of(ROOT / path)):
            lists += re.findall(r"^[^#\n]*need_packages ([a-z][a-z0-9 .+-]*)", text, re.MULTILINE)
    return {word for each in lists for word in each.split() if re.fullmatch(r"[a-z0-9][a-z0-9.+-]+", word)}


def npm_names() -> set[str]:
    own = json.loads(text_of(ROOT / "hmi/package.json"))
    locked = json.loads(text_of(ROOT / "hmi/package-lock.json"))["packages"]
    shipped = {path.split("node_modules/")[-1] for path, each in locked.items() if path and not each.get("dev")}
    return {*own["dependencies"], *own["devDependencies"], *shipped}


def not_on_the_page(page: Page) -> list[str]:
    wrong = [f"CMake looks for {name}" for name in sorted(cmake_names() - page.names)]
    wrong += [f"cmake/setup.sh or a script installs {name}" for name in sorted(debian_names() - page.packages)]
    wrong += [f"hmi/package.json asks for {name}" for name in sorted(npm_names() - page.names)]
    beside = {"/".join(path.parts[at:]) for path in FILES for at in range(len(path.parts))}
    include = re.compile(r"^\s*#\s*include\s*<([^>]+)>", re.MULTILINE)
    modules = {path.stem for path in FILES} | {part for path in FILES for part in path.parts} | {"_core", "_version"}
    for path in FILES:
        if path.suffix in (".cpp", ".hpp", ".h", ".c", ".in"):
            for name in include.findall(text_of(ROOT / path)):
                known = SYSTEM.fullmatch(name) or name in beside or name in MADE
                if not known and not any(name.startswith(header) for header in page.headers):
                    wrong.append(f"{path} includes <{name}>")
        elif path.suffix == ".py":
            for node in ast.walk(ast.parse(text_of(ROOT / path))):
                names = [each.name for each in node.names] if isinstance(node, ast.Import) else []
                if isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                    names = [node.module]
                for top in {name.split(".")[0] for name in names} - modules - sys.stdlib_module_names - page.headers:
                    wrong.append(f"{path} imports {top}")
    return [f"{each}, which {PAGE} does not have" for each in wrong]


def wrong_rows(page: Page) -> list[str]:
    wrong = []
    locked = json.loads(text_of(ROOT / "hmi/package-lock.json"))["packages"]
    there_are = installed(page.packages)
    for row in page.rows:
        name = next(iter(Page.code(row, "npm") + page.debian(row)), "")
        empty = [key for key in row if key not in ("for CMake", "headers") and not row[key]]
        if not name or empty:
            wrong.append(f"{PAGE}: the row of {name or row} has nothing under {', '.join(empty) or 'its name'}")
        how = set(row.get("how", "tool").split(", "))
        if not how <= HOW:
            wrong.append(f"{PAGE}: {name} is used {row['how']}, which is none of {', '.join(sorted(HOW))}")
        says = row.get("version", "")
        if re.fullmatch(r"[\d.~]+", says):
            there = (
                locked.get(f"node_modules/{name}", {}).get("version", "") if "npm" in row else there_are.get(name, "")
            )
            if there and not re.match(re.escape(says) + r"([.~+-]|$)", there):
                wrong.append(f"{PAGE}: {name} is of version {there}, the page says {says}")
    return wrong


def installed(packages: set[str]) -> dict[str, str]:
    """Returns the versions, without epoch, of the Debian packages that are installed; empty on other systems."""
    command = ["dpkg-query", "-W", "-f=${Package} ${Version} ${db:Status-Status}\\n", *sorted(packages)]
    try:
        said = subprocess.run(command, capture_output=True, text=True).stdout
    except FileNotFoundError:
        return {}
    rows = [line.split() for line in said.splitlines() if line.endswith(" installed")]
    return {name: version.split(":")[-1] for name, version, _ in rows}


written = Page()
finish(
    not_on_the_page(written) + wrong_rows(written),
    f"add its row to {PAGE} (licence: /usr/share/doc/PACKAGE/copyright or its package.json) and, where it is compiled "
    "in or bundled, to packaging/copyright",
    f"{len(written.rows)} rows, nothing is missing",
)
