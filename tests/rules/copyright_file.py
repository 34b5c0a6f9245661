"""Rule: packaging/copyright, part of each Debian package, has every licence that requires it: copyright_file.py ROOT

It names the parts of docs/reference/third-party.md that are compiled in or bundled, and the packages of shared
libraries; of bundled parts also a holder. It has the text of each licence that it names, and of no other.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from found import finish, text_of

ROOT = Path(sys.argv[1])
FILE = "packaging/copyright"
PAGE = "docs/reference/third-party.md"
TEXT = text_of(ROOT / FILE)


def stanzas() -> list[dict[str, str]]:
    form = re.compile(r"^([A-Za-z-]+):((?:.*)(?:\n[ \t].*)*)", re.MULTILINE)
    return [{key: value.strip() for key, value in form.findall(each)} for each in re.split(r"\n[ \t]*\n", TEXT)]


def form() -> list[str]:
    """Returns violations of the machine-readable format, and of the rule that each named licence has its text."""
    wrong = []
    first, *others = stanzas()
    if not first.get("Format", "").startswith("https://www.debian.org/doc/packaging-manuals/copyright-format/1.0"):
        wrong.append("does not begin with the Format of DEP-5")
    texts = {
        each["License"].split("\n")[0] for each in others if "Files" not in each and "\n" in each.get("License", "")
    }
    named: set[str] = set()
    for each in others:
        if "Files" in each:
            wrong += [f"Files: {each['Files']} has no {key}" for key in ("Copyright", "License") if not each.get(key)]
            named |= set(re.split(r" and | or ", each.get("License", "").split("\n")[0]))
    wrong += [f"{licence} is named and has no text" for licence in sorted(named - texts)]
    wrong += [f"{licence} has a text and is not named" for licence in sorted(texts - named)]
    return wrong


def has(name: str) -> bool:
    return re.search(rf"(?<![\w/@.-]){re.escape(name)}(?![\w/-]|\.\w)", TEXT) is not None


def holders() -> list[str]:
    """Returns the holders without their parts: `2022 Leon Sorokin` for the line `2022 Leon Sorokin (uplot)`."""
    found = []
    for each in stanzas():
        if "Files" in each:
            lines = each.get("Copyright", "").split("\n")
            found += [re.sub(r" \([^()]*\)$", "", line.strip()) for line in lines]
    return found


def rows() -> list[str]:
    """Returns the parts and holders on the page of all parts that packaging/copyright does not name."""
    wrong = []
    for line in text_of(ROOT / PAGE).splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        names = re.findall(r"`([^`]+)`", line)
        if line.startswith("| `") and "bundled" in cells[3:4][0].split(", "):
            wrong += [f"{name} is bundled into the page and not named" for name in names[:1] if not has(name)]
            licence = ROOT / "hmi/node_modules" / names[0] / "LICENSE"
            if licence.exists() and not any(holder in text_of(licence) for holder in holders()):
                wrong.append(f"{names[0]}: no holder of its licence is named: {licence}")
        elif len(cells) == 7 and "headers" in cells[4].split(", ") and cells[5]:
            inside = re.findall(r"`([^`]+)`", cells[0]) or [cells[5].strip("`/")]
            wrong += [f"{name} is compiled in and not named" for name in inside if not has(name)]
        if len(cells) == 7 and "dynamic" in cells[4].split(", "):
            shared = [name for name in re.findall(r"`([^`]+)`", cells[1]) if not name.endswith("-dev")]
            wrong += [f"{name} is loaded and not named" for name in shared if not has(name)]
    return wrong


found = [f"{FILE}: {each}" for each in form() + rows()]
finish(
    found,
    f"write it into {FILE}: its holder under Files, its licence, the text where it asks for one",
    "every licence is there",
)
