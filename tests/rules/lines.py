"""Rule: lines of code have at most 120 columns, and its files at most 400 lines."""

import sys

import tree

MAX_COLUMNS = 120
MAX_LINES = 400
LANGUAGES = {"c++", "c", "cmake", "python", "shell"}


def main() -> int:
    long_lines, long_files = [], []
    for path in tree.files():
        if tree.language(path) not in LANGUAGES:
            continue
        lines = (tree.text(path) or "").split("\n")
        if lines[-1] == "":
            lines.pop()
        long_lines += [
            f"{path}:{number}: {len(line)} columns" for number, line in enumerate(lines, 1) if len(line) > MAX_COLUMNS
        ]
        if len(lines) > MAX_LINES:
            long_files.append(f"{path}: {len(lines)} lines")
    if long_lines:
        print("\n".join(long_lines))
        print(
            f"{len(long_lines)} lines have more than {MAX_COLUMNS} columns: fold them; of a drawing, put the words "
            "beside it below it."
        )
    if long_files:
        print("\n".join(long_files))
        print(f"{len(long_files)} files have more than {MAX_LINES} lines: split each by subject.")
    return 1 if long_lines or long_files else 0


if __name__ == "__main__":
    sys.exit(main())
