"""Part programs from Python: outcomes, traces, problems, faults, homing, compared with those of the command line."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import motionrack
import numpy as np
from motionrack import InvalidInput, MachineFault, Rack, Refused

PROGRAM = str(Path(os.environ["MOTIONRACK_BUILD"]) / "bin" / "motionrack")
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
TEXT = "G21 G90 G64 P0.02\nG1 X10 Y5 F600\nG3 X20 Y15 I0 J10\nG0 X0 Y0\nM2\n"


def referee(*words: str, text: str = TEXT) -> subprocess.CompletedProcess[str]:
    """Runs a command of motionrack with `text` on its standard input."""
    return subprocess.run([PROGRAM, *words], input=text, capture_output=True, text=True, timeout=120, check=False)


class Outcomes(unittest.TestCase):
    def test_an_outcome_is_that_of_the_command_line(self) -> None:
        outcome = Rack.template().run(TEXT)
        told = json.loads(referee("run", "-", "--no-report", "--json").stdout)
        self.assertEqual(json.loads(outcome.json()), told)
        self.assertEqual(
            (outcome.ok, outcome.duration_s, outcome.planned_duration_s, outcome.path_mm),
            (told["ok"], told["duration_s"], told["planned_duration_s"], told["path_mm"]),
        )
        self.assertEqual(
            (outcome.trace_hash, outcome.events, outcome.chip_segments),
            (told["trace_hash"], told["events"], told["chip_segments"]),
        )
        for axis in told["axes"]:
            mine = outcome.axes[axis["axis"]]
            self.assertEqual(
                (mine.pulses_sent, mine.encoder_counts, mine.lost_pulses, mine.actual_end, mine.peak_velocity),
                (
                    axis["pulses_sent"],
                    axis["encoder_counts"],
                    axis["lost_pulses"],
                    axis["actual_end"],
                    axis["peak_velocity"],
                ),
            )
        self.assertEqual(outcome.summary(), referee("run", "-", "--no-report").stdout)
        self.assertIs(outcome.check(), outcome)

    def test_a_trace_has_what_the_command_line_writes_as_csv(self) -> None:
        outcome = Rack.template().run(TEXT)
        with tempfile.TemporaryDirectory() as folder:
            referee("run", "-", "--no-report", "--csv", f"{folder}/a.csv")
            outcome.write_csv(f"{folder}/b.csv")
            self.assertEqual(Path(f"{folder}/a.csv").read_bytes(), Path(f"{folder}/b.csv").read_bytes())
            with open(f"{folder}/a.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(outcome.trace.ticks))
        for column, signal in (
            ("x_position_mm", "x.position"),
            ("y_velocity_mm_s", "y.velocity"),
            ("deviation_mm", "deviation"),
        ):
            np.testing.assert_allclose([float(row[column]) for row in rows], outcome.trace[signal], atol=1e-4)

    def test_a_trace_is_made_of_arrays_with_units(self) -> None:
        trace = Rack.template().run(TEXT).trace
        self.assertEqual(trace.ticks.dtype, np.int64)
        self.assertTrue(np.all(np.diff(trace.ticks) >= 0))
        np.testing.assert_allclose(trace.time, trace.ticks * 1e-10)
        for name in trace:
            self.assertEqual((len(trace[name]), trace[name].dtype), (len(trace.ticks), np.dtype(np.float64)))
        self.assertEqual(
            (trace.units["X.position"], trace.units["A.velocity"], trace.units["deviation"]), ("mm", "deg/s", "mm")
        )
        self.assertIs(trace["X.POSITION"], trace["X.position"])
        self.assertIn("x.velocity", trace)
        with self.assertRaises(InvalidInput):
            trace["q.position"]
        # The velocity is that of the pulses; in a slow move it equals the slope of the position.
        slow = (trace.time > 0.4) & (trace.time < 0.9)
        np.testing.assert_allclose(
            np.gradient(trace["x.position"], trace.time)[slow].mean(), trace["x.velocity"][slow].mean(), rtol=0.01
        )

    def test_a_longer_sample_period_gives_fewer_samples_and_the_same_event_trace(self) -> None:
        fine, coarse = (Rack.template().run(TEXT, sample_period=period) for period in (1e-3, 1e-2))
        self.assertAlmostEqual(len(fine.trace.ticks) / len(coarse.trace.ticks), 10, delta=0.2)
        self.assertEqual(fine.trace.hash(), coarse.trace.hash())
        for period in (0, -1, 1e6):
            with self.assertRaises(Refused):
                Rack.template().run(TEXT, sample_period=period)

    def test_a_profile_is_that_of_the_rack_file(self) -> None:
        limited = Rack.template().run(TEXT, profile="jerk_limited")
        self.assertTrue(limited.ok)
        self.assertNotEqual(limited.trace_hash, Rack.template().run(TEXT).trace_hash)
        text = (
            motionrack.template_text()
            .replace('profile = "trapezoid"', 'profile = "jerk_limited"')
            .replace('# profile = "jerk_limited"', 'profile = "jerk_limited"')
        )
        self.assertIn('\nprofile = "jerk_limited"', text)
        self.assertEqual(Rack.from_text(text).run(TEXT).trace_hash, limited.trace_hash)
        with self.assertRaises(Refused):
            Rack.template().run(TEXT, profile="wild")

    def test_moves_and_events_are_reported(self) -> None:
        outcome = Rack.template().run("G21 G90\nM3 S1000\nG1 X10 F600\nG4 P0.1\nG0 X0\nM2\n")
        self.assertEqual(
            [(block.kind, block.line) for block in outcome.executed_moves], [("feed", 3), ("dwell", 4), ("rapid", 5)]
        )
        self.assertIn("spindle", outcome.program_events[0].text)
        self.assertEqual((outcome.moves, outcome.dwells, outcome.program_ended), (2, 1, True))
        self.assertIn("<svg", outcome.svg())
        self.assertIn("<svg", outcome._repr_html_())
        with tempfile.TemporaryDirectory() as folder:
            outcome.write_report(f"{folder}/r.html")
            outcome.write_events(f"{folder}/e.csv")
            self.assertIn("<html", Path(f"{folder}/r.html").read_text(encoding="utf-8"))
            with self.assertRaises(motionrack.FileError):
                outcome.write_csv(f"{folder}/no/such/folder.csv")


class Mistakes(unittest.TestCase):
    def test_an_invalid_program_moves_nothing_and_reports_line_and_column(self) -> None:
        rack = Rack.template()
        with self.assertRaises(motionrack.Error) as caught:
            rack.run("G21 G90\nG1 X5 F100\nG1 X600\nG1 Q\n", name="bad.ngc")
        problems = caught.exception.problems
        self.assertEqual(
            [(problem.file, problem.line, problem.column) for problem in problems],
            [("bad.ngc", 3, 4), ("bad.ngc", 4, 4)],
        )
        told = referee("check", "-", text="G21 G90\nG1 X5 F100\nG1 X600\nG1 Q\n").stderr
        for problem in problems:
            self.assertIn(problem.message, told)
        with self.assertRaises(motionrack.Error):
            rack.check("G1 X600 F100\n")
        rack.check(TEXT)
        self.assertFalse(rack._world.started())
        self.assertTrue(rack.run(TEXT).ok)

    def test_a_lost_position_prevents_the_next_program(self) -> None:
        rack = Rack.template()
        rack.fault("X", "motor.lose_steps", 64)
        lost = rack.run(TEXT)
        self.assertFalse(lost.position_valid)
        with self.assertRaisesRegex(Refused, "position of axis X is not valid"):
            rack.run(TEXT)
        self.assertTrue(rack.new_instance().run(TEXT).ok)

    def test_a_rack_without_axes_runs_no_program(self) -> None:
        with self.assertRaises(Refused):
            Rack.from_text('card.c1 = "ioflex02"').run(TEXT)

    def test_text_and_path_exclude_each_other(self) -> None:
        for program, path in ((None, None), ("M2", "x.ngc")):
            with self.assertRaises(InvalidInput):
                Rack.template().run(program, path=path)
        with self.assertRaises(motionrack.FileError):
            Rack.template().run(path="/no/such.ngc")

    def test_a_machine_fault_is_the_error_of_the_outcome(self) -> None:
        outcome = Rack.template().run(
            "G21 G90\nG1 X100 F3000\nM2\n", faults=["X.limit_plus=0@500ms", "X.limit_minus=0@100s"]
        )
        self.assertFalse(outcome.ok)
        assert isinstance(outcome.error, MachineFault)
        self.assertEqual(outcome.error.line, 2)
        self.assertEqual(len(outcome.faults_not_done), 1)
        rack = Rack.template()
        for text, faults in (
            ("G1 X600 F100\n", ["X.limit_plus=0@500ms"]),
            (TEXT, ["X.limit_plus=0@500ms", "X.nothing@1s"]),
        ):
            with self.assertRaises(motionrack.Error):
                rack.run(text, faults=faults)
        self.assertEqual(
            rack.run(TEXT).trace_hash, Rack.template().run(TEXT).trace_hash, "what was refused planned nothing"
        )
        with self.assertRaises(MachineFault):
            outcome.check()

    def test_lost_steps_are_no_error_but_not_ok(self) -> None:
        outcome = Rack.template().run("G21 G90\nG1 X20 F1200\nM2\n", faults=["X.motor.lose_steps=64@500ms"])
        self.assertIsNone(outcome.error)
        self.assertFalse(outcome.ok)
        self.assertFalse(outcome.position_valid)
        self.assertEqual(outcome.axes["X"].lost_pulses, 64)
        self.assertTrue(outcome.warnings)


class Progress(unittest.TestCase):
    def test_a_progress_callback_may_read_but_not_move(self) -> None:
        rack = Rack.template()
        seen: list[tuple[float, int, int, float]] = []
        moved: list[str] = []

        def progress(seconds: float, line: int, lines: int) -> None:
            seen.append((seconds, line, lines, rack.parts["X"].position_mm))
            try:
                rack.advance(1)
            except Refused as error:
                moved.append(str(error))

        outcome = rack.run(TEXT, progress=progress)
        self.assertEqual(outcome.trace_hash, Rack.template().run(TEXT).trace_hash)
        self.assertGreater(len(seen), 10)
        self.assertEqual(len(moved), len(seen))
        self.assertEqual(seen, sorted(seen))
        self.assertGreater(max(place for *_, place in seen), 9)

    def test_an_exception_of_a_progress_callback_ends_the_run(self) -> None:
        def progress(seconds: float, line: int, lines: int) -> None:
            raise ZeroDivisionError("enough")

        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            Rack.template().run(TEXT, progress=progress)


class Homing(unittest.TestCase):
    def test_homing_is_that_of_the_command_line(self) -> None:
        for machine in ("machine.toml", "unlucky.toml"):
            with self.subTest(machine):
                path = EXAMPLES / "08_homing" / machine
                homing = Rack.from_file(path).home()
                told = referee("home", "--rack", str(path), "--json")
                self.assertEqual(json.loads(homing.json()), json.loads(told.stdout))
                self.assertEqual(homing.ok, told.returncode == 0)
                self.assertEqual(isinstance(homing.error, MachineFault), not homing.ok)
                self.assertIn("<svg", next(iter(homing.pictures.values())))

    def test_unknown_axes_and_types_are_rejected(self) -> None:
        path = EXAMPLES / "08_homing" / "machine.toml"
        with self.assertRaises(Refused):
            Rack.from_file(path).home(type=7)
        with self.assertRaises(motionrack.Error):
            Rack.from_file(path).home("Q").check()


class Programs(unittest.TestCase):
    def test_start_at_the_positions_of_the_axes(self) -> None:
        rack = Rack.template()
        rack.advance(ms=1)
        first = rack.run("G21 G90\nG1 X10 F1200\nM2\n")
        picture = first.svg()
        rack.advance(ms=1)
        copy = rack.copy()
        second = rack.run("G21 G91\nG1 X5 F1200\nM2\n").check()
        self.assertEqual((round(first.path_mm, 9), round(second.path_mm, 9)), (10, 5))
        self.assertEqual(second.axes["X"].pulses_net * 2, first.check().axes["X"].pulses_net)
        self.assertLess(second.max_deviation.mm, 0.02)
        self.assertAlmostEqual(second.axes["X"].actual_end, 15, delta=0.01)
        self.assertAlmostEqual(float(second.trace["x.position"][0]), 10, delta=0.01)
        self.assertEqual(first.svg(), picture, "what came of the first one stays")
        self.assertEqual(copy.run("G21 G91\nG1 X5 F1200\nM2\n").trace_hash, second.trace_hash)

    def test_start_at_the_positions_after_homing(self) -> None:
        rack = Rack.from_file(EXAMPLES / "08_homing" / "machine.toml")
        self.assertTrue(rack.home().ok)
        outcome = rack.run("G21 G90\nG1 X20 F1200\nM2\n").check()
        self.assertLess(outcome.max_deviation.mm, 0.02)
        self.assertAlmostEqual(outcome.axes["X"].planned_end, 20, delta=0.01)

    def test_have_tools_and_the_subprograms_beside_them(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "part.ngc").write_text("G21 F600\nT3 M6 G43\no<side> call [7]\nM2\n", encoding="utf-8")
            Path(folder, "side.ngc").write_text("o<side> sub\nG1 X#1 Z0\no<side> endsub\n", encoding="utf-8")
            Path(folder, "tools.tbl").write_text("T3 P1 Z2.5\n", encoding="utf-8")
            rack = Rack.template("router")
            with self.assertRaisesRegex(InvalidInput, "no tool table"):
                rack.check(path=f"{folder}/part.ngc")
            with self.assertRaisesRegex(InvalidInput, "no folder to search"):
                rack.check(Path(folder, "part.ngc").read_text(encoding="utf-8"), tools=f"{folder}/tools.tbl")
            with self.assertRaisesRegex(motionrack.FileError, "nowhere.tbl"):
                rack.check(path=f"{folder}/part.ngc", tools=f"{folder}/nowhere.tbl")
            outcome = rack.run(path=f"{folder}/part.ngc", tools=f"{folder}/tools.tbl")
            self.assertIsNone(outcome.error)
            self.assertEqual((outcome.axes["X"].actual_end, outcome.axes["Z"].actual_end), (7, 2.5))


if __name__ == "__main__":
    unittest.main()
