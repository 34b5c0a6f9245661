"""Every numbered example has a Python form that gives the same history as its C, C++, Pascal or command-line form,
and prints the same.

    example ──MOTIONRACK_TRACE_HASH──► lines of "hash ticks", one a rack ◄──MOTIONRACK_TRACE_HASH── run.py
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
BUILD = Path(os.environ["MOTIONRACK_BUILD"])
PROGRAM = BUILD / "bin" / "motionrack"


@dataclass(frozen=True)
class Form:
    """Original form of an example: its commands, and the file of its folder with the expected output
    (None: not compared)."""

    commands: list[list[str]]
    expected: str | None = "expected.txt"
    python: str = "run.py"
    environment: tuple[tuple[str, str], ...] = ()


def cli(folder: str) -> Form:
    lines = (EXAMPLES / folder / "command").read_text(encoding="utf-8").splitlines()
    return Form([[str(PROGRAM), *line.split()] for line in lines])


def built(folder: str, program: str, *words: str, **more: object) -> Form:
    return Form([[str(BUILD / "examples" / folder / program), *words]], **more)  # type: ignore[arg-type]


FORMS = {
    "01_first_move": [cli("01_first_move")],
    "02_part": [cli("02_part")],
    "03_helix": [cli("03_helix")],
    "04_s_curve": [cli("04_s_curve")],
    "05_limit_hit": [cli("05_limit_hit")],
    "06_library": [built("06_library", "example_library", expected=None)],
    "07_c": [built("07_c", "example_c")],
    "08_homing": [cli("08_homing")],
    "09_mcx314lib": [
        built("09_mcx314lib", "example_mcx314lib", environment=(("MOTIONRACK_RACK", "../racks/single.toml"),))
    ],
    "10_databoard_c": [built("10_databoard_c", "example_databoard_c")],
    "11_carriage": [
        cli("11_carriage"),
        built("11_carriage", "example_carriage", expected="expected_cpp.txt", python="driver.py"),
    ],
    "12_pascal": [
        built("12_pascal", "fpc/calibrate/calibrate", environment=(("LD_LIBRARY_PATH", str(BUILD / "lib")),))
    ],
    "13_stage": [built("13_stage", "example_stage")],
    "14_line": [built("14_line", "example_line", "line.toml")],
    "15_panel": [
        Form(
            [
                [str(PROGRAM), "home", "--rack", "demonstration.toml"],
                [str(PROGRAM), "run", "../02_part/part.ngc", "--rack", "demonstration.toml", "--no-report"],
            ],
            expected=None,
        )
    ],
    "16_probe": [cli("16_probe")],
}


def history(folder: str, commands: list[list[str]], environment: dict[str, str]) -> tuple[str, str]:
    """Runs the commands; returns their output and the event traces of their racks."""
    with tempfile.TemporaryDirectory() as scratch:
        told = Path(scratch) / "history"
        printed = ""
        for command in commands:
            ran = subprocess.run(
                command,
                cwd=EXAMPLES / folder,
                env=os.environ | environment | {"MOTIONRACK_TRACE_HASH": str(told)},
                capture_output=True,
                text=True,
                timeout=300,
                check=False,
            )
            printed += ran.stdout
            if ran.returncode not in (0, 4):
                raise AssertionError(f"{command} ended with {ran.returncode}: {ran.stderr}")
        return printed, told.read_text(encoding="utf-8")


class Examples(unittest.TestCase):
    def test_the_python_form_has_the_same_event_trace_and_output(self) -> None:
        for folder, forms in FORMS.items():
            for form in forms:
                with self.subTest(folder, python=form.python):
                    printed, own = history(folder, form.commands, dict(form.environment))
                    python_printed, python = history(folder, [[sys.executable, form.python]], {})
                    self.assertEqual(python, own)
                    self.assertGreater(len(own), 0)
                    if form.expected is not None:
                        expected = (EXAMPLES / folder / form.expected).read_text(encoding="utf-8")
                        self.assertEqual(printed, expected)
                        self.assertEqual(python_printed, expected)

    def test_every_numbered_example_has_a_python_form(self) -> None:
        self.assertEqual(sorted(folder.name for folder in EXAMPLES.glob("[0-9][0-9]_*")), sorted(FORMS))

    def test_a_rack_with_other_motion_has_another_event_trace(self) -> None:
        text = "import motionrack\nwith motionrack.Rack.template() as rack: rack.run('G0 X{}\\n')\n"
        one, other = (history("01_first_move", [[sys.executable, "-c", text.format(x)]], {})[1] for x in (5, 6))
        self.assertNotEqual(one, other)


if __name__ == "__main__":
    unittest.main()
