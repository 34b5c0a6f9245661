"""What the rules' scripts share: the files of the tree, and how they end.

A rule that was broken prints each place and, last, the remedy; its script ends with 1.
What cannot be asked here ends with 77.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import NoReturn

SKIPPED = 77
NOT_OURS = {".git", "build", "node_modules", "__pycache__"}


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
    """The project's files, relative: those of git that are there; where git cannot be asked, all but build folders."""
    listed = git(root, "ls-files", "-z", "--cached", "--others", "--exclude-standard")
    if listed is not None:
        return sorted(Path(name) for name in listed.split("\0") if name and (root / name).is_file())
    found: list[Path] = []
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name not in NOT_OURS and not name.startswith("build-")]
        found += [(Path(folder) / name).relative_to(root) for name in names]
    return sorted(found)


def text_of(path: Path) -> str:
    """The file's text; nothing for what is no text."""
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
