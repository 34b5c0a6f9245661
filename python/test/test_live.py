"""Real cards from Python, with a plain file in place of the card: the words written, and the stops.

A file has one word where a card has two registers, WR0 and RR0. Its status is therefore the last written word: axes
seem to drive after a NOP (0Fh), and a stop reads as 0F27h.
"""

from __future__ import annotations

import contextlib
import gc
import os
import re
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
from collections.abc import Callable, Iterator
from pathlib import Path

import motionrack
from motionrack import InvalidInput, FileError, LiveCard, Rack, Refused, Stopped, Timeout

ROOT = Path(__file__).resolve().parents[2]
STOPPED = 0x0F27  # quick stop of all axes
WR6 = 0x0C
Act = Callable[[], object]


class OnAFile(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "card"
        self.path.write_bytes(bytes(16))
        self.place = f"port:{self.path},gap_ns=0"
        self.line = self.path.with_name("interrupt")
        self.line.touch()
        self.waiting = f"{self.place},interrupt={self.line}"

    def word(self, offset: int = 0) -> int:
        return int(struct.unpack_from("<H", self.path.read_bytes(), offset)[0])

    def put(self, value: int, offset: int = 0) -> None:
        with self.path.open("r+b", buffering=0) as file:
            file.seek(offset)
            file.write(struct.pack("<H", value))

    @contextlib.contextmanager
    def once_it_waits(self, act: Act) -> Iterator[None]:
        """Calls ``act`` while a call waits for the card; reports the axes at standstill after they are stopped."""
        ended = threading.Event()
        actor = threading.Thread(target=act)

        def play() -> None:
            while self.line.stat().st_size == 0:  # a wait for an interrupt writes to the node
                pass
            actor.start()
            while not ended.is_set():
                if self.word() == STOPPED:
                    self.put(0)

        player = threading.Thread(target=play)
        player.start()
        try:
            yield
        finally:
            ended.set()
            player.join()
            actor.join()


class Functions(OnAFile):
    def test_all_functions_of_the_c_header_exist(self) -> None:
        header = (ROOT / "motionrack/frontends/mcx314lib/mcx314lib.h").read_text(encoding="utf-8")
        source = set(re.findall(r"MCX314_API \w+\s+([A-Z]\w*)\(", header))
        self.assertEqual(len(source), 57)
        public = {name for name in vars(motionrack.Mcx314Library) if not name.startswith("_")}
        self.assertLessEqual(source, public)
        self.assertLessEqual({"stop", "stop_now", "wait", "contour_begin", "pattern_steps"}, public)

    def test_write_the_words_of_the_chip(self) -> None:
        for kind in ("port", "memory"):
            with LiveCard(f"{kind}:{self.path},gap_ns=0") as card:
                self.assertEqual(self.word(), 0 if kind == "port" else STOPPED, "opening writes nothing")
                self.assertEqual(card.library.SetV(3, 1234), "Written.")
                self.assertEqual((self.word(), self.word(WR6)), (0x0305, 1234))
                card.library.SetV(data=8000, axis=1)
                self.assertEqual((self.word(), self.word(WR6)), (0x0105, 8000))
                self.put(0x5678, WR6)
                self.put(0x0001, WR6 + 2)
                self.assertEqual(card.library.ReadLPS(2), 0x15678)

    def test_check_their_arguments_against_the_declaration(self) -> None:
        with LiveCard(self.place) as card:
            call = card.library
            acts: tuple[tuple[Act, str], ...] = (
                (
                    lambda: call.SetV(1, 9000),
                    "SetV: data is 9000, but must be 1 to 8000 x M pulses/s. Nothing was done.",
                ),
                (
                    lambda: call.SetV(1, 10**30),
                    f"SetV: data is {10**30}, but must be 1 to 8000 x M pulses/s. Nothing was done.",
                ),
                (
                    lambda: call.SetV(1),  # type: ignore[call-arg]
                    "SetV: the argument data is missing; it must be 1 to 8000 x M pulses/s. Nothing was done.",
                ),
                (
                    lambda: call.SetV(1, 2, 3),  # type: ignore[call-arg]
                    "SetV was given 3 arguments; its arguments are: axis, data. Nothing was done.",
                ),
                (
                    lambda: call.SetV(1, 2, axis=3),  # type: ignore[misc]
                    "SetV: axis was given twice, by its place and by its name. Nothing was done.",
                ),
                (
                    lambda: call.ReadLPS(3),
                    "ReadLPS: axis is 3, but must be 1 (X), 2 (Y), 4 (Z), 8 (U). Nothing was done.",
                ),
            )
            for act, sentence in acts:
                with self.assertRaises(InvalidInput) as caught:
                    act()
                self.assertEqual(caught.exception.message, sentence)
            with self.assertRaises(TypeError):
                call.SetV(1, 2.5)  # type: ignore[arg-type]
            with self.assertRaisesRegex(Refused, "contour_end: .*Call contour_begin and contour_line first"):
                call.contour_end()
            self.assertEqual(self.word(), 0, "nothing was written")

    def test_are_the_same_on_a_virtual_card(self) -> None:
        rack = Rack.template("router")
        call = rack.cards["motion"].library
        call.SetRange(800000)
        self.assertEqual(call.TCurve_F(1, 100, 2000, 400, m_Pulse=2000), "X drives.")
        with self.assertRaisesRegex(Timeout, "X still moves after 0.001 s"):
            call.wait(1, 1)
        self.assertEqual(call.moving(15), 1)
        call.wait(1, 10000)
        self.assertEqual((call.ReadLPS(1), call.ReadLPS(axis=2)), (2000, 0))
        with self.assertRaises(InvalidInput) as caught:
            call.SetV(1, 9000)
        self.assertIn("SetV: data is 9000, but must be 1 to 8000", caught.exception.message)
        scan = Rack.from_file(ROOT / "examples" / "14_line" / "line.toml").cards["scan"]
        with self.assertRaisesRegex(Refused, "Card scan is a rtc5"):
            scan.library


class Opening(OnAFile):
    def test_a_card_that_is_open_is_not_opened_again(self) -> None:
        card = LiveCard(self.place)
        for place in (self.place, f"memory:{self.path}"):
            with self.assertRaisesRegex(Refused, f"The card at {self.path} is already open"):
                LiveCard(place)
        program = f"import motionrack; motionrack.LiveCard({self.place!r})"
        ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
        self.assertIn("is already open in this or another program", ran.stderr)
        card.close()
        card.close()
        with self.assertRaisesRegex(Refused, "was closed. Nothing was done. Open it again."):
            card.library
        LiveCard(self.place).close()

    def test_reports_an_invalid_address_and_an_invalid_type(self) -> None:
        for place, kind, sentence in (
            ("/dev/uio0", InvalidInput, "it has no ':'"),
            (f"port:{self.path},width=7", InvalidInput, "width is 7; it must be 8 to 16"),
            ("uio:/dev/uio-that-is-not", FileError, "/dev/uio-that-is-not does not exist"),
            (f"port:{self.path},offset=2", FileError, "has 16 bytes, but the card's registers end at byte 18"),
        ):
            with self.assertRaisesRegex(kind, sentence):
                LiveCard(place)
        for other, name in (
            ("ioflex02", "An IOFLEX02"),
            ("grating_bus", "A card of the grating bus"),
            ("grating_decoder", "A card of the grating bus"),
            ("rtc5", "An RTC5"),
        ):
            with self.assertRaisesRegex(
                InvalidInput, f"{name} has no live port: .*A real card is one of: mcx314, databoard4002"
            ):
                LiveCard(self.place, other)
        with self.assertRaisesRegex(InvalidInput, "The card's number is 256; it must be 0 to 255"):
            LiveCard(self.place, "databoard4002", select=256)
        with self.assertRaisesRegex(InvalidInput, "Unknown card type 'rtc6'"):
            LiveCard(self.place, "rtc6")

    def test_a_place_where_no_card_answers_is_refused(self) -> None:
        self.path.write_bytes(b"\xff" * 16)
        with self.assertRaisesRegex(FileError, f"Every register reads FFFFh: no card answers at {self.path}"):
            LiveCard(self.place)
        self.path.write_bytes(bytes(16))
        LiveCard(self.place).close()

    def test_library_and_driver_exclude_each_other_on_a_card(self) -> None:
        with LiveCard(self.place) as card:
            card.library.SetV(1, 1)
            self.assertIs(card.library, card.library)
            with self.assertRaisesRegex(Refused, "is driven by its function library"):
                card.driver
        with LiveCard(self.place) as card:
            card.driver.SetV(1, 77)
            self.assertEqual(self.word(WR6), 77)
            with self.assertRaisesRegex(Refused, "is driven by its driver"):
                card.library


class RegistersByHand(OnAFile):
    def test_are_read_and_written_by_name(self) -> None:
        with LiveCard(self.place) as card:
            card.WR6 = 0xABCD
            self.assertEqual(self.word(WR6), 0xABCD)
            self.assertEqual(card.RR6.read(), 0xABCD)
            card.WR0.write(CODE=0x0F, X=1)
            self.assertEqual(self.word(), 0x010F)
            self.assertEqual((card.rr0.read().DRV, card.read(0)), (0xF, 0x010F))
            self.assertEqual(len(card.registers), len(card.map["registers"]))
            self.assertIn("RR0", dir(card))
            self.assertEqual((card.type, card.place), ("mcx314", self.place))
            self.assertGreaterEqual(card.seconds, 0)
            self.assertIn("RR0", card.view())

    def test_reject_invalid_access(self) -> None:
        with LiveCard(self.place) as card:
            acts: tuple[tuple[type[Exception], str, Act], ...] = (
                (InvalidInput, "cannot be looked at without an access", lambda: card.RR0.peek()),
                (InvalidInput, "without an access", lambda: card.RR0.DRV),
                (AttributeError, "has no register RR9", lambda: card.RR9),
                (AttributeError, "has no register RR9", lambda: setattr(card, "RR9", 1)),
                (Refused, "can only be written", lambda: card.WR0.read()),
                (Refused, "can only be read", lambda: card.RR0.write(1)),
                (InvalidInput, "no register that is read at 20h", lambda: card.read(0x20)),
                (InvalidInput, "no register that is written at 01h", lambda: card.write(1, 0)),
                (Refused, "70000 does not fit into 16 bits", lambda: card.write(0, 70000)),
                (InvalidInput, "have 16 bits, not 8", lambda: card.read(0, 8)),
                (Refused, "has no interrupt here", lambda: card.wait_interrupt(1)),
            )
            for kind, sentence, act in acts:
                with self.subTest(sentence), self.assertRaisesRegex(kind, sentence):
                    act()
            self.assertEqual(self.word(), 0, "nothing was written")

    def test_a_failed_access_raises_and_is_the_last(self) -> None:
        card = LiveCard(self.place)
        os.truncate(self.path, 4)
        with self.assertRaisesRegex(FileError, "The register at 0Ch could not be read"):
            card.RR6.read()
        os.truncate(self.path, 16)
        with self.assertRaisesRegex(FileError, "0Ch"):
            card.library.SetV(1, 1)
        with self.assertRaisesRegex(FileError, "0Ch"):
            card.quick_stop()
        with self.assertRaisesRegex(FileError, "No access is made from here on"):
            card.close()
        self.assertTrue(card.closed)
        self.assertEqual(self.word(), 0)

    def test_a_card_that_stops_answering_raises_and_has_no_position(self) -> None:
        card = LiveCard(self.place)
        card.library.SetV(1, 1)
        self.path.write_bytes(b"\xff" * 16)
        with self.assertRaisesRegex(FileError, "no card answers.*their positions are not valid"):
            card.RR6.read()
        for act in (lambda: card.library.ReadLPS(1), lambda: card.library.moving(1), card.quick_stop, card.close):
            with self.assertRaisesRegex(FileError, "no card answers"):
                act()
        self.assertEqual(self.path.read_bytes(), b"\xff" * 16, "nothing was written after it")


class Stops(OnAFile):
    def test_a_with_block_ends_with_the_axes_at_standstill(self) -> None:
        with LiveCard(self.place) as card:
            card.library.SetV(1, 1)
            self.assertNotEqual(self.word(), STOPPED)
        self.assertEqual((self.word(), card.closed), (STOPPED, True))
        self.put(0)
        with self.assertRaises(ZeroDivisionError), LiveCard(self.place):
            self.put(1 // 0)
        self.assertEqual(self.word(), STOPPED)

    def test_ctrl_c_in_a_wait_stops_the_card(self) -> None:
        card = LiveCard(self.waiting)
        card.library.report(1)
        with self.once_it_waits(lambda: os.kill(os.getpid(), signal.SIGINT)), self.assertRaises(KeyboardInterrupt):
            card.library.wait(1, 60_000)
        self.assertTrue(card.stopped)
        self.put(0)
        acts: tuple[Act, ...] = (
            lambda: card.library.SetV(1, 1),
            lambda: card.WR0.write(1),
            lambda: card.library.stop(15),
        )
        for act in acts:
            with self.assertRaisesRegex(Stopped, "the stop holds. Nothing was done. Call reset_stop()"):
                act()
        self.assertEqual((self.word(), card.RR0.read()), (0, 0))
        card.reset_stop()
        card.library.SetV(1, 1)
        self.assertEqual(self.word(), 0x0105)
        card.close()

    def test_an_exception_of_a_signal_handler_in_a_wait_stops_the_card(self) -> None:
        def handler(number: int, frame: object) -> None:
            card.quick_stop()  # a handler may
            raise LookupError("of the handler")

        before = signal.signal(signal.SIGUSR1, handler)
        self.addCleanup(signal.signal, signal.SIGUSR1, before)
        with LiveCard(self.waiting) as card:
            card.driver.report(0)
            with self.once_it_waits(lambda: os.kill(os.getpid(), signal.SIGUSR1)), self.assertRaises(LookupError):
                card.driver.wait(1, timeout=60)
            self.assertTrue(card.stopped)

    def test_another_thread_stops_a_move_during_a_wait(self) -> None:
        with LiveCard(self.waiting) as card:
            card.library.report(1)
            with self.once_it_waits(card.quick_stop), self.assertRaisesRegex(Stopped, "Stopped on request"):
                card.library.wait(1, 60_000)
            self.assertTrue(card.stopped)
            card.quick_stop()
            self.assertEqual(self.word(), STOPPED)

    def test_other_calls_of_another_thread_are_rejected_during_a_wait(self) -> None:
        said: list[str] = []

        def meddle() -> None:
            for act in (lambda: card.library.SetV(1, 1), card.RR0.read):
                try:
                    act()
                except Refused as error:
                    said.append(error.message)
            card.quick_stop()

        with LiveCard(self.waiting) as card:
            card.library.report(1)
            with self.once_it_waits(meddle), self.assertRaises(Stopped):
                card.library.wait(1, 60_000)
        self.assertEqual(
            said, ["Another thread is using this rack or card. Nothing was done. One thread at a time."] * 2
        )

    def test_a_card_without_a_reference_is_stopped(self) -> None:
        card = LiveCard(self.place)
        card.library.SetV(1, 1)
        del card
        gc.collect()
        self.assertEqual(self.word(), STOPPED)
        self.put(0)
        program = f"import motionrack\ncard = motionrack.LiveCard({self.place!r})\nraise SystemExit(3)"
        ran = subprocess.run([sys.executable, "-c", program], timeout=60, check=False)
        self.assertEqual((ran.returncode, self.word()), (3, STOPPED))


if __name__ == "__main__":
    unittest.main()
