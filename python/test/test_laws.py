"""The laws of sessions: each detects a history that violates it, and the racks of these tests are checked."""

from __future__ import annotations

import sys
import unittest
from copy import copy
from typing import Any

import laws
from motionrack import Machine, Rack

CARD = 'card.c1 = "mcx314"'


def stopped(ticks: int, state: str, x: float) -> dict[str, Any]:
    """Returns a status of a machine."""
    return {"ticks": ticks, "state": state, "axes": {"X": {"true_position": x}}}


class Laws(unittest.TestCase):
    def setUp(self) -> None:
        rack = Rack.from_text(CARD)
        rack.advance(1e-3)
        self.before = laws.Picture(rack._world)
        self.now = copy(self.before)
        self.now.ticks += 1_000_000_000

    def test_a_counter_that_goes_by_other_than_the_pulses_is_found(self) -> None:
        self.now.pulses = {**self.before.pulses, "X": 2**32 + 40}
        self.now.counters = {**self.before.counters, "X": 40}
        laws.check_counters(self.before, self.now)
        self.now.counters["X"] = 39
        with self.assertRaisesRegex(AssertionError, "axis X was sent 4294967336 pulses and its counter went by 39"):
            laws.check_counters(self.before, self.now)

    def test_motion_without_an_order_is_found(self) -> None:
        laws.check_rest(self.before, self.now)
        self.now.pulses = {**self.before.pulses, "Y": -1}
        with self.assertRaisesRegex(AssertionError, "axis Y was sent -1 pulses without an order"):
            laws.check_rest(self.before, self.now)

    def test_a_velocity_above_the_limit_is_found(self) -> None:
        limit = self.now.channels["X"][2]
        self.now.pulses = {**self.before.pulses, "X": int(limit * 0.1)}
        laws.check_velocities(self.before, self.now)
        self.now.pulses["X"] = int(limit * 0.11)
        with self.assertRaisesRegex(AssertionError, "axis X made"):
            laws.check_velocities(self.before, self.now)

    def test_an_error_stop_that_does_not_hold_is_found(self) -> None:
        before = stopped(5, "error stop", 10)
        laws.check_error_stop(before, stopped(6, "error stop", 10.01))
        for now, words in (
            (stopped(4, "error stop", 10), "time went back"),
            (stopped(6, "moving", 10), "ended without a reset"),
            (stopped(6, "error stop", 10.1), "axis X moved by"),
        ):
            with self.assertRaisesRegex(AssertionError, words):
                laws.check_error_stop(before, now)

    def test_racks_and_machines_of_a_test_are_under_them(self) -> None:
        under = sys.modules["__main__"]
        self.assertTrue(str(under.__file__).endswith("laws.py"), "these tests are run by: python -m laws test_laws")
        checks: list[str] = getattr(under, "checks")
        before = len(checks)
        rack = Rack.from_text(CARD)
        rack.advance(1e-3)
        rack.advance(1e-3)
        driven = Rack.template("router")
        driven.run("G21 G90\nG1 X5 F600\nM2\n")
        Machine.template("router").advance(0.01)
        self.assertEqual(checks[before:], ["advance", "end", "machine"])


if __name__ == "__main__":
    unittest.main()
