"""Racks from Python: time, registers, wires, parts, faults, waits."""

from __future__ import annotations

import gc
import unittest
from collections.abc import Callable
from pathlib import Path

import numpy as np

import motionrack
from motionrack import InvalidInput, MachineFault, Rack, Refused, Timeout

CARD = 'card.c1 = "mcx314"'
Acts = tuple[Callable[[], object], ...]


def command(card: motionrack.Card, axes: int, code: int, value: int = 0) -> None:
    """Writes data and a command of the MCX314 for the axes of a mask."""
    card.WR7 = value >> 16 & 0xFFFF
    card.WR6 = value & 0xFFFF
    card.WR0 = axes << 8 | code


def drive(card: motionrack.Card, pulses: int) -> None:
    """Drives X by this number of pulses at 40,000 pulses/s."""
    for code, value in ((0x00, 800000), (0x02, 400), (0x04, 100), (0x05, 4000), (0x09, 0), (0x06, pulses), (0x20, 0)):
        command(card, 1, code, value)


class Making(unittest.TestCase):
    def test_every_template_makes_a_rack(self) -> None:
        for name in motionrack.templates():
            with self.subTest(name):
                rack = Rack.template(name)
                self.assertEqual(rack.warnings, [])
                self.assertGreater(len(rack.cards), 0)
                self.assertEqual(Rack.from_text(motionrack.template_text(name)).name, rack.name)

    def test_an_invalid_rack_file_reports_every_problem_with_its_location(self) -> None:
        with self.assertRaises(InvalidInput) as caught:
            Rack.from_text('[card.c1]\ntype = "mcx999"\n\n[axis.X]\ncard = "c2"\n', "my.toml")
        self.assertGreaterEqual(len(caught.exception.problems), 2)
        self.assertEqual((caught.exception.file, caught.exception.line), ("my.toml", 2))
        self.assertTrue(str(caught.exception).startswith("my.toml:2:"))

    def test_a_missing_file_is_a_file_error(self) -> None:
        with self.assertRaises(motionrack.FileError):
            Rack.from_file("/no/such.toml")

    def test_a_path_passed_to_the_constructor_is_reported_with_the_remedy(self) -> None:
        with self.assertRaisesRegex(TypeError, r"not created by Rack\('my.toml'\). Use Rack.from_file"):
            Rack("my.toml")  # type: ignore[arg-type]

    def test_all_errors_are_of_one_kind(self) -> None:
        for kind in (InvalidInput, Refused, MachineFault, Timeout, motionrack.FileError, motionrack.Stopped):
            self.assertTrue(issubclass(kind, motionrack.Error))
        self.assertTrue(issubclass(Timeout, TimeoutError))

    def refuse_everything(self) -> None:
        rack = Rack.from_text(CARD)
        driver = rack.cards["c1"].driver
        rack.close()
        rack.close()
        acts: Acts = (
            lambda: rack.advance(1),
            lambda: rack.time,
            lambda: rack.wires["estop"],
            driver.RESET,
            lambda: rack.cards["c1"].peek("RR0"),
        )
        for act in acts:
            with self.assertRaises(Refused):
                act()
        self.assertIn("closed", repr(rack))

    def test_a_closed_rack_and_its_drivers_reject_every_call(self) -> None:
        self.refuse_everything()
        gc.collect()


class Time(unittest.TestCase):
    def test_time_is_exact_to_the_tick(self) -> None:
        rack = Rack.from_text(CARD)
        rack.advance(ms=1, us=2, ns=3)
        self.assertEqual(rack.ticks, 10_020_030)
        rack.advance(0.1)
        rack.advance(0.2)
        self.assertEqual(rack.ticks, 3_010_020_030)
        self.assertAlmostEqual(rack.time, 0.301002003, places=12)

    def test_impossible_times_are_rejected(self) -> None:
        rack = Rack.from_text(CARD)
        for seconds in (-1, float("nan"), float("inf"), 1e30):
            with self.subTest(seconds), self.assertRaises(Refused):
                rack.advance(seconds)
        self.assertEqual(rack.ticks, 0)

    def test_a_wait_for_a_condition_ends_when_it_is_true_or_at_its_timeout(self) -> None:
        rack = Rack.from_text(CARD)
        drive(rack.cards["c1"], 20000)
        rack.wait(lambda: rack.peek("c1.x.LP") >= 1000, timeout=1, poll=1e-4)
        self.assertLess(rack.peek("c1.x.LP"), 1000 + 40000 * 1e-4 + 1)
        before = rack.ticks
        with self.assertRaises(Timeout):
            rack.wait(lambda: False, timeout=0.25)
        self.assertEqual(rack.ticks - before, 2_500_000_000)
        with self.assertRaises(Refused):
            rack.wait(lambda: True, timeout=1, poll=0)

    def test_a_wait_for_a_wire_ends_at_its_exact_instant(self) -> None:
        """Compares the instant with a copy of the rack, advanced to one chip clock (125 ns) before it, then to it."""
        rack = Rack.template("router")
        driver = rack.cards["motion"].driver
        driver.initialise()
        driver.SetRange(15, 800000)
        driver.EnableInterrupt(1, 0x80)  # the end of a drive
        driver.TCurve_F(1, 100, 2000, 200, 300)
        referee = rack.copy()
        rack.wait_wire("motion.int_n", 0, timeout=5)
        self.assertEqual(rack.wires["motion.int_n"], 0)
        referee.advance(ns=(rack.ticks - referee.ticks) // 10 - 125)
        self.assertEqual(referee.wires["motion.int_n"], 1)
        referee.advance(ns=125)
        self.assertEqual(referee.wires["motion.int_n"], 0)
        with self.assertRaises(Timeout):
            rack.wait_wire("estop", 0, timeout=1e-3)
        with self.assertRaises(InvalidInput):
            rack.wait_wire("no.such", 0, timeout=1e-3)

    def test_a_wait_ends_at_an_interrupt(self) -> None:
        rack = Rack.from_text(CARD)
        card = rack.cards["c1"]
        card.driver.SetRange(15, 800000)
        card.driver.EnableInterrupt(1, 0x80)
        card.driver.TCurve_F(1, 100, 2000, 200, 300)
        card.wait_interrupt(5)
        self.assertEqual(card.driver.read_interrupts(0), 0x80)
        with self.assertRaises(Timeout):
            card.wait_interrupt(0.01)

    def test_impossible_time_outs_are_rejected(self) -> None:
        rack = Rack.template("router")
        for timeout in (-1.0, -1, -1e-9, float("nan"), float("inf"), 1e12):
            with self.subTest(timeout):
                with self.assertRaises(Refused):
                    rack.cards["motion"].wait_interrupt(timeout)
                with self.assertRaises(Refused):
                    rack.home(timeout=timeout)
        self.assertEqual(rack.ticks, 0)


class Registers(unittest.TestCase):
    def test_peeking_has_no_side_effect_and_reading_has(self) -> None:
        rack = Rack.from_text(CARD)
        card = rack.cards["c1"]
        card.WR0 = 0x010F  # X: its registers are shown
        card.WR1 = 0x8000  # interrupt at the drive's end
        drive(card, 100)
        rack.advance(1)
        before = rack.ticks
        self.assertEqual(card.x.RR3.DEND, 1)
        self.assertEqual(card.RR3.peek().DEND, 1)
        self.assertEqual(card.RR3.dend, 1)
        self.assertEqual(rack.ticks, before)
        self.assertEqual(card.RR3.read().DEND, 1)
        self.assertGreater(rack.ticks, before)
        self.assertEqual(card.RR3.DEND, 0)

    def test_fields_are_written_by_their_names(self) -> None:
        card = Rack.from_text(CARD).cards["c1"]
        card.WR0.write(CODE=0x0F, Y=1)  # Y's registers
        card.WR1.write(0x8000)
        self.assertEqual((int(card.x.WR1), int(card.y.WR1)), (0, 0x8000))
        for wrong in ({"CODE": 1000}, {"CODE": -1}):
            with self.assertRaises(Refused):
                card.WR0.write(**wrong)
        with self.assertRaises(InvalidInput):
            card.WR0.write(NOPE=1)
        for value in (-1, 0x10000):
            with self.assertRaises(Refused):
                card.WR0 = value
        with self.assertRaises(Refused):
            card.RR0.write(1)
        with self.assertRaises(Refused):
            card.WR0.read()

    def test_unknown_registers_are_not_attributes(self) -> None:
        card = Rack.from_text(CARD).cards["c1"]
        acts: Acts = (
            lambda: card.WR99,
            lambda: card.RR0.NOPE,
            lambda: card.x.NOPE,
            lambda: setattr(card, "WR99", 1),
            lambda: setattr(card.RR0, "DRV", 1),
        )
        for act in acts:
            with self.assertRaises(AttributeError):
                act()

    def test_every_kind_of_card_has_its_map_and_every_register_can_be_shown(self) -> None:
        rack = Rack.from_file(Path(__file__).parents[2] / "examples" / "15_panel" / "demonstration.toml")
        self.assertEqual(
            {card.type for card in rack.cards.values()},
            {"mcx314", "databoard4002", "ioflex02", "grating_bus", "grating_decoder", "rtc5"},
        )
        for card in rack.cards.values():
            with self.subTest(card.type):
                self.assertIn(card.name, repr(card))
                self.assertIn("<table>", card._repr_html_())
                self.assertGreater(len(card.registers), 3)
                for value in card.values:
                    self.assertIsInstance(card.peek(value), int)
                for register in card.registers.values():
                    self.assertIn(register.name, repr(register))
        self.assertEqual(rack.ticks, 0)

    def test_every_register_reads_the_value_that_it_shows(self) -> None:
        rack = Rack.from_file(Path(__file__).parents[2] / "examples" / "15_panel" / "demonstration.toml")
        for card in (rack.cards["motion"], rack.cards["host"]):
            for register in card.registers.values():
                if register.access == "read" and not register._reg["bank"]:
                    with self.subTest(f"{card.name}.{register.name}"):
                        try:
                            shown = register.peek()
                        except InvalidInput:
                            continue
                        self.assertIn(register.read(), (shown, register.peek()))


class Machine(unittest.TestCase):
    def test_wires_are_forced_and_released(self) -> None:
        rack = Rack.template("router")
        self.assertEqual(rack.wires["X.limit_plus"], 1)
        rack.wires["X.limit_plus"] = 0
        self.assertEqual(rack.wires["X.limit_plus"], 0)
        self.assertEqual(rack.cards["motion"].x.RR2.HLMTP, 1)
        del rack.wires["X.limit_plus"]
        self.assertEqual(rack.wires["X.limit_plus"], 1)
        self.assertIn("estop", rack.wires.drivable)
        with self.assertRaises(InvalidInput):
            rack.wires["X.nothing"] = 1
        with self.assertRaises(Refused):
            rack.wires["estop"] = 0.5

    def test_parts_report_true_quantities_and_can_be_pushed(self) -> None:
        rack = Rack.template("router")
        x = rack.parts["X"]
        self.assertEqual(x.position_mm, 0)
        x.position_mm = 5
        self.assertAlmostEqual(x.position_mm, 5, delta=0.5)
        self.assertGreater(x.lost_pulses**2, 0)
        self.assertEqual(x.position_mm, rack.get("X.position_mm"))
        with self.assertRaises(Refused):
            x.top_speed_mm_s = 1
        with self.assertRaises(AttributeError):
            x.nothing
        with self.assertRaises(InvalidInput):
            rack.parts["Q"]
        for part in rack.parts.values():
            for quantity in part.quantities:
                self.assertIsInstance(getattr(part, quantity), float)

    def test_faults_are_injected_and_cleared(self) -> None:
        rack = Rack.template("router")
        self.assertIn("encoder.broken_a", rack.faults["X"])
        rack.fault("X", "motor.stall")
        driver = rack.cards["motion"].driver
        driver.SetRange(15, 800000)
        driver.TCurve_F(1, 100, 2000, 200, 6400)
        driver.wait(1)
        self.assertEqual(rack.parts["X"].position_mm, 0)
        self.assertEqual(driver.ReadLPS(0), 6400)
        conditions = rack.conditions
        self.assertTrue(any("X" in one.text for one in conditions))
        self.assertEqual([one.number for one in conditions], list(range(1, len(conditions) + 1)))
        self.assertEqual({one.source for one in conditions}, {"X"})
        for target, fault in (("X", "no.such"), ("Q", "motor.stall")):
            with self.assertRaises(InvalidInput):
                rack.fault(target, fault)

    def test_planned_faults_are_injected_at_their_instant(self) -> None:
        rack = Rack.template("router")
        rack.plan_fault("X.limit_plus", np.int64(0), at=np.float64(0.5))  # type: ignore[arg-type]  # NumPy's, too
        rack.plan_fault("X.limit_plus=release@600ms")
        rack.advance(ms=499)
        self.assertEqual(rack.wires["X.limit_plus"], 1)
        rack.advance(ms=2)
        self.assertEqual(rack.wires["X.limit_plus"], 0)
        rack.advance(ms=100)
        self.assertEqual(rack.wires["X.limit_plus"], 1)
        with self.assertRaises(Refused):
            rack.plan_fault("estop=0@2s")
        with self.assertRaises(InvalidInput):
            rack.new_instance().plan_fault("X.nothing=0@2s")

    def test_a_card_is_changed_before_time_starts(self) -> None:
        rack = Rack.from_text('[card.d]\ntype = "grating_decoder"\n[card.h]\ntype = "grating_bus"\n')
        rack.change_card("h", period_us=250)
        self.assertEqual(rack.cards["h"].driver.open()["period"], 250e-6)
        with self.assertRaises(Refused):
            rack.change_card("h", period_us=300)
        fresh = Rack.from_text('[card.d]\ntype = "grating_decoder"\n[card.h]\ntype = "grating_bus"\n')
        for value in (float("nan"), -1, 1e12):
            with self.assertRaises(Refused):
                fresh.change_card("h", period_us=value)
        with self.assertRaises(InvalidInput):
            fresh.change_card("h", nothing=1)


if __name__ == "__main__":
    unittest.main()
