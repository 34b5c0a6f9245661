"""Function libraries from Python: their effects on the cards and the machine, timeouts and refusals."""

from __future__ import annotations

import unittest
from collections.abc import Callable
from pathlib import Path

import motionrack
import numpy as np
from motionrack import MachineFault, Rack, Refused, Timeout

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
X, Y, Z, U = 1, 2, 4, 8
Acts = tuple[Callable[[], object], ...]


class Mcx314(unittest.TestCase):
    def setUp(self) -> None:
        self.rack = Rack.template("router")
        self.card: motionrack.Mcx314 = self.rack.cards["motion"].driver
        self.card.initialise()
        self.card.SetRange(15, 800000)

    def test_a_drive_has_the_duration_of_its_plan(self) -> None:
        plan = motionrack.Mcx314.plan(12000, R=800000, SV=100, V=2000, A=200)
        self.assertEqual((plan["pulses"], plan["top_hz"], plan["reaches_v"]), (12000, 20000.0, True))
        begun = self.rack.ticks
        self.card.TCurve_F(X, 100, 2000, 200, 12000)
        self.card.wait(X, timeout=10)
        self.assertAlmostEqual((self.rack.ticks - begun) * 1e-10, plan["duration_s"], delta=1e-3)
        self.assertEqual(self.card.ReadLPS(0), 12000)
        self.assertAlmostEqual(self.rack.parts["X"].position_mm, 12000 / 640, places=6)

    def test_a_line_and_an_arc_end_at_their_finish_points(self) -> None:
        self.card.Line2D_T(X | Y, (3000, 2000, 0, 0), V=2000, SV=100, A=200)
        self.card.wait(X | Y, timeout=10)
        self.assertEqual([self.card.ReadLPS(axis) for axis in range(4)], [3000, 2000, 0, 0])
        self.card.CircleCCW_C(X | Y, (-1000, 1000, 0, 0), (-1000, 0, 0, 0), V=1000)
        self.card.wait(timeout=10)
        self.assertEqual([self.card.ReadLPS(axis) for axis in range(4)], [2000, 3000, 0, 0])

    def test_a_chain_and_a_bit_pattern_drive(self) -> None:
        self.card.ContStart(V=1000)
        for p in ((500, 0, 0, 0), (500, 500, 0, 0), (0, 500, 0, 0)):
            self.card.ContLine(X | Y, p)
        self.assertEqual(self.card.ContEnd(timeout=10)[0], 3)
        self.assertEqual([self.card.ReadLPS(axis) for axis in range(2)], [1000, 1000])
        self.card.BP2D(X | Y, V=1000)
        self.card.BPStack((0x7FFF, 0x8000, 0), (0x0000, 0x8000, 0))
        self.card.BPStart()
        self.card.BPEnd(timeout=10)
        self.assertEqual(self.card.ReadLPS(0), 1015)

    def test_refusals_write_nothing(self) -> None:
        before = self.rack.state_hash()
        acts: Acts = (
            lambda: self.card.SetV(X, 9000),
            lambda: self.card.SetV(16, 1),
            lambda: self.card.SetV(0, 1),
            lambda: self.card.TCurve_F(X, 0, 1, 1, 1),
            lambda: self.card.ReadLPS(4),
            lambda: self.card.ReadLPS(-1),
            lambda: self.card.wait(0),
            lambda: self.card.wait(X, timeout=-1),
            lambda: self.card.wait(X, timeout=float("nan")),
            lambda: self.card.moving(99),
        )
        for act in acts:
            with self.assertRaises(Refused):
                act()
        self.assertEqual(self.rack.state_hash(), before)
        with self.assertRaises(TypeError):
            self.card.SetV(X, "fast")  # type: ignore[arg-type]

    def test_a_too_short_wait_is_a_timeout_and_the_drive_continues(self) -> None:
        self.card.TCurve_F(X, 100, 2000, 200, 12000)
        with self.assertRaises(Timeout):
            self.card.wait(X, timeout=0.1)
        self.assertTrue(self.card.moving(X))
        self.card.wait(X, timeout=10)

    def test_a_limit_switch_is_a_machine_fault_and_not_a_timeout(self) -> None:
        self.card.TCurve_F(X, 100, 2000, 200, 12000)
        self.rack.advance(ms=100)
        self.rack.wires["X.limit_plus"] = 0
        with self.assertRaises(MachineFault) as caught:
            self.card.wait(X, timeout=10)
        self.assertNotIsInstance(caught.exception, Timeout)
        self.assertIn("limit", self.card.report(0))


class DataBoard(unittest.TestCase):
    def test_the_trim_table_of_a_card_gives_its_voltage(self) -> None:
        rack = Rack.from_text('[card.c1]\ntype = "databoard4002"\ntrim = "0.5 15000, 10 16383"\n')
        board = rack.cards["c1"].driver
        board.connect()
        for rate, volts in ((15000, 0.5), (16383, 10.0)):
            board.set_rate(rate)
            board.set_number(1_000_000)
            board.go()
            rack.advance(ms=1)
            self.assertEqual(rack.wires["c1.vout"], volts)
            self.assertEqual(rack.wires["c1.vdirect"], volts)
            board.quit()
        with self.assertRaisesRegex(motionrack.InvalidInput, "Row 2 of the trim table"):
            Rack.from_text('[card.c1]\ntype = "databoard4002"\ntrim = "0.5 15000, 0.4 16383"\n')

    def test_a_move_follows_its_table(self) -> None:
        rack = Rack.from_text('card.c1 = "databoard4002"')
        board: motionrack.Databoard4002 = rack.cards["c1"].open(counts_per_mm=100)
        board.connect()
        scale = motionrack.SpeedScale(counts_per_pulse=1)
        table = motionrack.SlopeTable.design(5000, 20000, 20000, scale)
        self.assertEqual(len(table.entries()), 48)
        self.assertEqual(motionrack.SlopeTable(table.entries()).entries(), table.entries())
        motion = table.motion(10000, 16383, scale)
        board.set_slope(table)
        board.on_regulation()
        board.set_rate(16383)
        begun = rack.time
        board.move_to(10000, timeout=60)
        self.assertAlmostEqual(rack.time - begun, motion["duration_s"], delta=0.1 * motion["duration_s"])
        self.assertEqual((board.position(), board.position_mm()), (10000, 100.0))
        self.assertRegex(rack.cards["c1"].view(), r"STAT +[0-9A-F]+h(.|\n)*POSITION +10000 +counts")

    def test_timeouts_stops_and_rejections_are_distinguished(self) -> None:
        rack = Rack.from_text('card.c1 = "databoard4002"')
        rack.plan_fault("c1.esr=1@2s")
        board = rack.cards["c1"].driver
        board.connect()
        board.set_slope(motionrack.SlopeTable.design(5000, 20000, 20000, motionrack.SpeedScale(counts_per_pulse=1)))
        board.on_regulation()
        board.set_rate(16383)
        with self.assertRaises(Timeout):
            board.move_to(100000, timeout=0.5)
        with self.assertRaises(MachineFault) as caught:
            board.move_to(100000, timeout=60)
        self.assertNotIsInstance(caught.exception, Timeout)
        self.assertIn("right end stop", board.stops())
        acts: Acts = (
            lambda: board.set_rate(20000),
            lambda: board.set_target(1 << 24),
            lambda: motionrack.SlopeTable([(0, 0)]),
            lambda: motionrack.SpeedScale(),
            lambda: rack.cards["c1"].open(counts_per_mm=0),
        )
        for act in acts:
            with self.assertRaises(Refused):
                act()


class Ioflex(unittest.TestCase):
    def test_an_axis_counts_the_encoder_of_a_motor(self) -> None:
        rack = Rack.from_file(EXAMPLES / "15_panel" / "demonstration.toml")
        flex: motionrack.Ioflex02 = rack.cards["glass"].driver
        self.assertEqual(flex.ReadPosition0(), 0)
        self.assertNotEqual(flex.why, "")
        self.assertEqual(flex.Init(0x2300), 0, flex.why)
        card = rack.cards["motion"].driver
        card.SetRange(15, 800000)
        card.TCurve_F(X, 100, 2000, 200, 6400)
        meter = motionrack.SpeedMeter()
        best = None
        while card.moving(X):
            ticks, axes = flex.read()
            best = meter.update(axes[0]["raw"], axes[0]["age"], ticks) or best
            rack.advance(ms=10)
        self.assertEqual(flex.ReadPosition0(), rack.parts["X"].position_counts)
        self.assertIsNotNone(best)
        with self.assertRaises(Refused):
            flex.set_mode(0, edges=3)
        with self.assertRaises(Refused):
            flex.WriteCmd(0, 0, 0, 9)
        flex.WriteCmd(flex.cResNm, 0, 0, 0)
        with self.assertRaises(Timeout):
            flex.wait_calibrated(0, timeout=0.1)
        flex.WriteCmdAxis(2, flex.cResNmSig)
        self.assertEqual(flex.ReadSts(), (False, True, False, True))
        with self.assertRaises(Refused):
            flex.WriteCmdAxis(4, 0)
        with self.assertRaises(Refused):
            flex.WriteCmdAxis(0, 4)
        self.assertEqual((flex.cVerNo, flex.cVer), (0x0251, "02.51, 07.08.2003"))

    def test_the_sixteen_inputs_are_the_lines_of_the_four_axes(self) -> None:
        rack = Rack.from_text('card.p1 = "ioflex02"')
        flex: motionrack.Ioflex02 = rack.cards["p1"].driver
        self.assertEqual(flex.Init(0x2300), 0, flex.why)
        lines = [f"p1.{line}{axis}" for axis in range(4) for line in ("a", "b", "z", "cal")]
        for number, line in enumerate(lines):
            rack.wires[line] = 1
            self.assertEqual(flex.ReadInL() | flex.ReadInH() << 8, 1 << number, line)
            self.assertEqual(rack.wires[f"p1.in{number}"], 1, line)
            rack.wires[f"p1.in{number}"] = 0

    def test_a_user_image_is_made_inspected_and_loaded(self) -> None:
        make = motionrack.Ioflex02.make_image
        image = make(modes=[1, 0, 0, 0], bits=b"more")
        info = motionrack.Ioflex02.image_info(image)
        self.assertEqual((info["project"], info["ident"], info["payload"]), ("position", 0x25, 12))
        self.assertEqual((info["modes"], info["fits"]), ([1, 0, 0, 0], True))
        rack = Rack.from_text('[card.p1]\ntype = "ioflex02"\npreloaded = false\n')
        flex: motionrack.Ioflex02 = rack.cards["p1"].driver
        self.assertEqual(flex.Configure(image, 0x2300), 0, flex.why)
        rack.advance(us=2)
        rack.wires["p1.a0"] = 1
        rack.advance(us=2)
        self.assertEqual(flex.ReadPosition0(), -1)
        self.assertEqual(flex.Configure(image[:-1]), 1)
        self.assertEqual(flex.Configure(make(ident=0x24)), 3)
        other = make(project="stepper")
        self.assertEqual(flex.Configure(other), 3)
        self.assertIn("another project", flex.why)
        self.assertFalse(motionrack.Ioflex02.image_info(other)["fits"])
        with self.assertRaises(Refused):
            make(project="a name that is too long")
        with self.assertRaises(Refused):
            make(ident=256)
        with self.assertRaises(motionrack.InvalidInput):
            motionrack.Ioflex02.image_info(b"hello")

    def test_the_image_of_a_rack_file_runs_from_the_start_and_is_loaded_by_init(self) -> None:
        text = '[card.p1]\ntype = "ioflex02"\nimage = "{}"\n'
        rack = Rack.from_text(text.format(motionrack.Ioflex02.make_image(modes=[0, 1, 0, 0]).hex()))
        rack.advance(us=2)
        rack.wires["p1.a1"] = 1
        rack.advance(us=2)
        self.assertEqual(rack.peek("p1.1.POSITION"), -1)
        old = Rack.from_text(text.format(motionrack.Ioflex02.make_image(ident=0x24).hex()))
        self.assertEqual(old.cards["p1"].driver.Init(0x2300), 3)
        with self.assertRaises(motionrack.InvalidInput) as raised:
            Rack.from_text(text.format("78zz"))
        self.assertIn("hexadecimal", str(raised.exception))


class Grating(unittest.TestCase):
    def test_all_cards_read_the_same_instant(self) -> None:
        rack = Rack.from_file(EXAMPLES / "13_stage" / "machine.toml")
        rack.advance(us=30_100)  # between two frames: reading takes time
        readings = [rack.cards[name].driver.read() for name in ("host", "scan", "step")]
        for sequence, ticks, counts in readings:
            self.assertEqual((sequence, ticks), readings[0][:2])
            np.testing.assert_array_equal(counts, readings[0][2])
            self.assertEqual((counts.dtype, len(counts)), (np.dtype(np.int64), 6))
        self.assertEqual(rack.bus_conflicts(), 0)
        self.assertIn("<svg", rack.frame_picture())

    def test_a_card_reports_its_list_of_scales(self) -> None:
        rack = Rack.from_text('[card.c1]\ntype = "grating_bus"\naddresses = "5, 2, 9"\n')
        about = rack.cards["c1"].driver.open()
        self.assertEqual((about["scales"], about["first"], about["addresses"]), (3, 5, [5, 2, 9]))
        with self.assertRaises(motionrack.InvalidInput) as raised:
            Rack.from_text('[card.c1]\ntype = "grating_bus"\naddresses = "5, 5"\n')
        self.assertIn("twice", str(raised.exception))

    def test_a_slave_reports_the_scales_addressed_by_its_host(self) -> None:
        rack = Rack.from_text(
            '[card.c1]\ntype = "grating_bus"\naddresses = "5, 2, 9"\n'
            '[card.c2]\ntype = "grating_bus"\nscales = 3\n[card.d]\ntype = "grating_decoder"\nscales = 10\n'
        )
        slave = rack.cards["c2"].driver
        self.assertEqual(slave.addresses(), [])
        slave.wait(0.001)
        self.assertEqual(slave.addresses(), [5, 2, 9])
        self.assertEqual(slave.errors()["alien"], 3)
        self.assertEqual(rack.peek("c2.1.ADDRESS"), 2)

    def test_a_card_that_is_off_has_no_frame_in_time(self) -> None:
        rack = Rack.from_file(EXAMPLES / "13_stage" / "machine.toml")
        rack.fault("host", "off")
        card = rack.cards["scan"].driver
        with self.assertRaises(Timeout):
            card.wait(0.01)
        with self.assertRaises(Refused) as caught:
            card.read()
        self.assertNotIsInstance(caught.exception, Timeout)


class Laser(unittest.TestCase):
    def test_a_list_marks_its_programmed_path(self) -> None:
        rack = Rack.from_file(EXAMPLES / "14_line" / "line.toml")
        rtc: motionrack.Rtc5 = rack.cards["scan"].driver
        k = 5184
        rtc.set_start_list(1)
        rtc.set_mark_speed(100 * k / 1000)
        rtc.mark_abs(5 * k, 0)
        rtc.set_end_of_list()
        rtc.execute_list(1)
        self.assertTrue(rtc.busy())
        with self.assertRaises(Timeout):
            rtc.wait(timeout=0.01)
        rtc.wait(timeout=1)
        self.assertEqual(rtc.output()[:2], (5 * k, 0))
        self.assertAlmostEqual(rack.parts["head"].marked_mm, 5 - 0.05 * 100, delta=6)

    def test_invalid_parameters_are_rejected(self) -> None:
        rtc = Rack.from_file(EXAMPLES / "14_line" / "line.toml").cards["scan"].driver
        rtc.set_start_list(1)
        acts: Acts = (
            lambda: rtc.mark_abs(1),
            lambda: rtc.mark_abs(1.5, 0),
            lambda: rtc.mark_abs(float("nan"), 0),
            lambda: rtc.set_start_list(1, -1),
            lambda: rtc.execute_list(1, -5),
        )
        for act in acts:
            with self.assertRaises(motionrack.Error):
                act()

    def test_a_query_takes_the_stated_time(self) -> None:
        rack = Rack.from_file(EXAMPLES / "14_line" / "line.toml")
        rtc = rack.cards["scan"].driver
        rtc.get_marking_info()
        self.assertEqual(rack.ticks, 100_000)
        rtc.question_seconds = 1e-3
        rtc.read_status()
        self.assertEqual(rack.ticks, 10_100_000)


class Wrong(unittest.TestCase):
    def test_a_library_of_another_card_is_refused(self) -> None:
        rack = Rack.from_file(EXAMPLES / "15_panel" / "demonstration.toml")
        for kind in (
            motionrack.Mcx314,
            motionrack.Databoard4002,
            motionrack.Ioflex02,
            motionrack.GratingCard,
            motionrack.Rtc5,
        ):
            for card in rack.cards.values():
                if not isinstance(card.driver if card.type != "grating_decoder" else None, kind):
                    with self.assertRaises(Refused):
                        kind(rack._world, card.name)
            with self.assertRaises(motionrack.InvalidInput):
                kind(rack._world, "nothing")
        with self.assertRaises(Refused):
            rack.cards["decoder"].open()


if __name__ == "__main__":
    unittest.main()
