"""Racks from Python: snapshots, copies, threads."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
import unittest

from test_rack import CARD, drive

import motionrack
from motionrack import Rack, Refused


class Worlds(unittest.TestCase):
    def test_a_restored_rack_continues_identically(self) -> None:
        rack = Rack.from_text(CARD)
        drive(rack.cards["c1"], 20000)
        rack.advance(ms=100)
        state = rack.snapshot()
        self.assertEqual(state.hash(), rack.state_hash())
        rack.advance(ms=200)
        first = rack.state_hash(), rack.trace_hash(), rack.peek("c1.x.LP"), rack.ticks
        rack.restore(state)
        self.assertEqual(rack.state_hash(), state.hash())
        self.assertEqual(rack.time, state.time)
        rack.advance(ms=200)
        self.assertEqual((rack.state_hash(), rack.trace_hash(), rack.peek("c1.x.LP"), rack.ticks), first)

    def test_a_copy_is_independent(self) -> None:
        rack = Rack.from_text(CARD)
        drive(rack.cards["c1"], 20000)
        rack.advance(ms=100)
        other = rack.copy()
        other.wires["c1.xlmtp"] = 0
        rack.advance(1)
        other.advance(1)
        self.assertEqual(rack.peek("c1.x.LP"), 20000)
        self.assertLess(other.peek("c1.x.LP"), 20000)

    def test_planned_faults_are_not_repeated_by_a_copy(self) -> None:
        rack = Rack.template("router")
        rack.plan_fault("X.motor.push=320@1ms")
        rack.advance(ms=2)
        other = rack.copy()
        other.advance(ms=2)
        rack.advance(ms=2)
        self.assertEqual(other.state_hash(), rack.state_hash())

    def test_a_snapshot_of_another_kind_is_refused(self) -> None:
        with self.assertRaises(Refused):
            Rack.from_text(CARD).restore(Rack.template("single").snapshot())


class Threads(unittest.TestCase):
    def test_other_threads_continue_but_cannot_access_a_running_rack(self) -> None:
        rack = Rack.template("router")
        rack.record("X.position_mm", period=1e-5)  # keeps it busy
        refused: list[BaseException] = []
        done = threading.Event()

        def meddle() -> None:
            while not done.is_set() and not refused:
                try:
                    rack.advance(ns=1)
                except Refused as error:
                    refused.append(error)
                except motionrack.Error:
                    pass

        thread = threading.Thread(target=meddle)
        thread.start()
        deadline = time.monotonic() + 60
        while not refused and time.monotonic() < deadline:
            try:
                rack.advance(0.5)
            except Refused as error:
                refused.append(error)
        done.set()
        thread.join()
        self.assertIn("thread", str(refused[0]))

    def test_racks_in_parallel_threads_are_independent(self) -> None:
        program = "G21 G90 F2400\nG1 X20 Y10\nG3 X30 Y20 I0 J10\nG0 X0 Y0\nM2\n"
        alone = Rack.template().run(program).trace_hash
        found: list[str] = []
        threads = [
            threading.Thread(target=lambda: found.append(Rack.template().run(program).trace_hash)) for _ in range(4)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [alone] * 4)

    def test_ctrl_c_ends_a_run_and_the_rack_continues_afterwards(self) -> None:
        """Runs in a separate process, which sends itself Ctrl-C; nothing else ends its endless programs."""
        program = r"""
import signal, threading, motionrack, os
signal.signal(signal.SIGINT, signal.default_int_handler)
def tell(seconds, line, lines):
    if seconds > 1 and not told: told.append(os.kill(os.getpid(), signal.SIGINT))
told = []
try:
    motionrack.Rack.template().run("G21 G90 F600\n" + "G1 X100\nG1 X0\n" * 100000, progress=tell)
    print("ended")
except KeyboardInterrupt:
    print("interrupted in a program")
rack = motionrack.Rack.from_text('card.c1 = "mcx314"')
rack.record("c1.x.LP", period=1e-6)
timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)); timer.start()
try:
    rack.advance(3600 * 24 * 1000)
    print("ended")
except KeyboardInterrupt:
    print("interrupted while time passed", rack.time > 0)
before = rack.ticks
rack.advance(ms=1)
print(rack.ticks - before)
"""
        ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(
            ran.stdout.splitlines(),
            ["interrupted in a program", "interrupted while time passed True", "10000000"],
            ran.stderr,
        )


if __name__ == "__main__":
    unittest.main()
