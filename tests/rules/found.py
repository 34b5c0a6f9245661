"""What the rules' scripts share: the files of the tree, and how they end.

A rule that was broken prints each place and, last, the remedy; its script ends with 1.
What cannot be asked here ends with 77.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import NoReturn

SKIPPED = 77


def git(root: Path, *arguments: str) -> str | None:
    """What git prints; nothing where it refuses, or where the tree is none of git's."""
    if not (root / ".git").exists():
        return None
    try:
        done = subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True)
    except FileNotFoundError:
        return None
    return done.stdout if done.returncode == 0 else None


def files_of(root: Path) -> list[Path]:
    """The project's files, relative."""
    listed = subprocess.run([Path(__file__).with_name("files"), root], check=True, capture_output=True, text=True)
    return sorted(Path(name) for name in listed.stdout.split("\0") if name)


def text_of(path: Path) -> str:
    """The file's text; empty if it is not a text file."""
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return ""


def version_of(root: Path) -> str:
    """The project's, which the top CMakeLists.txt has."""
    for line in text_of(root / "CMakeLists.txt").splitlines():
        if line.startswith("project(motionrack VERSION "):
            return line.split()[2]
    skip("CMakeLists.txt has no line `project(motionrack VERSION ...`")


def skip(why: str) -> NoReturn:
    print(f"not checked: {why}")
    sys.exit(SKIPPED)


def finish(wrong: list[str], remedy: str, kept: str) -> NoReturn:
    """Ends the script: with what was found and the remedy, or with a line that says what holds."""
    if not wrong:
        print(kept)
        sys.exit(0)
    for each in wrong:
        print(each)
    print(f"remedy: {remedy}")
    sys.exit(1)
