"""Rule: CHANGELOG.md has the form of keepachangelog.com: changelog_form.py ROOT

# Changes ─► ## [Unreleased] ─► ## [X.Y.Z] - YYYY-MM-DD, newest first
                            ─► ### Added, Changed, Fixed, Removed ─► one line an entry
"""

from __future__ import annotations

import datetime
import re
import sys
from pathlib import Path

from found import finish, text_of

MAX_COLUMNS = 120
SECTIONS = ["Added", "Changed", "Fixed", "Removed"]
HEADING = re.compile(r"## \[(\d+)\.(\d+)\.(\d+)\] - (\d{4}-\d{2}-\d{2})")


class Form:
    """Reader of the changelog that collects its violations."""

    def __init__(self, lines: list[str]) -> None:
        self.wrong: list[str] = []
        self.releases: list[tuple[int, int, int]] = []
        self.dates: list[str] = []
        self.sections: list[str] = []
        self.entries = 0
        headings = [line for line in lines if line.startswith("## ")]
        if not headings or headings[0] != "## [Unreleased]":
            self.wrong.append("CHANGELOG.md: the first heading is not `## [Unreleased]`")
        for at, line in enumerate(lines, 1):
            if bad := self.look(line, headings):
                self.wrong.append(f"CHANGELOG.md:{at}: {bad}")

    def look(self, line: str, headings: list[str]) -> str:
        if len(line) > MAX_COLUMNS:
            return f"{len(line)} columns, at most {MAX_COLUMNS}"
        if line.startswith("## "):
            return self.release(line, headings)
        if line.startswith("### "):
            return self.section(line[4:])
        if line.startswith("- "):
            self.entries += 1
            if not self.sections:
                return "an entry stands in no section"
            return "an entry ends with a full stop" if line.endswith(".") else ""
        if line.startswith((" ", "\t", "*")):
            return "an entry is one line that begins with `- `"
        return ""

    def release(self, line: str, headings: list[str]) -> str:
        self.sections = []
        if line == "## [Unreleased]":
            return "" if line == headings[0] else "`[Unreleased]` is not on top"
        match = HEADING.fullmatch(line)
        if match is None:
            return f"`{line}` is not `## [X.Y.Z] - YYYY-MM-DD`"
        try:
            datetime.date.fromisoformat(match[4])
        except ValueError:
            return f"{match[4]} is not a day"
        number = (int(match[1]), int(match[2]), int(match[3]))
        older = not self.releases or (number < self.releases[-1] and match[4] <= self.dates[-1])
        self.releases.append(number)
        self.dates.append(match[4])
        return "" if older else "releases are not in order, the newest first"

    def section(self, name: str) -> str:
        if name not in SECTIONS:
            return f"a section is one of {', '.join(SECTIONS)}, not {name}"
        late = bool(self.sections) and SECTIONS.index(name) <= SECTIONS.index(self.sections[-1])
        self.sections.append(name)
        return f"sections come in the order {', '.join(SECTIONS)}, each once" if late else ""


form = Form(text_of(Path(sys.argv[1]) / "CHANGELOG.md").splitlines())
if not form.entries:
    form.wrong.append("CHANGELOG.md: has no entry")
finish(
    form.wrong,
    f"write it after keepachangelog.com: one line of at most {MAX_COLUMNS} columns an entry, as the others",
    f"{form.entries} entries of {len(form.releases)} releases keep their form",
)
