"""The files of the tree that were written by hand, and which language each is in."""

import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Not ours, or made by builds.
_LEFT_OUT = {".git", "node_modules", "build", "__pycache__"}

_BY_SUFFIX = {
    ".cpp": "c++",
    ".hpp": "c++",
    ".h": "c++",
    ".c": "c",
    ".cmake": "cmake",
    ".py": "python",
    ".sh": "shell",
    ".md": "markdown",
}


def files() -> list[str]:
    """Paths below ROOT: what git knows and what it would add; in a tree without git all that is there."""
    if (ROOT / ".git").exists():
        listed = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=ROOT,
            capture_output=True,
            check=True,
        )
        paths = sorted(set(listed.stdout.decode("utf-8").split("\0")) - {""})
        return [path for path in paths if (ROOT / path).is_file()]
    found = []
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [name for name in folders if name not in _LEFT_OUT and not name.startswith("build-")]
        found += [str((Path(folder) / name).relative_to(ROOT)) for name in names]
    return sorted(path for path in found if (ROOT / path).is_file())


def language(path: str) -> str:
    """One of c++, c, cmake, python, shell, markdown; "" of any other. Scripts without a suffix tell by their first line."""
    name = Path(path).name
    if name == "CMakeLists.txt":
        return "cmake"
    suffix = Path(name).suffix
    if suffix:
        return _BY_SUFFIX.get(suffix, "")
    with open(ROOT / path, "rb") as file:
        first = file.readline(100)
    if not first.startswith(b"#!"):
        return ""
    return "python" if b"python" in first else "shell" if b"sh" in first else ""


def text(path: str) -> str | None:
    """What is in the file; None if it is no text in UTF-8."""
    data = (ROOT / path).read_bytes()
    if b"\0" in data:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None
