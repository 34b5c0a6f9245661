"""Pages of the site: the name in the site of each file of the tree, and the targets of its links.

    docs/howto/panel.md            howto/panel.md
    README.md, CONTRIBUTING.md     overview.md, contributing.md
    examples/marking/README.md     examples/marking/index.md
    examples/mcx314/line.cpp       examples/mcx314/line.cpp.md, with its text; where a page links to it
    motionrack/control/move.hpp    its section in the reference, reference/headers/control.md
    tests/docs_test.cpp            a name: sources are in the tree and not in the site
"""

from __future__ import annotations

import os
import re
from pathlib import Path, PurePosixPath

from markdown_dialect import outside_fences, to_python_markdown

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
TOP = {
    "README.md": "overview.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "docs/README.md": "index.md",
}
FOLDERS = ("docs", "examples", "motionrack", "hdl", "bench", "python")
PICTURES = {".svg", ".png"}
LANGUAGES = {
    ".cpp": "cpp",
    ".hpp": "cpp",
    ".c": "c",
    ".h": "c",
    ".toml": "toml",
    ".ngc": "text",
    ".py": "python",
    ".pas": "pascal",
    ".sv": "systemverilog",
    ".xml": "xml",
}


def site_name(path: str) -> str:
    """Returns the name in the site of a Markdown file of the tree."""
    if path in TOP:
        return TOP[path]
    name = PurePosixPath(path.removeprefix("docs/"))
    return str(name.with_name("index.md") if name.name == "README.md" else name)


def title_of(text: str) -> str:
    found = re.search(r"^# (.+)$", text, re.MULTILINE)
    return re.sub(r"[`*]", "", found[1]) if found else ""


def without_repetition(line: str) -> str:
    """Returns a line of an index, without a description that only repeats the title of its link."""
    found = re.fullmatch(r"(- \[([^\]]+)\]\([^)]*\)): (.*)", line)
    return found[1] if found and found[2].lower() == found[3].lower() else line


class Pages:
    """Pages of the site that are made of Markdown files of the tree."""

    def __init__(self, source: Path, headers: dict[str, str]) -> None:
        """Reads the files. `headers`: page and anchor of each header in the reference."""
        self.source = source
        self.headers = headers
        found = [source / name for name in TOP if "/" not in name]
        for folder in FOLDERS:
            found += sorted((source / folder).rglob("*.md"))
        paths = [path.relative_to(source).as_posix() for path in found if "node_modules" not in path.parts]
        self.texts = {path: (source / path).read_text() for path in paths}
        self.names = {path: site_name(path) for path in paths}
        self.titles = {path: title_of(text) for path, text in self.texts.items()}
        self.shown: set[str] = set()  # sources of examples, and LICENSE, if a page links to them
        self.pictures: set[str] = set()

    def write(self, target: Path) -> None:
        """Writes all pages, the sources that they link to, and the pictures."""
        for path, text in self.texts.items():
            name = self.names[path]
            self.put(target / name, to_python_markdown(self.with_links(path, name, text)))
        for path in sorted(self.shown):
            text = (self.source / path).read_text()
            fence = "`" * (3 + max((len(run) for run in re.findall(r"`{3,}", text)), default=0))
            language = LANGUAGES.get(Path(path).suffix, "text")
            self.put(target / f"{path}.md", f"# {Path(path).name}\n\n`{path}`\n\n{fence}{language}\n{text}{fence}\n")
        for path in sorted(self.pictures):
            to = target / path.removeprefix("docs/")
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_bytes((self.source / path).read_bytes())

    @staticmethod
    def put(path: Path, text: str) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def with_links(self, path: str, name: str, text: str) -> str:
        def replaced(found: re.Match[str]) -> str:
            return self.link(path, name, found)

        lines = []
        for line, prose in outside_fences(text):
            code = not prose or (line.startswith("    ") and "](" not in line)
            lines.append(line if code else without_repetition(LINK.sub(replaced, line)))
        return "\n".join(lines)

    def link(self, path: str, name: str, found: re.Match[str]) -> str:
        """Returns the link in the site for a link of the page `path`, which is `name` in the site."""
        mark, words, to = found.groups()
        if re.match(r"[a-z]+:", to) or to.startswith("#"):
            return found[0]
        file, _, anchor = to.partition("#")
        wanted = os.path.normpath(os.path.join(os.path.dirname(path), file))
        page = self.page_of(wanted)
        if page is None:
            return f'<span class="source" title="{wanted}">{words}</span>'
        if wanted in self.titles and words in (file, Path(file).name) and self.titles[wanted]:
            words = self.titles[wanted]
        there, _, own_anchor = page.partition("#")
        anchor = anchor or own_anchor
        relative = os.path.relpath(there, os.path.dirname(name) or ".")
        return f"{mark}[{words}]({relative}{'#' if anchor else ''}{anchor})"

    def page_of(self, path: str) -> str | None:
        """Returns the file in the site for a file or folder of the tree; None if it has none."""
        if (self.source / path).is_dir():
            path = f"{path}/README.md" if path != "docs/decisions" else "docs/README.md"
        if path in self.names:
            return self.names[path]
        if path in self.headers:
            return self.headers[path]
        file = self.source / path
        if file.suffix in PICTURES and file.is_file():
            self.pictures.add(path)
            return path.removeprefix("docs/")
        if path == "LICENSE" or (path.startswith("examples/") and file.is_file()):
            self.shown.add(path)
            return f"{path}.md"
        return None
