"""Rule: only the top CMakeLists.txt has the version of the project: version_once.py ROOT [PROGRAM]

Everything else takes it from there or has none. Exceptions are CHANGELOG.md, which lists the releases, and records of
one version, such as results of measurements.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

from found import files_of, finish, text_of, version_of

ROOT = Path(sys.argv[1])
VERSION = version_of(ROOT)
# Files that may have a version of this project as a number, and files with the versions of other projects.
RECORDS = {
    "CMakeLists.txt",
    "CHANGELOG.md",
    "bench/measured.json",
    "docs/reference/performance.md",
    "motionrack/trace/former_version.hpp",
}
OTHERS = {"hmi/package-lock.json", "docs/reference/third-party.md"}


def releases() -> list[str]:
    return re.findall(r"^## \[(\d+\.\d+\.\d+)\]", text_of(ROOT / "CHANGELOG.md"), re.MULTILINE)


def numbers() -> list[str]:
    """Returns the places that have the number of this version or of a release, or ask CMake for another version."""
    number = re.compile(r"(?<![\d.])(" + "|".join(re.escape(each) for each in {VERSION, *releases()}) + r")(?!\.?\d)")
    asked = re.compile(r"find_package\(motionrack (\d[\d.]*)")
    wrong = []
    for path in files_of(ROOT):
        if str(path) in OTHERS:
            continue
        for at, line in enumerate(text_of(ROOT / path).splitlines(), 1):
            if str(path) not in RECORDS and (found := number.search(line)):
                wrong.append(f"{path}:{at}: has the version {found[1]}: {line.strip()[:80]}")
            if (found := asked.search(line)) and not VERSION.startswith(found[1].rstrip(".") + "."):
                wrong.append(f"{path}:{at}: asks for motionrack {found[1]}, this is {VERSION}")
    return wrong


def others() -> list[str]:
    """Returns wrong versions in package.json, pyproject.toml, CHANGELOG.md and the output of PROGRAM."""
    wrong = []
    page = json.loads(text_of(ROOT / "hmi/package.json")).get("version")
    if page is not None:
        wrong.append(f"hmi/package.json: the version is {page}; the page is a part of the program and has none")
    package = tomllib.loads(text_of(ROOT / "python/pyproject.toml"))["project"]
    if "version" in package or "version" not in package.get("dynamic", []):
        wrong.append(
            'python/pyproject.toml: needs dynamic = ["version"]; build_backend.py takes that of CMakeLists.txt'
        )
    if VERSION not in releases():
        wrong.append(f"CHANGELOG.md: has no heading `## [{VERSION}] - YYYY-MM-DD` for the version of CMakeLists.txt")
    elif releases()[0] != VERSION:
        wrong.append(f"CHANGELOG.md: the newest release is {releases()[0]}, CMakeLists.txt says {VERSION}")
    if len(sys.argv) > 2:
        said = subprocess.run([sys.argv[2], "--version"], capture_output=True, text=True).stdout.strip()
        if said != f"motionrack {VERSION}":
            wrong.append(f"{sys.argv[2]} --version says '{said}', CMakeLists.txt {VERSION}")
    return wrong


finish(
    numbers() + others(),
    "leave the number out or take it from CMakeLists.txt (PROJECT_VERSION, MOTIONRACK_VERSION); a new release "
    "changes CMakeLists.txt and CHANGELOG.md, see CONTRIBUTING.md",
    f"{VERSION} stands in CMakeLists.txt alone",
)
