"""Rule: commit messages have the form of CONTRIBUTING.md: commits_form.py ROOT

    type(module): imperative subject        at most 72 characters, no full stop
                                            an empty line
    why the behaviour changes               a body; feat, fix and perf need one

Reads the commits that have this script in their history, except merges.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from found import finish, git, skip

ROOT = Path(sys.argv[1]).resolve()
MAX_SUBJECT = 72
TYPES = ["feat", "fix", "docs", "style", "refactor", "test", "build", "ci", "chore", "perf"]
WITH_BODY = {"feat", "fix", "perf"}
SUBJECT = re.compile(r"(?P<type>[a-z]+)\((?P<module>[a-z0-9][a-z0-9_./+-]*)\): (?P<said>\S.*)")
TRAILER = re.compile(r"[A-Z][A-Za-z-]+: \S")
# Endings that show an inflected word, and the imperatives that have them.
INFLECTED = re.compile(r"[a-z]+(ed|ing)$")
IMPERATIVE = {
    "bring",
    "embed",
    "exceed",
    "feed",
    "need",
    "proceed",
    "ring",
    "seed",
    "speed",
    "spring",
    "string",
    "swing",
}


def wrong_in(message: str) -> str:
    """Returns the first violation of a message; "" if it has the form."""
    lines = message.rstrip("\n").split("\n")
    subject = lines[0]
    if len(subject) > MAX_SUBJECT:
        return f"the first line has {len(subject)} characters, at most {MAX_SUBJECT}"
    match = SUBJECT.fullmatch(subject)
    if match is None:
        return "the first line is not `type(module): subject`"
    if match["type"] not in TYPES:
        return f"`{match['type']}` is none of {', '.join(TYPES)}"
    first = match["said"].split()[0]
    if first[0].isupper() and first[1:].islower():
        return f"the subject begins with a capital: `{first}`"
    if INFLECTED.fullmatch(first) and first not in IMPERATIVE:
        return f"`{first}` is not an imperative"
    if subject.endswith("."):
        return "the first line ends with a full stop"
    if len(lines) > 1 and lines[1]:
        return "the second line is not empty"
    if match["type"] in WITH_BODY and not any(line.strip() and not TRAILER.match(line) for line in lines[2:]):
        return f"a {match['type']} needs a body that says why"
    return ""


def messages() -> list[tuple[str, str]]:
    """Returns short hash and message of the commits since the rule was added."""
    if git(ROOT, "rev-parse", "HEAD") is None:
        skip("this tree is an archive or git cannot read it, so there are no commits to look at")
    if (git(ROOT, "rev-parse", "--is-shallow-repository") or "").strip() != "false":
        skip("this clone is shallow; `git fetch --unshallow` brings the commits")
    added = (git(ROOT, "log", "--diff-filter=A", "--format=%H", "--", "tests/rules/commits_form.py") or "").split()
    if not added:
        skip("the rule itself is not committed yet")
    since = f"{added[-1]}..HEAD"
    printed = git(ROOT, "log", "--ancestry-path", "--no-merges", "--format=%h%x00%B%x00", since) or ""
    parts = printed.split("\0")
    return [(parts[at].strip(), parts[at + 1]) for at in range(0, len(parts) - 1, 2)]


read = messages()
found = [
    f"{short} {message.splitlines()[0][:90] if message.strip() else '(no message)'}: {bad}"
    for short, message in read
    if (bad := wrong_in(message))
]
finish(
    found,
    "reword them, before they are merged: git rebase -i, `reword`; the form stands in CONTRIBUTING.md",
    f"{len(read)} commits keep their form",
)
