"""A real DataBoard 4002 from Python, with a virtual one in its place that another process serves in real time:
`live_server databoard4002 --real-time python3 -m unittest test_live_databoard4002`."""

from __future__ import annotations

import contextlib
import io
import os
import re
import threading
import time
import unittest
from pathlib import Path

import motionrack
from motionrack import InvalidInput, LiveCard, MachineFault, Refused, Stopped

PLACE = os.environ["MOTIONRACK_LIVE_PORT"] + ",gap_ns=1000"
PAGE = Path(__file__).resolve().parents[2] / "docs" / "howto" / "live-port.md"


class Page(unittest.TestCase):
    def test_its_program_moves_the_card(self) -> None:
        blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
        block = next(one for one in blocks if "databoard4002" in one)
        place = "port:/dev/port,offset=0x300,gap_ns=1000"
        self.assertIn(place, block)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            exec(compile(block.replace(place, PLACE), str(PAGE), "exec"), {"motionrack": motionrack})
        self.assertRegex(said.getvalue(), r"^it stands at 1000 Ready: [01]\n$")


class Served(unittest.TestCase):
    def setUp(self) -> None:
        self.card = LiveCard(PLACE, "databoard4002")
        self.addCleanup(self.card.close)
        self.card.driver.connect()
        self.card.driver.athome()
        self.card.driver.set_rate(16384 - 400)  # 1000 pulses/s

    def test_the_driver_moves_it_as_a_virtual_card(self) -> None:
        for target in (100, -20, 0):
            self.card.driver.move_to(target, timeout=5)
            self.assertEqual(self.card.driver.position(), target)
        self.assertRegex(self.card.view(), r"POSITION +0 +counts")

    def test_its_ports_have_eight_bits(self) -> None:
        time.sleep(0.01)  # it is busy with the last command
        self.assertEqual(self.card.STAT.read().READY, 1)
        self.assertEqual(self.card.read(1, 8) & 0x80, 0x80)
        with self.assertRaisesRegex(InvalidInput, "have 8 bits, not 16"):
            self.card.read(1)
        with self.assertRaisesRegex(Refused, "is a databoard4002, which has no function library"):
            self.card.library

    def test_a_quick_stop_ends_a_move_of_another_thread_and_holds(self) -> None:
        stop = threading.Timer(0.2, self.card.quick_stop)
        stop.start()
        with self.assertRaises(Stopped):
            self.card.driver.move_to(100_000, timeout=30)
        stop.join()
        with self.assertRaises(Stopped):
            self.card.driver.position()
        self.card.reset_stop()
        here = self.card.driver.position()
        self.assertLess(here, 5_000)
        time.sleep(0.1)
        self.assertEqual(self.card.driver.position(), here, "it stands")

    def test_a_slot_without_this_card_is_reported(self) -> None:
        self.card.close()
        other = LiveCard(PLACE, "databoard4002", select=7)
        with self.assertRaisesRegex(MachineFault, "No card answers under the number 7"):
            other.driver.connect()
        with contextlib.suppress(MachineFault):
            other.close()
