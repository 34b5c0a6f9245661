"""Rule: the released files link no library that is under the GPL alone: linked.py ROOT FILE...

    ldd FILE ─► each .so ─► dpkg -S: its package ─► linked_licences.txt: its licence
                                                  └► its copyright file: for a GPL in it, the list has a reason

FILE: the built program, the C libraries, the Python module. Libraries in their folders are the project's own.
A library that a FILE needs directly also has a row in docs/reference/third-party.md.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

from found import finish, skip, text_of

ROOT = Path(sys.argv[1])
FILES = [Path(each).resolve() for each in sys.argv[2:]]
OWN = {file.parent for file in FILES}
LIST = ROOT / "tests/rules/linked_licences.txt"
PAGE = "docs/reference/third-party.md"
FREE = {
    "Apache-2.0",
    "BSD-2-clause",
    "BSD-3-clause",
    "BSD-4-clause",
    "EPL-2.0",
    "FTL",
    "IJG",
    "MIT",
    "MPL-1.1",
    "OpenLDAP-2.8",
    "Unicode-DFS-2016",
    "Zlib",
    "curl",
    "libpng",
    "public-domain",
    "LGPL-2+",
    "LGPL-2.1",
    "LGPL-2.1+",
    "LGPL-3+",
    "GPL-3+ with GCC Runtime Library Exception 3.1",
}
GPL = re.compile(r"(?<![A-Za-z])A?GPL", re.IGNORECASE)
EXCEPTION = re.compile(r"exception", re.IGNORECASE)


def libraries_of(file: Path) -> set[tuple[Path, str]]:
    """Returns the libraries that the loader finds for a file, each with the name by which it is requested."""
    printed = subprocess.run(["ldd", str(file)], capture_output=True, text=True)
    if printed.returncode != 0:
        skip(f"ldd cannot read {file}: {(printed.stderr or printed.stdout).strip()}")
    found = re.findall(r"(\S+) => (/\S+)", printed.stdout)
    return {(Path(path).resolve(), name) for name, path in found if Path(path).resolve().parent not in OWN}


def asked_by(file: Path) -> set[str]:
    """Returns the names of the libraries that the file needs directly."""
    return set(
        re.findall(
            r"NEEDED\s+(\S+)", subprocess.run(["objdump", "-p", str(file)], capture_output=True, text=True).stdout
        )
    )


def packages_of(libraries: set[Path]) -> dict[Path, str]:
    """Returns the package of each file; the list of a package may have the file without /usr."""
    names = {name: file for file in libraries for name in (str(file), str(file).removeprefix("/usr"))}
    said = subprocess.run(["dpkg", "-S", *sorted(names)], capture_output=True, text=True).stdout
    lines = [line.rpartition(": ") for line in said.splitlines() if not line.startswith("diversion by ")]
    return {names[name]: owner.split(",")[0].split(":")[0] for owner, _, name in lines if name in names}


def gpl_alone(licence: str) -> bool:
    """Returns whether each alternative of a licence is, or contains, a GPL without an exception."""

    def bad(part: str) -> bool:
        return bool(GPL.search(part)) and not EXCEPTION.search(part)

    return all(
        any(bad(part) for part in re.split(r"\s+and\s+|,\s*", way))
        for way in re.split(r"\s+or\s+", licence, flags=re.IGNORECASE)
    )


def gpl_in(package: str) -> list[str]:
    """Returns the parts under the GPL alone in the package's copyright file, without Debian's packaging."""
    text = Path(f"/usr/share/doc/{package}/copyright").read_text(encoding="utf-8", errors="replace")
    if not text.lstrip().lower().startswith("format"):
        plain = " ".join(text.split())
        named = re.findall(r"(\w+) general public licen[cs]e", plain, re.IGNORECASE)
        return [f"{len(named)} sentences"] if any(word.lower() not in ("lesser", "library") for word in named) else []
    found = []
    for stanza in re.split(r"\n[ \t]*\n", text):
        fields = {
            key.lower(): value
            for key, value in re.findall(r"^([A-Za-z-]+):((?:.*)(?:\n[ \t].*)*)", stanza, re.MULTILINE)
        }
        files = [file for file in fields.get("files", "").split() if not file.startswith("debian/")]
        licence = fields.get("license", "").strip().split("\n")[0]
        if files and gpl_alone(licence):
            found.append(f"{licence}: {' '.join(files)[:80]}")
    return found


def listed() -> tuple[dict[str, list[str]], list[str]]:
    rows: dict[str, list[str]] = {}
    wrong = []
    for at, line in enumerate(text_of(LIST).splitlines(), 1):
        if line.startswith("#"):
            continue
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) not in (2, 3) or not all(cells):
            wrong.append(f"{LIST.name}:{at}: is not `package | licence` or `package | licence | reason`")
        elif not any(way in FREE for way in cells[1].split(" or ")):
            wrong.append(f"{LIST.name}:{at}: {cells[0]} is under {cells[1]}, none of {', '.join(sorted(FREE))}")
        else:
            rows[cells[0]] = cells
    return rows, wrong


def main() -> None:
    if not all(shutil.which(tool) for tool in ("dpkg", "ldd", "objdump")):
        skip("this is no Debian: dpkg, ldd or objdump is missing")
    rows, wrong = listed()
    libraries = {library for file in FILES for library in libraries_of(file)}
    asked = {name for file in FILES for name in asked_by(file)}
    page = re.findall(r"`([^`]+)`", text_of(ROOT / PAGE))
    owners = packages_of({library for library, _ in libraries})
    packages = set()
    for library, name in sorted(libraries):
        package = owners.get(library)
        if package is None:
            wrong.append(f"{library}: came with no Debian package")
            continue
        packages.add(package)
        if name in asked and package not in page:
            wrong.append(f"{package}: is linked as {name} and not in {PAGE}")
    for package in sorted(packages):
        if package not in rows:
            wrong.append(f"{package}: is linked and not in {LIST.name}")
        elif len(rows[package]) < 3 and (inside := gpl_in(package)):
            wrong.append(f"{package}: {LIST.name} does not say why this is not the library's: {'; '.join(inside)}")
    finish(
        wrong,
        f"read /usr/share/doc/PACKAGE/copyright: add its row to tests/rules/{LIST.name} and to {PAGE}; "
        "a library under the GPL alone is not linked, choose another one",
        f"{len(libraries)} libraries of {len(packages)} packages, none under the GPL alone",
    )


main()
