"""A machine operated step by step: hold and resume, jogs, homing, alarms; the same commands give the same trace."""

from __future__ import annotations

import gc
import os
import signal
import threading
import unittest
from collections.abc import Callable
from pathlib import Path

import motionrack
from motionrack import Machine, Refused, Timeout

Acts = tuple[Callable[[], object], ...]
TEXT = "G21 G90\nG1 X40 F2400\nG1 X0\nM2\n"
HOMING = Path(__file__).resolve().parents[2] / "examples" / "08_homing" / "machine.toml"


def ready() -> Machine:
    machine = Machine.template("router")
    machine.enable()
    for letter, axis in machine.wait("standstill", timeout=1).axes.items():
        if not axis.position_valid:
            machine.set_position(letter, axis.commanded)
    machine.wait(
        lambda status: status.state == "standstill" and all(axis.position_valid for axis in status.axes.values()),
        timeout=1,
    )
    return machine


def operated() -> tuple[str, float, str]:
    """Runs a program with a feed hold, then a jog; returns trace hash, X in the hold, and Y with ticks at the end."""
    with ready() as machine:
        machine.start_program(TEXT, "there.ngc")
        machine.advance(0.5)
        machine.hold()
        machine.wait("hold", timeout=1)
        place = machine.get("X.position_mm")
        machine.advance(1)
        assert machine.get("X.position_mm") == place
        machine.resume()
        machine.wait("standstill", timeout=10)
        machine.jog_by("Y", 5, 10)
        machine.wait(lambda status: status.axes["Y"].true_position > 4.999, timeout=5)
        status = machine.wait("standstill", timeout=1)
        return machine.trace_hash(), place, f"{status.axes['Y'].true_position:.3f} {status.ticks}"


class Operating(unittest.TestCase):
    def test_the_same_commands_at_the_same_times_give_the_same_event_trace(self) -> None:
        first = operated()
        self.assertTrue(0 < first[1] < 40)
        for _ in range(3):
            self.assertEqual(operated(), first)

    def test_time_advances_in_whole_slices_and_only_on_request(self) -> None:
        machine = Machine.template("router")
        self.assertEqual(machine.status.ticks, machine.status.ticks)
        before = machine.status.ticks
        machine.advance(ms=20)
        self.assertEqual(machine.status.ticks - before, 200_000_000)
        with self.assertRaises(Timeout):
            machine.wait("moving", timeout=0.1)

    def test_invalid_commands_are_rejected(self) -> None:
        machine = Machine.template("router")
        acts: Acts = (
            lambda: machine.start_program(TEXT),
            lambda: machine.resume(),
            lambda: machine.jog("X", 5),
            lambda: machine.set_overrides(9),
            lambda: machine.jog_by("XY", 1, 1),
        )
        for act in acts:
            with self.assertRaises(Refused):
                act()
        machine = ready()
        with self.assertRaises(motionrack.Error) as caught:
            machine.start_program("G21\nG1 X999 F100\n", "bad.ngc")
        self.assertEqual(caught.exception.line, 2)
        with self.assertRaises(motionrack.InvalidInput):
            machine.wire("no.such")

    def test_after_a_stop_no_line_is_executed_and_a_reset_moves_nothing(self) -> None:
        machine = ready()
        machine.start_program(TEXT, "there.ngc")
        machine.advance(0.5)
        machine.stop()
        machine.wait("error stop", timeout=1)
        place = machine.get("X.position_mm")
        self.assertTrue(0 < place < 40)
        acts: Acts = (lambda: machine.start_program(TEXT), machine.resume, lambda: machine.jog("X", 5))
        for act in acts:
            with self.assertRaises(Refused):
                act()
        machine.advance(2)
        self.assertEqual(machine.get("X.position_mm"), place)
        machine.reset()
        machine.wait("standstill", timeout=1)
        machine.advance(2)
        self.assertEqual(machine.get("X.position_mm"), place)

    def test_a_limit_switch_is_an_error_stop_with_an_alarm(self) -> None:
        machine = ready()
        machine.start_program(TEXT, "there.ngc")
        machine.advance(0.5)
        machine.set_wire("X.limit_plus", 0)
        status = machine.wait("error stop", timeout=2)
        self.assertIn("limit", status.reason + " ".join(alarm.text for alarm in status.alarms))
        machine.set_wire("X.limit_plus", None)
        machine.acknowledge_alarm(status.alarms[-1].number)
        machine.reset()
        machine.wait(lambda status: status.state in ("standstill", "disabled"), timeout=2)

    def test_homing_makes_positions_valid(self) -> None:
        with Machine.from_file(HOMING) as machine:
            self.assertFalse(all(axis.position_valid for axis in machine.status.axes.values()))
            machine.enable()
            machine.home()
            machine.wait(
                lambda status: status.state == "standstill"
                and all(axis.position_valid for axis in status.axes.values()),
                timeout=60,
            )

    def test_a_machine_may_be_closed_during_motion(self) -> None:
        machine = ready()
        machine.start_program(TEXT)
        machine.advance(0.3)
        machine.close()
        machine.close()
        with self.assertRaises(Refused):
            machine.advance(1)
        left = ready()
        left.start_program(TEXT)
        left.advance(0.3)
        del left
        gc.collect()

    def test_ctrl_c_ends_a_wait_and_the_machine_continues(self) -> None:
        machine = ready()
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                machine.advance(1e6)
        finally:
            timer.join()
            signal.signal(signal.SIGINT, before)
        at = machine.status.ticks
        machine.advance(ms=10)
        self.assertEqual(machine.status.ticks - at, 100_000_000)


if __name__ == "__main__":
    unittest.main()
