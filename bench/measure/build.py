"""Cost of building: a build of the program into an empty folder as in ./run, each of its compilations, and a start with
nothing to build.

    bash: ./run's own build_in ──► cmake, ninja ──► launcher.py COMPILER ... ──► a line for each compilation
"""
import os
import re
import statistics
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

from kinds import ROOT
from machine import machine
from running import Progress, Ran, Trouble, run

LAUNCHER = Path(__file__).resolve().with_name("launcher.py")

#: Hides ccache, which would return objects of other builds, and which build_in would use instead of the launcher.
_WITHOUT_CCACHE = 'command() { [ "$*" != "-v ccache" ] && builtin command "$@"; }'


class Compilation(NamedTuple):
    what: str  # the file, or the folder whose sources were compiled together
    sources: int
    cpu_s: float
    peak_bytes: int


def _short(path: Path, folder: Path) -> Path:
    """Returns the path relative to the build folder (generated files) or to the tree; other paths unchanged."""
    for root in (folder, ROOT):
        if path.is_relative_to(root):
            return path.relative_to(root)
    return path


def named(source: Path, folder: Path) -> tuple[str, int]:
    """Returns the name of a compilation and the number of its sources. The names of CMake's unity sources are
    meaningless; the common folder of the sources that they include replaces them."""
    unity = re.fullmatch(r"unity_(\d+)_(\w+\.\w+)", source.name)
    if not unity or source.parent.name != "Unity":
        return str(_short(source, folder)), 1
    included = re.findall(r'^#include "(.+)"$', source.read_text(encoding="utf-8"), re.M)
    if not included:
        raise Trouble(f"{source} includes no source; correct bench/measure/build.py, which reads its #include lines.")
    names = [_short(Path(name), folder) for name in included]
    if len(names) == 1:
        return str(names[0]), 1
    what = f"{os.path.commonpath([name.parent for name in names])}, {len(names)} sources"
    several = source.with_name(f"unity_1_{unity[2]}").exists()
    return (f"{what}, part {int(unity[1]) + 1}" if several else what), len(names)


def compilations(log: str, folder: Path) -> list[Compilation]:
    """Returns the compilations in the launcher's log, the most expensive first. Raises Trouble if there are none."""
    out = []
    for line in log.splitlines():
        cpu_s, peak_bytes, source = line.split("\t")
        what, sources = named(folder / source, folder)
        out.append(Compilation(what, sources, float(cpu_s), int(peak_bytes)))
    if not out:
        raise Trouble("The build went past bench/measure/launcher.py, so that no compilation was measured.")
    return sorted(out, key=lambda each: -each.cpu_s)


def build_of_run() -> str:
    """Returns the targets and options of the build in the script ./run. Raises Trouble if the line is missing."""
    found = re.search(r"^build_in build/release (.+)$", (ROOT / "run").read_text(encoding="utf-8"), re.M)
    if not found:
        raise Trouble("./run has no line 'build_in build/release ...'; correct bench/measure/build.py, which reads it.")
    return found[1]


def _bash(folder: Path, log: Path, before: str, after: str) -> Ran:
    """Runs the build of ./run in another folder, between the shell commands `before` and `after`."""
    start = f"/usr/bin/python3;-I;-S;-B;{LAUNCHER}"
    script = "\n".join(
        [
            "set -euo pipefail",
            ". cmake/setup.sh",
            _WITHOUT_CCACHE,
            before,
            f'build_in "$1" {build_of_run()} "-DCMAKE_C_COMPILER_LAUNCHER=$2" "-DCMAKE_CXX_COMPILER_LAUNCHER=$2"',
            after,
        ]
    )
    env = {**os.environ, "CCACHE_DISABLE": "1", "MOTIONRACK_COMPILATIONS": str(log)}
    argv = ["bash", "-c", script, "bench/page", str(folder), start]
    return run(argv, cwd=ROOT, env=env, memory=False, limit_s=4 * 3600)


def second_start(folder: Path, log: Path) -> float:
    """Returns the wall time, s, of a ./run with nothing to build: search for packages, ninja, start of the program.
    Raises Trouble if ninja built something."""
    ran = _bash(folder, log, 'need_packages "${run_packages[@]}"', 'exec "$1/bin/motionrack" --version')
    if "building in" in ran.out and "no work to do" not in ran.out:
        raise Trouble(f"A second build, of an unchanged tree, found work to do:\n{ran.out[-2000:]}")
    return ran.wall_s


def measure(progress: Progress) -> dict[str, Any]:
    """Measures a cold build in a folder of its own, and five starts after it."""
    progress.step("a build into an empty folder; about four minutes on two cores")
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory(prefix="motionrack-build-") as name:
        folder, log = Path(name).resolve() / "release", Path(name) / "compilations"
        log.touch()
        cold = _bash(folder, log, "", "")
        made = compilations(log.read_text(encoding="utf-8", errors="surrogateescape"), folder)
        starts = [second_start(folder, log) for _ in range(5)]
        here = machine(folder)
    return {
        "machine": {key: here[key] for key in ("cpu", "cores", "compiler", "day", "version")} | {"load": load},
        "ccache": False,
        "wall_s": cold.wall_s,
        "cpu_s": cold.cpu_s,
        "second_start_s": statistics.median(starts),
        "compilations": [each._asdict() for each in made],
    }
