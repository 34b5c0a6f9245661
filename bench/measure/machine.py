"""Description of the machine, the compiler and the peers of a run."""
import os
import platform
import re
import subprocess
import time
from pathlib import Path

from kinds import ROOT


def _said(*argv: str) -> str:
    try:
        out = subprocess.run(argv, capture_output=True, text=True, check=False).stdout.strip()
    except OSError:
        return ""
    return out.splitlines()[0] if out else ""


def _from(path: str, pattern: str) -> str:
    try:
        found = re.search(pattern, Path(path).read_text(encoding="utf-8", errors="replace"), re.M)
    except OSError:
        return ""
    return found[1].strip() if found else ""


def version_of(package: str) -> str:
    """Returns the upstream version of a Debian package; "" if it is not installed."""
    return re.sub(r"^\d+:|[-+~].*$", "", _said("dpkg-query", "-W", "-f=${Version}", package))


def machine(folder: Path) -> dict:
    """Returns CPU, cores, memory, kernel, system, compiler of the build in `folder`, peer versions, load and date."""
    compiler = _from(str(folder / "CMakeCache.txt"), r"^CMAKE_CXX_COMPILER:\w+=(.*)$") or "c++"
    kilobytes = int(_from("/proc/meminfo", r"^MemTotal:\s+(\d+)") or 0)
    return {
        "cpu": _from("/proc/cpuinfo", r"^model name\s*:\s*(.*)$") or platform.machine(),
        "virtual": bool(re.search(r"\bhypervisor\b", _from("/proc/cpuinfo", r"^flags\s*:\s*(.*)$"))),
        "cores": os.cpu_count(),
        "memory_gb": round(kilobytes / 1e6),
        "kernel": re.sub(r"[^\d.].*", "", platform.release()).rstrip("."),
        "system": _from("/etc/os-release", r'^PRETTY_NAME="(.*)"$'),
        "compiler": _said(compiler, "--version"),
        "load": os.getloadavg()[0],
        "day": time.strftime("%Y-%m-%d"),
        "version": _from(str(ROOT / "CMakeLists.txt"), r"project\(motionrack VERSION ([\d.]+)"),
        "peers": {
            package: version_of(package) for package in ("verilator", "linuxcnc-uspace", "sigrok-cli", "valgrind")
        },
    }
