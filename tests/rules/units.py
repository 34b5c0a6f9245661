"""Compilation units of the product: those of a compile database, and single sources with the flags of their units."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
PRODUCT = re.compile(r"(motionrack|python/src)/(?!(.*/)?test/).*\.cpp$")


class Unit(NamedTuple):
    """Compilation unit: a source, or a file of a unity build that includes several sources."""

    file: Path
    command: list[str]
    sources: list[str]  # of the product, relative to ROOT

    def flags(self) -> list[str]:
        """Returns the flags of the compiler, without source and output."""
        at = self.command.index("-o")
        return [word for word in self.command[1:at] + self.command[at + 2 :] if word not in ("-c", str(self.file))]


def relative(path: Path) -> str:
    """Returns the path as git names it; unchanged if it is outside of the tree."""
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)


def units_of(build: Path) -> list[Unit]:
    """Returns the units of the compile database that have sources of the product."""
    out = []
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        file = Path(entry["directory"], entry["file"])
        sources = [file]
        if "/Unity/" in str(file):
            text = file.read_text(encoding="utf-8")
            sources = [file.parent / name for name in re.findall(r'^#include "(.+)"$', text, re.MULTILINE)]
        own = [relative(source.resolve()) for source in sources]
        own = [name for name in own if PRODUCT.match(name)]
        if own:
            out.append(Unit(file, shlex.split(entry["command"]), own))
    return out


def configure(build: Path) -> None:
    """Configures a unity build of the product and builds only the generated sources."""
    quiet = {"stdout": subprocess.DEVNULL, "check": True}
    command = ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_UNITY_BUILD=ON", "-DMOTIONRACK_TESTS=OFF"]
    subprocess.run(command, **quiet)  # type: ignore[call-overload]
    wanted: set[str] = set()
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        file = Path(entry["directory"], entry["file"])
        included = re.findall(r'^#include "(.+)"$', file.read_text("utf-8"), re.M) if file.exists() else [str(file)]
        wanted |= {str(Path(name).relative_to(build)) for name in included if name.startswith(f"{build}/")}
    missing = sorted(name for name in wanted if not (build / name).exists())
    if missing:
        subprocess.run(["ninja", "-C", build, *missing], **quiet)  # type: ignore[call-overload]


def alone(units: list[Unit], sources: Iterable[str]) -> list[Unit]:
    """Returns each source as a unit of its own, with the flags of its target."""
    by_source = {source: unit for unit in units for source in unit.sources}
    out = []
    for source in sources:
        if unit := by_source.get(source):
            command = [str(ROOT / source) if word == str(unit.file) else word for word in unit.command]
            out.append(Unit(ROOT / source, command, [source]))
    return out
