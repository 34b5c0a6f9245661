"""Checks docs/reference/glossary.toml and the page made from it: glossary.py ROOT [--write]

    glossary.toml ──► glossary.md       a word once, with its files and types, which must exist
    headers ──► names of types ──┬──► `types` of a word
                                 └──► plain_names.txt: plain or standard names that need no explanation

A type of motionrack/**/*.hpp is public unless it is in a test or a card's folder, or nested. XSettings and XState need
no entry where X is plain or explained. plain_names.txt only shrinks: --write removes names from it and adds none.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from found import files_of, finish, text_of
from pages import cell, link, stale

ROOT = Path(sys.argv[1])
DATA = Path("docs/reference/glossary.toml")
PAGE = DATA.with_suffix(".md")
PLAIN = Path("tests/rules/plain_names.txt")
HEAD = "# At most {} public types with plain or standard names, which the glossary need not explain. It only shrinks.\n"
REMEDY = "python3 tests/rules/glossary.py . --write"
ELSEWHERE = {
    "linuxcnc": "LinuxCNC",
    "ruckig": "Ruckig",
    "klipper": "Klipper",
    "siemens": "Siemens",
    "heidenhain": "Heidenhain",
    "plcopen": "PLCopen",
    "cia402": "CiA 402",
}
PRINTED = {"de": "German", "cs": "Czech", "sv": "Swedish", "zh": "Chinese"}
KEYS = {"word", "text", "types", "file", *ELSEWHERE, *PRINTED}
SUFFIXES = ("Settings", "State")
TYPE = re.compile(
    r"^(?:template\s*<[^;{}]*>\s*)?(?:struct|class|enum(?: class)?)\s+(?:\[\[\w+\]\]\s*)?([A-Z]\w*)\b"
    r"(?:\s+final)?(?:\s*:(?!:)[^;{]*)?\s*\{",
    re.M,
)
ABOUT = f"""# Glossary
<!-- written by tests/rules/glossary.py from {DATA.name} -->

One word for one thing, in the code, the messages and these pages. *Elsewhere* has the word that others use for it; a
place that is empty says nothing. *In a source* has the word of the card's description, as the scan of it prints it.

"""
COLUMNS = """| word | means | elsewhere | in a source | in the code |
|---|---|---|---|---|
"""

Word = dict[str, Any]


def declarations() -> dict[str, list[Path]]:
    """Maps each type of the headers, except those of tests, to the headers that define it."""
    out = defaultdict(list)
    for file in files_of(ROOT):
        if file.suffix == ".hpp" and file.parts[0] == "motionrack" and "test" not in file.parts:
            for name in set(TYPE.findall(text_of(ROOT / file))):
                out[name].append(file)
    return out


TYPES = declarations()
FILES = {parent for file in files_of(ROOT) for parent in (file, *file.parents)}


def public_headers(name: str) -> list[Path]:
    return [file for file in TYPES.get(name, []) if "cards" not in file.parts]


def headers_of(one: str) -> list[Path]:
    """Returns the headers of a type: NAME, or FOLDER/NAME if several types have the name."""
    folder, _, name = one.rpartition("/")
    if folder:
        return [file for file in TYPES.get(name, []) if f"/{folder}/" in f"/{file.parent}/"]
    return public_headers(name) or TYPES.get(name, [])


def problems(one: Word) -> Iterator[str]:
    """Yields the mistakes of an entry, each with its remedy."""
    word = one.get("word", "an entry without `word`")
    for key in sorted(set(one) - KEYS):
        yield f"{word}: the key {key!r} is unknown; write one of {', '.join(sorted(KEYS))}"
    for key, value in one.items():
        parts = value if key == "types" else [value]
        if not parts or not all(isinstance(part, str) and part.strip() for part in parts):
            yield f"{word}: {key} is empty; remove the key, or give it a value"
    for key in ("word", "text"):
        if key not in one:
            yield f"{word}: {key} is missing; write it"
    if "types" not in one and "file" not in one:
        yield f"{word}: `types` and `file` are missing; say where the code has it"
    if "file" in one and Path(one["file"]) not in FILES:
        yield f"{word}: the file {one['file']} does not exist; name one that shows it"
    for name in one.get("types", []):
        headers = headers_of(name)
        if not headers:
            yield f"{word}: no header has a type {name}; write its present name, or remove it"
        if len(headers) > 1:
            yield f"{word}: {name} is in {', '.join(map(str, headers))}; write FOLDER/{name}"


def order(subjects: list[Any]) -> Iterator[str]:
    """Yields the words that occur twice or are not in alphabetical order."""
    seen: set[str] = set()
    for subject in subjects:
        words = [str(one.get("word", "")).casefold() for one in subject["word"]]
        for word in words:
            if word in seen:
                yield f"{word}: stands twice; join the two entries"
            seen.add(word)
        for word, right in zip(words, sorted(words)):
            if word != right:
                yield f"{subject['title']}: {right} must stand before {word}; sort its words"
                break


def plain_names() -> tuple[int, list[str]]:
    """Returns the limit in the first line of plain_names.txt, and its names."""
    head, _, rest = text_of(ROOT / PLAIN).partition("\n")
    number = re.search(r"\d+", head)
    return int(number.group()) if number else 0, rest.split()


def unexplained(names: set[str]) -> Iterator[str]:
    """Yields the public types whose names are not among these, except XSettings and XState with X among them."""
    for name in sorted(filter(public_headers, TYPES)):
        stems = [name.removesuffix(suffix) for suffix in SUFFIXES]
        if name not in names and not any(stem != name and stem in names for stem in stems):
            yield name


def name_problems(explained: set[str]) -> Iterator[str]:
    most, plain = plain_names()
    for name in unexplained(explained | set(plain)):
        yield f"{public_headers(name)[0]}: {name} is not in the glossary; name it in `types` of its word in {DATA}"
    for name in sorted(set(plain) & explained):
        yield f"{PLAIN}: {name} is in the glossary; run {REMEDY}"
    for name in plain:
        if not public_headers(name):
            yield f"{PLAIN}: no header has a public type {name}; run {REMEDY}"
    if plain != sorted(set(plain)):
        yield f"{PLAIN}: names stand twice or are not sorted; run {REMEDY}"
    if len(plain) > most:
        yield f"{PLAIN}: {len(plain)} names, of at most {most}; explain the new one in {DATA}"
    if len(plain) < most:
        yield f"{PLAIN}: {len(plain)} names, and {most} in its first line; run {REMEDY}"


def shrink(explained: set[str]) -> None:
    """Removes the names from plain_names.txt that are explained or gone."""
    most, plain = plain_names()
    left = sorted(set(filter(public_headers, plain)) - explained)
    text = HEAD.format(min(most, len(left))) + "".join(f"{name}\n" for name in left)
    (ROOT / PLAIN).write_text(text, encoding="utf-8")


def row(one: Word) -> str:
    elsewhere = [f"{name}: {cell(one[key])}" for key, name in ELSEWHERE.items() if key in one]
    printed = [f"{name}: {cell(one[key])}" for key, name in PRINTED.items() if key in one]
    where = []
    for name in one.get("types", []):
        headers = headers_of(name)
        short = name.rpartition("/")[2]
        where.append(link(headers[0], short) if headers else f"`{short}`")
    if "file" in one:
        where.append(link(one["file"], Path(one["file"]).name))
    cells = [f"**{cell(one['word'])}**", cell(one["text"]), "<br>".join(elsewhere), "<br>".join(printed)]
    return "| " + " | ".join([*cells, ", ".join(where)]) + " |"


def page(subjects: list[Any]) -> str:
    text = ABOUT
    for subject in subjects:
        anchor = re.sub("[^a-z ]", "", subject["title"].lower()).replace(" ", "-")
        text += f"- [{subject['title']}](#{anchor})\n"
    for subject in subjects:
        text += f"\n## {subject['title']}\n" + COLUMNS + "".join(row(one) + "\n" for one in subject["word"])
    return text


def main() -> None:
    subjects = tomllib.loads(text_of(ROOT / DATA))["subject"]
    words = [one for subject in subjects for one in subject["word"]]
    explained = {name.rpartition("/")[2] for one in words for name in one.get("types", [])}
    wrong = [f"{DATA}: {problem}" for one in words for problem in problems(one)]
    wrong += [f"{DATA}: {problem}" for problem in order(subjects)]
    if any("word" not in one or "text" not in one for one in words):
        finish(wrong, f"mend {DATA}, then: {REMEDY}", "")
    if "--write" in sys.argv:
        shrink(explained)
    wrong += name_problems(explained)
    wrong += stale(ROOT, {PAGE: page(subjects)}, "--write" in sys.argv)
    finish(wrong, f"mend {DATA} as the lines above say, then: {REMEDY}", f"{len(words)} words, {len(explained)} types")


if __name__ == "__main__":
    main()
