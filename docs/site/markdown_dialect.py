"""Conversion of the pages from CommonMark, as GitHub shows it, to the dialect of Python-Markdown.

Python-Markdown needs an empty line before a list and a table, and four blanks for each level of a list.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

ITEM = re.compile(r"( *)([-*+]|\d+\.)( +)(?=\S)")
FENCE = re.compile(r" *(```+|~~~+)")


def outside_fences(text: str) -> Iterator[tuple[str, bool]]:
    """Yields each line, and whether it is prose: neither a fence nor inside one."""
    fence = ""
    for line in text.split("\n"):
        mark = FENCE.match(line)
        if fence:
            yield line, False
            if mark and mark[1].startswith(fence) and line.strip() == mark[1]:
                fence = ""
        elif mark:
            fence = mark[1]
            yield line, False
        else:
            yield line, True


def indent_of(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


class Lists:
    """Offsets at which the text of the open list items begins, outermost first."""

    def __init__(self) -> None:
        self.offsets: list[int] = []

    def close_to(self, indent: int) -> None:
        while self.offsets and indent < self.offsets[-1]:
            self.offsets.pop()

    def moved(self, line: str, after_empty: bool) -> str:
        """Returns the line with four blanks for each open item that it belongs to."""
        indent = indent_of(line)
        item = ITEM.match(line)
        if item and (self.offsets or indent < 4):
            self.close_to(indent)
            level = len(self.offsets)
            self.offsets.append(item.end())
            return " " * (4 * level) + line.lstrip(" ")
        if not self.offsets:
            return line
        if after_empty:
            self.close_to(indent)
        elif indent < self.offsets[-1]:
            return line  # continues the paragraph of the item
        deepest = self.offsets[-1] if self.offsets else 0
        return " " * (4 * len(self.offsets) + max(indent - deepest, 0)) + line.lstrip(" ")


def to_python_markdown(text: str) -> str:
    """Returns the page in the dialect of Python-Markdown."""
    out: list[str] = []
    lists = Lists()
    for line, prose in outside_fences(text):
        before = out[-1] if out else ""
        if not line.strip() or (not prose and not lists.offsets):
            out.append(line)
            continue
        in_list = bool(lists.offsets)
        item = prose and ITEM.match(line) is not None and (in_list or indent_of(line) < 4)
        row = prose and line.lstrip().startswith("|")
        begins = (item and not in_list) or (row and not before.lstrip().startswith("|"))
        if begins and before.strip():
            out.append("")
        out.append(lists.moved(line, not before.strip()) if prose else lists.moved(line, False))
    return "\n".join(out)
