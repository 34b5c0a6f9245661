"""Files of the tree, and the language of each."""

import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]

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
    """Returns the paths below ROOT: those of the checkout, or of an unpacked archive."""
    listed = subprocess.run([HERE / "files", ROOT], capture_output=True, check=True).stdout.decode("utf-8")
    return sorted({path for path in listed.split("\0") if path})


def language(path: str) -> str:
    """Returns c++, c, cmake, python, shell, markdown or ""; the first line decides for scripts without a suffix."""
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
    """Returns the content of a file; None if it is not UTF-8 text."""
    data = (ROOT / path).read_bytes()
    if b"\0" in data:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None
