"""Build backend (PEP 517): makes the wheel with CMake, a compiler and Python's standard library, without network.

    pip ──build_wheel──► cmake -S .. -B ../build/python ──► _core.*.so and the package's files
                                                          ──► motionrack-VERSION-cp311-cp311-linux_x86_64.whl

--config-settings=build-dir=FOLDER uses an existing build folder, so that nothing is compiled twice.
"""

from __future__ import annotations

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tomllib
import zipfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
# Licence of the project, and licences of the code compiled into the module.
LICENCES = ("LICENSE", "packaging/copyright")
Settings = dict[str, Any] | None


def version() -> str:
    """Returns the version of the project, read from CMakeLists.txt."""
    match = re.search(
        r"^project\(motionrack VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.MULTILINE
    )
    if match is None:
        raise SystemExit(
            "motionrack: ../CMakeLists.txt has no version; the package is built in its own tree, beside motionrack/"
        )
    return match[1]


def tag() -> str:
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub(r'[-.]', '_', sysconfig.get_platform())}"


def compiled(settings: Settings) -> Path:
    """Builds the package; returns its folder."""
    chosen = (settings or {}).get("build-dir")
    folder = Path(str(chosen)).resolve() if chosen else ROOT / "build" / "python"
    if not chosen or not (folder / "CMakeCache.txt").exists():
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(
            [
                "cmake",
                "-S",
                ROOT,
                "-B",
                folder,
                *generator,
                "-DCMAKE_BUILD_TYPE=Release",
                "-DMOTIONRACK_TESTS=OFF",
                "-DMOTIONRACK_PYTHON=ON",
                f"-DPython3_EXECUTABLE={sys.executable}",
            ],
            check=True,
        )
    subprocess.run(
        ["cmake", "--build", folder, "--target", "motionrack_python", "--parallel", str(os.cpu_count() or 1)],
        check=True,
    )
    return folder / "python" / "motionrack"


def described() -> dict[str, str]:
    """Returns the files of the wheel's dist-info, except RECORD."""
    project = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    head = [
        (
            f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {version()}\n"
            f"Summary: {project['description']}\nRequires-Python: {project['requires-python']}\n"
            f"License: {project['license']['text']}"
        ),
        *(f"License-File: {Path(each).name}" for each in LICENCES),
        *(f"Requires-Dist: {each}" for each in project["dependencies"]),
        "Description-Content-Type: text/markdown\n",
    ]
    return {
        "METADATA": "\n".join(head) + "\n" + (HERE / project["readme"]).read_text(encoding="utf-8"),
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: motionrack\nRoot-Is-Purelib: false\nTag: {tag()}\n",
    } | {Path(each).name: (ROOT / each).read_text(encoding="utf-8") for each in LICENCES}


def dist_info() -> str:
    return f"motionrack-{version()}.dist-info"


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    return []


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: Settings = None) -> str:
    folder = Path(metadata_directory) / dist_info()
    folder.mkdir()
    for name, text in described().items():
        (folder / name).write_text(text, encoding="utf-8")
    return dist_info()


def build_wheel(wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None) -> str:
    package = compiled(config_settings)
    files = {
        f"motionrack/{path.name}": path.read_bytes()
        for path in sorted(package.iterdir())
        if path.suffix in (".py", ".pyi", ".so") or path.name == "py.typed"
    }
    files |= {f"{dist_info()}/{name}": text.encode() for name, text in described().items()}
    name = f"motionrack-{version()}-{tag()}.whl"
    record = ""
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{path},sha256={digest},{len(data)}\n"
        wheel.writestr(
            zipfile.ZipInfo(f"{dist_info()}/RECORD", (1980, 1, 1, 0, 0, 0)),
            record + f"{dist_info()}/RECORD,,\n",
            zipfile.ZIP_DEFLATED,
        )
    return name


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    raise SystemExit(
        "motionrack: the package is a part of the project's tree and has no source archive of its own; install it from "
        "the tree"
    )
