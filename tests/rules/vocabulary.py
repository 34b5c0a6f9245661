"""Rule: the words that COUNTS rejects get fewer, never more: the limits in vocabulary.txt only fall.

vocabulary.py SOURCE            compares each count with its limit
vocabulary.py SOURCE --write    lowers the limits to the counts of the tree
"""

import re
import sys
from collections import Counter
from pathlib import Path

import tree

LIMITS = Path(__file__).with_name("vocabulary.txt")

CODE = r"(motionrack|python/src|python/motionrack|hmi/src)/"
PAGES = r"(docs/(?!pictures/)|examples/|README\.md$|CHANGELOG\.md$|CONTRIBUTING\.md$)"

# name of the count: its files, its pattern, the words to write instead
COUNTS = {
    "extreme-prefixes": (
        CODE,
        r"\b(most|greatest|least|longest|deepest|smallest|fastest|slowest|quickest)_[a-z0-9_]+",
        "max_, min_ or peak_",
    ),
    "headless-what-in-code": (CODE, r"(^|[^a-z])(what|who) (is|was|are|were)\b", "the noun that is meant"),
    "headless-what-in-pages": (PAGES, r"\b(what|who) (is|was|are|were)\b", "the noun that is meant"),
    "is-no": (f"({CODE}|{PAGES})", r"\bis no ", "is not a, has no, or a verb"),
    "is-told": (
        f"({CODE}|{PAGES})",
        r"\b(is|are|was|were) told\b|\btells? of\b",
        "reports, receives, is notified, logs",
    ),
    "persons-without-name": (
        f"({CODE}|{PAGES})",
        r"\b(nobody|whoever|somebody|anybody|everybody)\b",
        "who acts: a module, a card, a client, the operator",
    ),
    "fillers": (
        f"({CODE}|{PAGES})",
        r"\b(so much|so long|so many|lets? go|in vain|all the same|for now|anew)\b",
        "nothing, or the number",
    ),
    "fragments": (r"motionrack/", r"///< of ", "the phrase"),
    "speed-of-paths": (r"motionrack/control/", r"(?<!spindle[_ ])speed(?!_rpm|_override)", "velocity"),
    "types-of-one-name": (r"motionrack/.*\.hpp$", "", "a name that no other header has"),
}

TYPE = re.compile(r"(?:struct|class|enum class) ([A-Z][A-Za-z]+)(?: final)?(?: :[^{]*)? \{")


def count(name: str, files: dict[str, str]) -> int:
    """Returns the number of occurrences in the files of the words of a count."""
    where, what, _ = COUNTS[name]
    texts = [text for path, text in files.items() if re.match(where, path)]
    if name == "types-of-one-name":
        names = Counter(found for text in texts for found in TYPE.findall(text))
        return sum(number > 1 for number in names.values())
    pattern = re.compile(what, re.IGNORECASE | re.MULTILINE)
    return sum(len(pattern.findall(text)) for text in texts)


def main() -> int:
    limits = {name: int(number) for number, name in (line.split() for line in LIMITS.read_text().splitlines())}
    # Without the tests of modules.
    files = {path: tree.text(path) or "" for path in tree.files() if "/test/" not in path}
    found = {name: count(name, files) for name in COUNTS}
    if "--write" in sys.argv:
        lines = [f"{min(found[name], limits.get(name, found[name]))} {name}" for name in COUNTS]
        LIMITS.write_text("\n".join(lines) + "\n")
        return 0
    wrong = 0
    for name, number in found.items():
        if number > limits.get(name, -1):
            where, what, instead = COUNTS[name]
            print(f"{name}: {number}, at most {limits.get(name, -1)}; write {instead} (git grep -iP '{what}')")
            wrong = 1
        elif number < limits[name]:
            print(f"{name}: {number} now, {limits[name]} before; run python3 tests/rules/vocabulary.py . --write")
            wrong = 1
    return wrong


if __name__ == "__main__":
    sys.exit(main())
