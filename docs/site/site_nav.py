"""Navigation of the site: the sections of docs/README.md, and the pages that it does not name.

The words in bold at the beginning of a paragraph name its section. Words after **How to** name a part of "How to".
"""

from __future__ import annotations

import os
import re

from site_pages import Pages

HEADING = re.compile(r"^\*\*(.+?)\*\*:?(.*)$")
Nav = list[object]


def sections_of(pages: Pages) -> list[tuple[str, str, list[str]]]:
    """Returns name, the words after it, and pages in the site of each section, each page once."""
    sections: list[tuple[str, str, list[str]]] = []
    seen = {"index.md"}
    for line in pages.texts["docs/README.md"].split("\n"):
        heading = HEADING.match(line)
        if heading:
            sections.append((heading[1], heading[2].strip(), []))
        elif line.startswith("[sources/"):
            sections.append(("Sources", "", []))
        for to in re.findall(r"\]\(([^)#\s]+)[^)]*\)", line):
            page = pages.names.get(os.path.normpath(os.path.join("docs", to)))
            if sections and page and page not in seen:
                seen.add(page)
                sections[-1][2].append(page)
    return sections


def part_name(words: str) -> str:
    """Returns the name of a part of "How to", from the words that follow it."""
    name = re.sub(r", each with.*", "", words)
    return name[:1].upper() + name[1:]


def navigation(pages: Pages, cpp: list[str], python: list[str]) -> Nav:
    """Returns the `nav` of mkdocs; titles are those of the pages."""
    groups: dict[str, Nav] = {}
    sections = sections_of(pages)
    for name, words, names in sections:
        part = part_name(words) if name == "How to" else ""
        inside: Nav = [{part: names}] if part else [*names]
        groups.setdefault(name, []).extend(inside)
    named = {page for _, _, names in sections for page in names}
    rest = [page for page in pages.names.values() if page not in named and page != "index.md"]
    examples = [page for page in rest if page.startswith("examples/")]
    others = [page for page in rest if not page.startswith("examples/")]
    groups.setdefault("Reference", []).extend([{"C and C++ headers": cpp}, {"Python": python}])
    first = groups.pop("Start here", [])
    out: Nav = [{"Start": ["index.md", *first]}]
    out += [{name: groups.pop(name)} for name in ("How to", "Explanations", "Reference") if name in groups]
    out.append({"Examples": examples})
    out += [{name: names} for name, names in groups.items()]
    out.append({"Project": others})
    return out
