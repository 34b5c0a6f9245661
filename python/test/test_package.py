"""The package as a whole: stubs, docstrings with units, types, and the statements of its pages."""

from __future__ import annotations

import importlib
import inspect
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

import motionrack
from motionrack import _core

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path(motionrack.__file__).parent
sys.path.insert(0, str(ROOT / "python" / "tools"))
DRIVERS = (
    motionrack.Mcx314,
    motionrack.Mcx314Library,
    motionrack.Databoard4002,
    motionrack.Ioflex02,
    motionrack.GratingCard,
    motionrack.Rtc5,
    motionrack.SlopeTable,
    motionrack.SpeedScale,
)


def public(kind: type) -> dict[str, Any]:
    return {name: value for name, value in vars(kind).items() if not name.startswith("_")}


class Stubs(unittest.TestCase):
    def test_the_stub_of_the_module_is_current(self) -> None:
        stubs = importlib.import_module("stubs")
        written = (ROOT / "python" / "motionrack" / "_core.pyi").read_text(encoding="utf-8")
        self.assertEqual(stubs.stub(), written, "make it anew: PYTHONPATH=BUILD/python python3 python/tools/stubs.py")

    def test_mypy_accepts_typical_user_code(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            user = Path(folder) / "user.py"
            user.write_text(
                "import motionrack\nrack = motionrack.Rack.template()\n"
                'reveal_type(rack.run("M2").axes["X"].actual_end)\n'
                'reveal_type(rack.run("M2").trace["x.position"])\n'
                'card: motionrack.Mcx314 = rack.cards["motion"].driver\nreveal_type(card.ReadLPS(0))\n',
                encoding="utf-8",
            )
            ran = subprocess.run(
                [sys.executable, "-m", "mypy", "--strict", f"--cache-dir={folder}/cache", str(user)],
                cwd=folder,
                env=os.environ | {"MYPYPATH": str(PACKAGE.parent)},
                capture_output=True,
                text=True,
                timeout=300,
                check=False,
            )
            self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
            revealed = re.findall(r'Revealed type is "(.*)"', ran.stdout)
            self.assertEqual((revealed[0], revealed[2]), ("builtins.float", "builtins.int"))
            self.assertIn("ndarray", revealed[1])

    def test_every_public_name_is_exported_once(self) -> None:
        self.assertEqual(sorted(set(motionrack.__all__)), sorted(motionrack.__all__))
        for name in motionrack.__all__:
            self.assertTrue(hasattr(motionrack, name), name)


class Docstrings(unittest.TestCase):
    def test_every_public_name_has_one(self) -> None:
        for name in motionrack.__all__:
            thing = getattr(motionrack, name)
            if not callable(thing):
                continue
            with self.subTest(name):
                self.assertTrue(inspect.getdoc(thing))
            if inspect.isclass(thing):
                for member, value in public(thing).items():
                    if callable(value) or isinstance(value, property):
                        with self.subTest(f"{name}.{member}"):
                            self.assertTrue(inspect.getdoc(value))

    def test_every_number_of_a_driver_has_its_range_or_unit(self) -> None:
        """Masks and channels of axes are explained once, by the class; everything else in its own docstring."""
        unit = re.compile(
            r"\d|\bs\b|counts?|pulses|bits|mm|degrees|Hz|us|mask|see |units|text|head|as of|path|levels?", re.IGNORECASE
        )
        for kind in DRIVERS:
            for name, value in public(kind).items():
                doc = inspect.getdoc(value) or ""
                signature, _, said = doc.partition("\n")
                if re.search(r"\b(?!axes|axis\b)\w+: (int|float)", signature):
                    with self.subTest(f"{kind.__name__}.{name}"):
                        self.assertRegex(said, unit)

    def test_list_commands_of_the_rtc5_are_those_of_its_map(self) -> None:
        card = motionrack.Rack.from_file(ROOT / "examples" / "14_line" / "line.toml").cards["scan"]
        listed = {
            name for name, value in public(_core.Rtc5).items() if "List command:" in (inspect.getdoc(value) or "")
        }
        self.assertLessEqual(listed, {command["name"] for command in card.map["commands"]})
        self.assertGreater(len(listed), 60)


class Pages(unittest.TestCase):
    def test_the_programs_of_the_pages_run(self) -> None:
        for page in ("python/README.md", "docs/howto/python.md", "README.md"):
            blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)
            self.assertTrue(blocks, page)
            with self.subTest(page), tempfile.TemporaryDirectory() as folder:
                ran = subprocess.run(
                    [sys.executable, "-c", "\n".join(blocks)],
                    cwd=folder,
                    capture_output=True,
                    text=True,
                    timeout=120,
                    check=False,
                )
                self.assertEqual(ran.returncode, 0, ran.stderr)

    def test_the_picture_of_the_pages_is_current(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [sys.executable, str(ROOT / "python" / "tools" / "picture.py"), f"{folder}/trace.svg"],
                check=True,
                timeout=60,
            )
            self.assertEqual(
                Path(f"{folder}/trace.svg").read_text(encoding="utf-8"),
                (ROOT / "docs" / "pictures" / "python_trace.svg").read_text(encoding="utf-8"),
                "make it anew: python3 python/tools/picture.py docs/pictures/python_trace.svg",
            )


class Files(unittest.TestCase):
    def test_files_and_functions_are_small(self) -> None:
        for path in [*(ROOT / "python").rglob("*.py"), *(ROOT / "examples").rglob("*.py")]:
            lines = path.read_text(encoding="utf-8").splitlines()
            with self.subTest(path.name):
                self.assertLessEqual(len(lines), 400)


if __name__ == "__main__":
    unittest.main()
