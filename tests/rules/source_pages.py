"""Checks docs/sources/NAME.toml and the pages made from it: source_pages.py ROOT [--write]

Each statement of a source names the file that implements it and the test that fails without it, or gives the reason
why it differs from the source. The file and the test must exist.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections import Counter
from pathlib import Path
from typing import Any

from found import files_of, finish, text_of
from pages import cell, link, stale

ROOT = Path(sys.argv[1])
FOLDER = Path("docs/sources")
FILES = set(files_of(ROOT))
MIN_STATEMENTS = 350  # statements of all sources
REMEDY = "python3 tests/rules/source_pages.py . --write"
STATES = {
    "done": "the product does it, and the test fails if not",
    "chosen": "the source leaves it open, contradicts itself or has a misprint: decided here",
    "not reproduced": "of hardware or circumstances that are not modelled",
    "open": "differs still, or nothing tests it",
}
KEYS = {"place", "text", "state", "file", "test", "why"}
CPP_TEST = re.compile(r"^\s*(?:RC_GTEST(?:_FIXTURE)?_PROP|(?:TYPED_)?TEST(?:_F|_P)?)\(\s*(\w+),\s*(\w+)\)", re.M)
FUNCTION = re.compile(r"^\s*(?:async )?def (\w+)", re.M)

Statement = dict[str, Any]


def cpp_tests() -> dict[str, Path]:
    """Maps each GoogleTest name to its file."""
    out = {}
    for file in sorted(FILES):
        if file.suffix == ".cpp":
            for suite, name in CPP_TEST.findall(text_of(ROOT / file)):
                out[f"{suite}.{name}"] = file
    return out


TESTS = cpp_tests()


def test_file(test: str) -> Path | None:
    """Returns the file of a test, which is Suite.Name, path::function or path; None if it does not exist."""
    if test in TESTS:
        return TESTS[test]
    path, _, function = test.partition("::")
    if Path(path) not in FILES:
        return None
    if function and function not in FUNCTION.findall(text_of(ROOT / path)):
        return None
    return Path(path)


def problems(name: str, number: int, one: Statement) -> list[str]:
    where = f"{FOLDER}/{name}.toml: statement {number}, {one.get('place', 'without place')!r}"
    wrong = [f"{where}: unknown key {key!r}" for key in sorted(set(one) - KEYS)]
    wrong += [f"{where}: {key} is empty" for key in sorted(KEYS & set(one)) if not str(one[key]).strip()]
    wrong += [f"{where}: {key} is missing" for key in ("place", "text", "state") if key not in one]
    state = one.get("state", "done")
    if state not in STATES:
        wrong.append(f"{where}: the state {state!r} is none of {', '.join(STATES)}")
    if state in ("done", "chosen"):
        wrong += [f"{where}: {key} is missing" for key in ("file", "test") if key not in one]
    if state != "done" and "why" not in one:
        wrong.append(f"{where}: why is missing")
    if "file" in one and Path(one["file"]) not in FILES:
        wrong.append(f"{where}: unknown file {one['file']}")
    if "test" in one and test_file(one["test"]) is None:
        wrong.append(f"{where}: unknown test {one['test']}")
    return wrong


def row(number: int, one: Statement) -> str:
    file = link(one["file"], Path(one["file"]).name) if "file" in one else ""
    found = test_file(one["test"]) if "test" in one else None
    test = link(found, one["test"].split("/")[-1]) if found else ""
    state = cell(one["state"]) + (": " + cell(one["why"]) if "why" in one else "")
    return f"| {number} | {cell(one['place'])} | {cell(one['text'])} | {file} | {test} | {state} |"


def counts(statements: list[Statement]) -> str:
    count = Counter(one.get("state", "done") for one in statements)
    return ", ".join(f"{count[state]} {state}" for state in STATES if count[state])


def page(name: str, source: dict[str, Any], statements: list[Statement]) -> str:
    lines = [f"# {cell(source['title'])}", f"<!-- written by tests/rules/source_pages.py from {name}.toml -->", ""]
    lines += [cell(source["about"]), "", f"{len(statements)} statements: {counts(statements)}.", ""]
    lines += ["| | place | what it says | where | test | state |", "|---|---|---|---|---|---|"]
    return "\n".join(lines + [row(number, one) for number, one in enumerate(statements, 1)]) + "\n"


def overview(sources: dict[str, tuple[dict[str, Any], list[Statement]]]) -> str:
    """Returns the table of docs/sources/README.md."""
    lines = ["| card | source | statements |", "|---|---|---|"]
    for name, (source, statements) in sources.items():
        summary = f"[{len(statements)}]({name}.md): {counts(statements)}"
        lines.append(f"| {name} | {cell(source['title'])} | {summary} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    sources = {}
    for path in sorted((ROOT / FOLDER).glob("*.toml")):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        sources[path.stem] = (data["source"], data["statement"])
    wrong = [
        problem
        for name, (_, statements) in sources.items()
        for number, one in enumerate(statements, 1)
        for problem in problems(name, number, one)
    ]
    count = sum(len(statements) for _, statements in sources.values())
    if count < MIN_STATEMENTS:
        wrong.append(f"{FOLDER}: {count} statements, of at least {MIN_STATEMENTS}")
    if wrong:
        finish(wrong, f"mend {FOLDER}/NAME.toml, then: {REMEDY}", "")
    pages = {FOLDER / f"{name}.md": page(name, *source) for name, source in sources.items()}
    index = FOLDER / "README.md"
    head, begin, rest = text_of(ROOT / index).partition("<!-- statements -->\n")
    pages[index] = head + begin + overview(sources) + "\n" + rest.partition("\n\n")[2]
    finish(stale(ROOT, pages, "--write" in sys.argv), REMEDY, f"{count} statements of {len(sources)} sources")


if __name__ == "__main__":
    main()
