"""Shared parts of the rules' scripts: the files of the tree, and the exit codes.

The script of a broken rule prints each place and then the remedy, and exits with 1. The script of a rule that cannot be
checked here exits with 77.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import NoReturn

SKIPPED = 77


def git(root: Path, *arguments: str) -> str | None:
    """Returns the output of git; None if git fails or is not installed, or if the tree is not a git checkout."""
    if not (root / ".git").exists():
        return None
    try:
        done = subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True)
    except FileNotFoundError:
        return None
    return done.stdout if done.returncode == 0 else None


def files_of(root: Path) -> list[Path]:
    """Returns the files of the project, sorted, with paths relative to the root."""
    listed = subprocess.run([Path(__file__).with_name("files"), root], check=True, capture_output=True, text=True)
    return sorted(Path(name) for name in listed.stdout.split("\0") if name)


def text_of(path: Path) -> str:
    """Returns the text of a file; "" if it is not UTF-8."""
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return ""


def version_of(root: Path) -> str:
    """Returns the version of the project from the top CMakeLists.txt; skips the rule if it has none."""
    for line in text_of(root / "CMakeLists.txt").splitlines():
        if line.startswith("project(motionrack VERSION "):
            return line.split()[2]
    skip("CMakeLists.txt has no line `project(motionrack VERSION ...`")


def skip(why: str) -> NoReturn:
    print(f"not checked: {why}")
    sys.exit(SKIPPED)


def finish(wrong: list[str], remedy: str, kept: str) -> NoReturn:
    """Ends the script: prints the violations and the remedy, exit code 1; without violations `kept`, exit code 0."""
    if not wrong:
        print(kept)
        sys.exit(0)
    for each in wrong:
        print(each)
    print(f"remedy: {remedy}")
    sys.exit(1)
