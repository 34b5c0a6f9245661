"""Rule: text is UTF-8 with LF, ends with a line end, and has no tabs and no blanks at ends of lines (.editorconfig).

text_form.py          lists the violations
text_form.py --fix    corrects them, except tabs and files that are not UTF-8
"""

import sys
from pathlib import Path

import tree

# Inputs of tests, whose exact bytes matter.
EXEMPT = ("tests/fuzz/corpus/", "tests/golden/")
WITH_TABS = {"Makefile"}


def flaws(path: str, text: str) -> list[str]:
    """Returns the violations in a text."""
    out = []
    if "\r" in text:
        out.append(f"{path}: has carriage returns; lines end with LF")
    if text and not text.endswith("\n"):
        out.append(f"{path}: its last line has no end")
    for number, line in enumerate(text.split("\n"), 1):
        if line != line.rstrip(" \t\r"):
            out.append(f"{path}:{number}: blanks at the end of the line")
        if "\t" in line and Path(path).name not in WITH_TABS:
            out.append(f"{path}:{number}: a tab; indent with blanks, and write \\t in strings")
    return out


def mended(text: str) -> str:
    """Returns the text with LF, no blanks at the ends of lines and a line end at its end."""
    lines = [line.rstrip(" \t\r") for line in text.replace("\r\n", "\n").split("\n")]
    whole = "\n".join(lines)
    return whole if not whole or whole.endswith("\n") else whole + "\n"


def main() -> int:
    found = []
    for path in tree.files():
        if path.startswith(EXEMPT):
            continue
        data = (tree.ROOT / path).read_bytes()
        if b"\0" in data:
            continue  # a picture
        text = tree.text(path)
        if text is None:
            found.append(f"{path}: is not UTF-8")
            continue
        if "--fix" in sys.argv[1:] and mended(text) != text:
            (tree.ROOT / path).write_bytes(mended(text).encode("utf-8"))
            text = mended(text)
        found += flaws(path, text)
    if found:
        print("\n".join(found))
        print(f"{len(found)} places are not as .editorconfig says: run python3 tests/rules/text_form.py --fix")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
