"""Real cards from Python, with a virtual MCX314 in the card's place that another process serves in real time, so that
every access is a system call: `live_server port --real-time python3 -m unittest test_live_served`."""

from __future__ import annotations

import contextlib
import io
import os
import re
import signal
import threading
import unittest
from pathlib import Path

from motionrack import LiveCard, Stopped, Timeout

PLACE = os.environ["MOTIONRACK_LIVE_PORT"]
PAGE = Path(__file__).resolve().parents[2] / "docs" / "howto" / "live-port.md"
X, Y, Z, U = 1, 2, 4, 8


class Page(unittest.TestCase):
    def test_its_program_moves_the_card(self) -> None:
        block = re.search(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
        assert block
        place = "port:/dev/port,offset=0x300,width=8"
        self.assertIn(place, block[1])
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            exec(compile(block[1].replace(place, PLACE), str(PAGE), "exec"), {})
        self.assertEqual(said.getvalue(), "X stands at LP 2000 and drives: 0\n")


class Served(unittest.TestCase):
    def setUp(self) -> None:
        self.card = LiveCard(PLACE)
        self.addCleanup(self.card.close)

    def test_the_function_library_moves_it(self) -> None:
        call = self.card.library
        call.RESET()
        call.SetRange(800000)
        begun = self.card.seconds
        self.assertEqual(call.TCurve_F(X, 100, 2000, 400, 2000), "X drives.")
        with self.assertRaises(Timeout):
            call.wait(X, 1)
        call.wait(X, 10_000)
        self.assertGreater(self.card.seconds - begun, 0.1)
        self.assertEqual([call.ReadLPS(axis) for axis in (X, Y, Z, U)], [2000, 0, 0, 0])
        call.Line2D_C(V=1000, PX=-500, PY=300, PZ=0, PU=0, axis=X | Y)
        call.wait(X | Y, 10_000)
        self.assertEqual((call.ReadLPS(X), call.ReadLPS(Y)), (1500, 300))
        self.assertEqual(self.card.RR0.read().DRV, 0)
        self.assertRegex(self.card.view(), r"LP +X +1500")

    def test_the_driver_moves_it_as_a_virtual_card(self) -> None:
        card = self.card.driver
        card.initialise()
        card.SetRange(15, 800000)
        card.TCurve_F(X, 100, 2000, 400, 1000)
        card.wait(X, timeout=10)
        self.assertEqual(card.ReadLPS(0), 1000)

    def test_its_interrupt_ends_a_wait(self) -> None:
        card = self.card.driver
        card.initialise()
        card.SetRange(15, 800000)
        card.EnableInterrupt(X, 0x80)
        card.TCurve_F(X, 100, 2000, 400, 1000)
        self.card.wait_interrupt(10)
        self.assertFalse(card.moving(X))

    def test_ctrl_c_ends_its_pulses_and_a_program_continues_after_the_reset(self) -> None:
        call = self.card.library
        call.RESET()
        call.SetRange(800000)
        call.contour_begin(SV=100, V=1000, A=0, D=0)
        call.contour_line(axis=X | Y, PX=20_000, PY=0, PZ=0, PU=0, V=0)
        call.contour_line(axis=X | Y, PX=0, PY=20_000, PZ=0, PU=0, V=0)
        interrupt = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
        interrupt.start()
        with self.assertRaises(KeyboardInterrupt):
            call.contour_end()
        interrupt.join()
        self.assertEqual(self.card.RR0.read().DRV, 0)
        with self.assertRaises(Stopped):
            call.ReadLPS(X)
        self.card.reset_stop()
        where = call.ReadLPS(X), call.ReadLPS(Y)
        self.assertTrue(0 < sum(where) < 40_000, where)
        self.assertEqual((call.ReadLPS(X), call.ReadLPS(Y)), where)
        call.contour_begin(SV=100, V=1000, A=0, D=0)
        call.contour_line(axis=X | Y, PX=-100, PY=100, PZ=0, PU=0, V=0)
        self.assertEqual(call.contour_end(), 1)
        self.assertEqual((call.ReadLPS(X), call.ReadLPS(Y)), (where[0] - 100, where[1] + 100))

    def test_closing_ends_its_pulses(self) -> None:
        self.card.library.RESET()
        self.card.library.SetRange(800000)
        self.card.library.TCurve_C(X, 100, 1000, 400)
        self.card.close()
        self.card = LiveCard(PLACE)
        self.addCleanup(self.card.close)
        self.assertEqual(self.card.RR0.read().DRV, 0)


if __name__ == "__main__":
    unittest.main()
