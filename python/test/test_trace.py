"""Recordings: samples equal the values read at each instant; pictures with and without matplotlib."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

import motionrack
import numpy as np
from motionrack import FileError, InvalidInput, Rack, Refused

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SIGNALS = ("X.position_mm", "X.position_pulses", "motion.x.LP", "motion.x.CV", "X.limit_plus", "motion.RR0")


def moving() -> Rack:
    rack = Rack.template("router")
    card = rack.cards["motion"].driver
    card.SetRange(15, 800000)
    card.TCurve_F(1, 100, 2000, 200, 3000)
    return rack


def look(rack: Rack, signal: str) -> float:
    if signal in rack.wires:
        return rack.wires[signal]
    return rack.peek(signal) if signal.startswith("motion.") else rack.get(signal)


class Recordings(unittest.TestCase):
    def test_a_recording_samples_each_instant_without_an_effect(self) -> None:
        rack = moving()
        referee = rack.copy()
        with rack.record(*SIGNALS, period=1e-3) as recording:
            rack.advance(ms=150)
            rack.cards["motion"].driver.wait(1, timeout=10)  # a driver's waiting is recorded, too
            rack.advance(ms=10)
        trace = recording.trace
        self.assertGreater(len(trace.ticks), 150)
        for i, ticks in enumerate(trace.ticks):
            referee.advance(ns=(int(ticks) - referee.ticks) // 10)
            for signal in SIGNALS:
                self.assertEqual(trace[signal][i], look(referee, signal), f"{signal} at {ticks}")
        np.testing.assert_array_equal(np.diff(trace.ticks)[:-1], 10_000_000)
        self.assertEqual(trace["X.position_mm"].dtype, np.float64)
        for signal in SIGNALS[1:]:
            self.assertEqual(trace[signal].dtype, np.int64)
        self.assertEqual((trace.units["X.position_mm"], trace.units["X.position_pulses"]), ("mm", "pulses"))

    def test_counters_are_integers(self) -> None:
        rack = Rack.from_file(EXAMPLES / "13_stage" / "machine.toml")
        stage = next(name for name, of in rack.parts.items() if "unused_frames" in of.quantities)
        counted = ("scale_counts", "lost_counts", "trusted", "closed", "unused_frames")
        measured = ("position_mm", "drive_v")
        card = next(name for name, card in rack.cards.items() if card.type == "grating_bus")
        with rack.record(*(f"{stage}.{name}" for name in counted + measured), f"{card}.age_us") as recording:
            rack.advance(ms=5)
        self.assertEqual(recording.trace.units[f"{card}.age_us"], "us")
        for name in counted:
            self.assertEqual(recording.trace[f"{stage}.{name}"].dtype, np.int64, name)
        for name in measured:
            self.assertEqual(recording.trace[f"{stage}.{name}"].dtype, np.float64, name)

    def test_signals_have_their_units(self) -> None:
        rack = Rack.from_file(EXAMPLES / "15_panel" / "demonstration.toml")
        units = {
            f"{card}.{name}": unit
            for card, of in rack.cards.items()
            if of.type == "rtc5"
            for name, unit in (
                ("mark_speed_bits_ms", "bits/ms"),
                ("corrected_x_bits", "bits"),
                ("encoder_speed_counts_ms", "counts/ms"),
            )
        }
        self.assertTrue(units)
        recording = rack.record(*units)
        self.assertEqual(recording.stop().units, units)
        board = Rack.from_text('card.b1 = "databoard4002"')
        self.assertEqual(board.record("b1.vout", "b1.relay").stop().units, {"b1.vout": "V", "b1.relay": ""})

    def test_a_program_may_be_recorded_with_the_same_event_trace(self) -> None:
        text = "G21 G90\nG1 X5 F600\nM2\n"
        rack = Rack.template()
        with rack.record("X.position_mm", period=5e-4) as recording:
            outcome = rack.run(text)
        self.assertEqual(outcome.trace_hash, Rack.template().run(text).trace_hash)
        self.assertEqual(recording.trace.hash(), outcome.trace_hash)
        at = np.searchsorted(recording.trace.ticks, outcome.trace.ticks[100])
        self.assertAlmostEqual(
            float(recording.trace["X.position_mm"][at]), float(outcome.trace["X.position"][100]), delta=0.02
        )

    def test_too_many_instants_are_decimated_evenly(self) -> None:
        rack = moving()
        with rack.record("motion.x.LP", period=1e-4, max_samples=100) as recording:
            rack.advance(ms=200.25)
        ticks = recording.trace.ticks
        self.assertEqual(ticks[-1], rack.ticks, "the end is kept")
        self.assertEqual(recording.trace["motion.x.LP"][-1], rack.peek("motion.x.LP"))
        self.assertEqual(len(recording.trace["motion.x.LP"]), len(ticks))
        self.assertLessEqual(len(ticks), 100)
        self.assertGreater(len(ticks), 40)
        self.assertEqual(len(set(np.diff(ticks)[:-1])), 1)

    def test_only_existing_signals_are_recorded_one_recording_at_a_time(self) -> None:
        rack = moving()
        with self.assertRaises(InvalidInput):
            rack.record("X.nothing")
        with self.assertRaises(InvalidInput):
            rack.record("nothing")
        for every in (0, -1, 1e-9, 1e9):
            with self.assertRaises(Refused):
                rack.record("X.position_mm", period=every)
        recording = rack.record("X.position_mm")
        with self.assertRaises(Refused):
            rack.record("X.position_mm")
        with self.assertRaises(Refused):
            recording.trace
        with self.assertRaises(Refused):
            rack.restore(rack.copy().snapshot())
        self.assertEqual(len(recording.stop().ticks), 1)
        self.assertIs(recording.stop(), recording.trace)

    def test_waves_are_those_of_the_recorder(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            rack = moving()
            with rack.waves(f"{folder}/a.vcd", "X.*"):
                rack.advance(ms=100)
            text = Path(f"{folder}/a.vcd").read_text(encoding="utf-8")
            self.assertIn("$enddefinitions", text)
            self.assertIn("step", text)
            with self.assertRaises(Refused):
                rack.waves(f"{folder}/a.txt")

    def test_waves_do_not_depend_on_the_division_of_time(self) -> None:
        texts = []
        with tempfile.TemporaryDirectory() as folder:
            for step_us in (21_000, 3):
                rack = Rack.from_text('card.c1 = "mcx314"')
                card = rack.cards["c1"]
                for axis, speed in ((1, 4000), (2, 3900)):  # pulses at every distance from those of the other axis
                    for code, value in ((0, 800_000), (2, 400), (4, speed), (5, speed), (6, 100_000), (0x20, 0)):
                        card.WR7, card.WR6, card.WR0 = value >> 16, value & 0xFFFF, axis << 8 | code
                with rack.waves(f"{folder}/a.csv", "*.step"):
                    for _ in range(21_000 // step_us):
                        rack.advance(us=step_us)
                texts.append(Path(f"{folder}/a.csv").read_text(encoding="utf-8"))
        self.assertGreater(texts[0].count(",X.step,1"), 700)
        self.assertGreater(texts[0].count(",Y.step,1"), 700)
        self.assertEqual(texts[0], texts[1])

    def test_closing_a_rack_reports_a_failed_recording(self) -> None:
        rack = moving()
        with tempfile.TemporaryDirectory() as folder:
            rack.waves(f"{folder}/a.vcd", "X.*")
            rack.advance(ms=10)
        with self.assertRaises(FileError):  # its folder is gone
            rack.close()
        self.assertIn("closed", repr(rack))
        rack.close()
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(FileError), moving() as rack, rack.waves(f"{folder}/a.vcd", "X.*"):
                shutil.rmtree(folder)
                rack.close()
            Path(folder).mkdir()

    def test_a_recording_of_waves_has_the_version_that_wrote_it(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            with moving().waves(f"{folder}/a.h5", "X.*"):
                pass
            self.assertIn(f"motionrack {motionrack.__version__}".encode(), Path(f"{folder}/a.h5").read_bytes())

    @unittest.skipUnless(shutil.which("sigrok-cli") and shutil.which("vcd2fst"), "sigrok-cli or gtkwave is missing")
    def test_waves_are_read_by_sigrok_and_vcd2fst(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            rack = moving()
            with rack.waves(f"{folder}/a.vcd", "X.*"):
                rack.advance(ms=100)
            counted = subprocess.run(
                ["sigrok-cli", "-I", "vcd", "-i", f"{folder}/a.vcd"]
                + ["-P", "counter:data=X_step:data_edge=rising", "-A", "counter=edge_count"],
                capture_output=True,
                text=True,
                check=True,
            ).stdout.split()
            self.assertEqual(int(counted[-1]), rack.peek("motion.x.LP"))
            self.assertGreater(rack.peek("motion.x.LP"), 10)
            subprocess.run(["vcd2fst", f"{folder}/a.vcd", f"{folder}/a.fst"], capture_output=True, check=True)
            self.assertGreater(Path(f"{folder}/a.fst").stat().st_size, 0)


class Pictures(unittest.TestCase):
    def trace(self) -> motionrack.Trace:
        return Rack.template().run("G21 G90\nG1 X5 F600\nM2\n").trace

    def test_the_picture_of_the_project_is_valid_svg(self) -> None:
        trace = self.trace()
        for svg in (trace.svg("x.position", "x.velocity"), trace._repr_svg_()):
            root = xml.etree.ElementTree.fromstring(svg or "")
            self.assertTrue(root.tag.endswith("svg"))
        with self.assertRaises(InvalidInput):
            trace.svg("nothing")
        with self.assertRaises(Refused):
            trace.svg("x.position", width=1)

    def test_without_matplotlib_a_plot_is_the_trace_that_a_notebook_shows(self) -> None:
        program = """
import sys
sys.modules["matplotlib"] = sys.modules["matplotlib.figure"] = None
import motionrack
trace = motionrack.Rack.template().run("G1 X5 F600\\n").trace
assert trace.plot("x.position", path=sys.argv[1]) is trace and "<svg" in trace._repr_svg_()
try:
    trace.plot("x.position", path=sys.argv[1] + ".png")
except motionrack.InvalidInput as error:
    assert "does not end in .svg" in str(error)
else:
    raise AssertionError("an SVG file was called .png")
"""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-c", program, f"{folder}/a.svg"], check=True, timeout=60)
            self.assertIn("<svg", Path(f"{folder}/a.svg").read_text(encoding="utf-8"))

    def test_with_matplotlib_a_plot_is_a_figure(self) -> None:
        try:
            from matplotlib.figure import Figure  # type: ignore[import]
        except ImportError:
            self.skipTest("matplotlib is not there")
        with tempfile.TemporaryDirectory() as folder:
            figure = self.trace().plot("x.position", "x.velocity", "deviation", path=f"{folder}/a.png")
            self.assertIsInstance(figure, Figure)
            self.assertEqual(len(figure.axes), 3)
            self.assertGreater(Path(f"{folder}/a.png").stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
