"""Rule: functions have at most 60 lines, classes at most 40 member functions and 800 lines over all their files.

Larger ones are in offenders.txt, which only shrinks: each entry must have the number that is written there, and all
others must be within the limits.

sizes.py            compares the tree with offenders.txt
sizes.py --write    writes offenders.txt from the tree

Universal Ctags finds where functions and classes begin and end. The lines of a function are those from its name to its
last brace; the bodies of TEST, TEST_F, TEST_P and RC_GTEST_PROP count as functions, and so do lambdas outside of
functions. The lines of a class are those from its name to its last brace, and those of its members that are defined
elsewhere. Its member functions are all that it declares, with constructors and operators. Not counted are the second
branches of #if, code that macros make, and a few templates whose heads ctags cannot parse.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections import Counter, defaultdict
from typing import Any, NamedTuple

import tree

MAX_FUNCTION_LINES = 60
MAX_MEMBER_FUNCTIONS = 40
MAX_CLASS_LINES = 800
LIST = tree.ROOT / "tests" / "rules" / "offenders.txt"
HEAD = "# What is larger than tests/rules/sizes.py allows: kind, file, name, number. It only shrinks.\n"

TEST_MACROS = [
    "TEST(a,b)=void a##_##b()",
    "TEST_F(a,b)=void a##_##b()",
    "TEST_P(a,b)=void a##_##b()",
    "RC_GTEST_PROP(a,b,c)=void a##_##b c",
]

Tag = dict[str, Any]


class Size(NamedTuple):
    """A function or class that is too large."""

    kind: str
    path: str
    name: str
    number: int

    def key(self) -> tuple[str, str, str]:
        """Returns its identity: all fields but the number."""
        return self[:3]


def tags_of(paths: list[str]) -> list[Tag]:
    """Returns the tags that ctags finds in these files."""
    command = [
        "ctags",
        "--options=NONE",
        "--quiet",
        "--output-format=json",
        "--sort=no",
        "--kinds-C++=fpcsn",
        "--fields=+neKsZ",
        "-o",
        "-",
        "-L",
        "-",
    ]
    for macro in TEST_MACROS:
        command += ["-D", macro]
    ran = subprocess.run(command, cwd=tree.ROOT, input="\n".join(paths), capture_output=True, text=True, check=True)
    return [json.loads(line) for line in ran.stdout.splitlines() if line]


def whole_name(tag: Tag) -> str:
    """Returns the name of a tag with all its scopes; ctags makes names for unnamed things, by file."""
    return f"{tag['scope']}::{tag['name']}" if tag.get("scope") else str(tag["name"])


def shown(tag: Tag, namespaces: set[str]) -> str:
    """Returns the name of a tag without its namespaces."""
    names = whole_name(tag).split("::")
    inside = [count for count in range(len(names)) if "::".join(names[:count]) in namespaces]
    names = names[max(inside, default=0) :]
    return "::".join("(lambda)" if name.startswith("__anon") else name for name in names).replace(" ", "")


def lines_of(tag: Tag) -> int:
    """Returns the number of lines from the name to the end."""
    return int(tag["end"]) - int(tag["line"]) + 1


def class_of(member: Tag, classes: list[Tag]) -> Tag | None:
    """Returns the class of a member, of classes with one name: that in its file, else in its folder, else the first."""
    folder = member["path"].rpartition("/")[0]
    near = (
        [one for one in classes if one["path"] == member["path"]]
        or [one for one in classes if one["path"].rpartition("/")[0] == folder]
        or classes
    )
    return near[0] if near else None


def sizes_of_classes(tags: list[Tag]) -> list[tuple[Tag, int, int]]:
    """Returns each class with the numbers of its member functions and of its lines."""
    named: defaultdict[str, list[Tag]] = defaultdict(list)
    for tag in tags:
        if tag["kind"] in ("class", "struct"):
            named[whole_name(tag)].append(tag)
    members: Counter[tuple[str, int, str]] = Counter()
    lines: Counter[tuple[str, int, str]] = Counter()
    for tag in tags:
        if tag["kind"] not in ("function", "prototype") or tag.get("scopeKind") not in ("class", "struct"):
            continue
        own = class_of(tag, named[tag["scope"]])
        if own is None:
            continue
        key = (own["path"], own["line"], own["name"])
        if own["path"] == tag["path"] and own["line"] <= tag["line"] <= own["end"]:
            members[key] += 1
        elif tag["kind"] == "function":
            lines[key] += lines_of(tag)
    out = []
    for one in [tag for group in named.values() for tag in group]:
        key = (one["path"], one["line"], one["name"])
        out.append((one, members[key], lines[key] + lines_of(one)))
    return out


def offenders() -> list[Size]:
    """Returns everything that is too large, in the order of offenders.txt."""
    tags = [
        tag for tag in tags_of([path for path in tree.files() if tree.language(path) in ("c", "c++")]) if "end" in tag
    ]
    namespaces = {whole_name(tag) for tag in tags if tag["kind"] == "namespace"}
    out = []
    for tag in tags:
        if tag["kind"] == "function" and tag.get("scopeKind") != "function" and lines_of(tag) > MAX_FUNCTION_LINES:
            out.append(Size("function-lines", tag["path"], shown(tag, namespaces), lines_of(tag)))
    for tag, members, lines in sizes_of_classes(tags):
        name = shown(tag, namespaces)
        if members > MAX_MEMBER_FUNCTIONS:
            out.append(Size("class-members", tag["path"], name, members))
        if lines > MAX_CLASS_LINES:
            out.append(Size("class-lines", tag["path"], name, lines))
    seen: Counter[tuple[str, str, str]] = Counter()
    for index, size in enumerate(out):
        seen[size.key()] += 1
        if seen[size.key()] > 1:  # overloads
            out[index] = size._replace(name=f"{size.name}#{seen[size.key()]}")
    return sorted(out)


def listed() -> dict[tuple[str, str, str], int]:
    """Returns the numbers that offenders.txt allows."""
    out = {}
    for line in LIST.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            kind, path, name, number = line.split()
            out[kind, path, name] = int(number)
    return out


LIMITS = {
    "function-lines": f"a function has at most {MAX_FUNCTION_LINES} lines: give its parts names of their own",
    "class-members": f"a class has at most {MAX_MEMBER_FUNCTIONS} member functions: split it by what it does",
    "class-lines": f"a class has at most {MAX_CLASS_LINES} lines: split it by what it does",
}


def complaints(allowed: dict[tuple[str, str, str], int], found: list[Size]) -> list[str]:
    """Returns a sentence with its remedy for each difference from offenders.txt."""
    out = []
    for size in found:
        what, before = f"{size.path}: {size.name} has {size.number} ({size.kind})", allowed.get(size.key())
        if before is None:
            out.append(f"{what}; {LIMITS[size.kind]}")
        elif size.number > before:
            out.append(f"{what} and had {before}; it must not grow: {LIMITS[size.kind]}")
        elif size.number < before:
            out.append(f"{what} and had {before}: write {size.number} in tests/rules/offenders.txt")
    for kind, path, name in allowed.keys() - {size.key() for size in found}:
        out.append(f"{path}: {name} ({kind}) is small now, or gone: remove its line from tests/rules/offenders.txt")
    return out


def main() -> int:
    if shutil.which("ctags") is None:
        print("ctags is missing, so nothing was checked: run apt-get install universal-ctags")
        return 77
    found = offenders()
    if "--write" in sys.argv[1:]:
        LIST.write_text(HEAD + "".join(f"{' '.join(size[:3])} {size.number}\n" for size in found), encoding="utf-8")
        return 0
    wrong = complaints(listed(), found)
    print("\n".join(wrong) or f"{len(found)} are larger than allowed, as tests/rules/offenders.txt says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
