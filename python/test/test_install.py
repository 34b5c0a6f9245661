"""pip installs the package from the tree, without network and without build packages,
into an environment that has NumPy."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = os.environ["MOTIONRACK_BUILD"]
OFFLINE = ["--no-build-isolation", "--no-index", "--disable-pip-version-check", f"--config-settings=build-dir={BUILD}"]


class Install(unittest.TestCase):
    def test_pip_installs_from_the_tree_and_the_package_runs(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [sys.executable, "-m", "venv", "--system-site-packages", f"{folder}/env"], check=True, timeout=300
            )
            python = f"{folder}/env/bin/python"
            clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | {
                "PIP_CONFIG_FILE": os.devnull
            }
            subprocess.run(
                [python, "-m", "pip", "install", *OFFLINE, str(ROOT / "python")],
                check=True,
                env=clean,
                timeout=500,
                cwd=folder,
            )
            program = (
                "import motionrack, importlib.metadata as m; "
                "print(m.version('motionrack') == motionrack.__version__, motionrack.__file__);"
                "print(motionrack.Rack.template().run('G21 G90\\nG1 X5 F600\\nM2\\n').ok)"
            )
            printed = subprocess.run(
                [python, "-c", program], check=True, env=clean, capture_output=True, text=True, timeout=60, cwd=folder
            ).stdout
            self.assertEqual(
                printed.splitlines()[0],
                f"True {Path(folder).resolve()}/env/lib/python{sys.version_info.major}.{sys.version_info.minor}"
                "/site-packages/motionrack/__init__.py",
            )
            self.assertEqual(printed.splitlines()[1], "True")
            subprocess.run(
                [python, "-m", "pip", "uninstall", "-y", "motionrack"], check=True, env=clean, timeout=60, cwd=folder
            )

    def test_a_wheel_has_every_file_of_the_package_and_is_the_same_each_time(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            made = []
            for name in ("a", "b"):
                subprocess.run(
                    [
                        sys.executable,
                        "-m",
                        "pip",
                        "wheel",
                        *OFFLINE,
                        "--no-deps",
                        "-w",
                        f"{folder}/{name}",
                        str(ROOT / "python"),
                    ],
                    check=True,
                    timeout=500,
                    env=os.environ | {"PIP_CONFIG_FILE": os.devnull},
                )
                made.append(next(Path(f"{folder}/{name}").iterdir()))
            self.assertEqual(made[0].read_bytes(), made[1].read_bytes())
            names = {name for name in zipfile.ZipFile(made[0]).namelist() if name.startswith("motionrack/")}
            own = {
                f"motionrack/{path.name}"
                for path in (ROOT / "python" / "motionrack").iterdir()
                if path.suffix in (".py", ".pyi") or path.name == "py.typed"
            }
            self.assertEqual({name for name in names if not name.endswith(".so")}, own | {"motionrack/_version.py"})
            self.assertEqual(sum(name.endswith(".so") for name in names), 1)


if __name__ == "__main__":
    unittest.main()
