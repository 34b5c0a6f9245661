"""The RTC5 from Python: every command of rtc5sim.h, corrections by position words, calibration, correction files."""

from __future__ import annotations

import inspect
import re
import struct
import tempfile
import unittest
import warnings
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import motionrack
import numpy as np
from motionrack import InvalidInput, FileError, Rack, Refused

ROOT = Path(__file__).resolve().parents[2]
HEADER = ROOT / "motionrack" / "frontends" / "rtc5sim" / "rtc5sim.h"
K = 5184  # bits/mm
Acts = tuple[Callable[[], object], ...]
PARAM_ERROR, BUSY, REJECTED = 16, 32, 64
# Functions with a pointer in C and a text, a sequence or a return value in Python; matrix: (head, matrix, at_once).
OTHERWISE = {"set_mcbsp_out_ptr", "get_waveform", "set_matrix"}
# Methods whose parameters have other names than in the header.
NAMED_OTHERWISE = {"set_offset", "set_angle", "set_scale", "config_list", "set_jump_speed_ctrl", "set_mark_speed_ctrl"}


def declared() -> dict[str, list[tuple[str, str]]]:
    """Returns the functions of the header with their parameters (type, name)."""
    found = {}
    for name, parameters in re.findall(r"^RTC5_API [^(]*\b(\w+)\(([^)]*)\);", HEADER.read_text("utf-8"), re.MULTILINE):
        each = [parameter.strip() for parameter in parameters.split(",") if parameter.strip() != "void"]
        found[name] = [(text[: -len(word)].strip(), word) for text in each for word in re.findall(r"\w+$", text)]
    return found


def rack_of(belt: str = "") -> tuple[Rack, motionrack.Rtc5]:
    rack = Rack.from_text(
        f'[card.scan]\ntype = "rtc5"\nlist_memory = 2000\n{belt}'
        f'[scanner.head]\ncard = "scan"\nbits_per_mm = {K}\n' + ('conveyor = "line"\n' if belt else "")
    )
    return rack, rack.cards["scan"].driver


def run(rtc: motionrack.Rtc5, *commands: Callable[[], None]) -> None:
    """Executes a list of these commands to its end."""
    rtc.set_start_list(1)
    for command in commands:
        command()
    rtc.set_end_of_list()
    rtc.execute_list(1)
    rtc.wait(timeout=10)


class Commands(unittest.TestCase):
    def test_every_function_of_the_header_is_a_method(self) -> None:
        functions = declared()
        self.assertEqual(len(functions), 166)
        for name in functions:
            with self.subTest(name):
                method = getattr(motionrack.Rtc5, name, None)
                self.assertTrue(callable(method), f"{name} is in rtc5sim.h and not in Python")
                self.assertGreater(len(inspect.getdoc(method) or ""), len(name) + 20)

    def test_parameters_have_the_names_of_the_header(self) -> None:
        for name, parameters in declared().items():
            if name in OTHERWISE | NAMED_OTHERWISE:
                continue
            given = [word for kind, word in parameters if "*" not in kind or "char" in kind]
            signature = (inspect.getdoc(getattr(motionrack.Rtc5, name)) or "").splitlines()[0]
            named = re.findall(r"[(,] ?(\w+):", signature)[1:]
            with self.subTest(name):
                plain = [[word.lower().removeprefix("d") for word in words] for words in (named, given)]
                self.assertEqual(plain[0][: len(given)], plain[1])

    def test_values_out_of_range_are_rejected_with_the_range_and_the_bit(self) -> None:
        rtc: Any = rack_of()[1]
        acts: dict[Callable[[], object], str] = {
            lambda: rtc.simulate_encoder(4): "simulate_encoder: EncoderNo is 4; it must be 0 to 3; nothing was changed",
            lambda: rtc.read_mcbsp(4): "read_mcbsp: No is 4; it must be 0 to 3; nothing was changed",
            lambda: rtc.set_mcbsp_in(1.5, 1): "set_mcbsp_in: Mode is 1.5, but must be whole; nothing was changed",
            lambda: rtc.set_mcbsp_in(Mode=1, Scale=float("nan")): "set_mcbsp_in: Scale is nan; it must be",
            lambda: rtc.set_hi(1, 17, 1, 0, 0): "set_hi: GalvoGainX is 17; it must be -16 to 16; nothing was changed",
            lambda: rtc.set_rot_center(1): "set_rot_center has 2 parameters, not 1; nothing was done",
            lambda: rtc.set_extstartpos(2000): "set_extstartpos: Pos is 2000; it must be 0 to 1999",
            lambda: rtc.mark_abs(1): "mark_abs has 2 parameters, not 1; it was not added to the list",
            lambda: rtc.select_rtc(2): "select_rtc: unknown card 2; the rack has 1 of type rtc5. Nothing was done.",
            lambda: rtc.load_correction_file(None, 5): "load_correction_file: No is 5; it must be 1 to 4",
            lambda: rtc.get_waveform(1, 1): "get_waveform: nothing was recorded",
            lambda: rtc.set_mcbsp_out_ptr([6]): "6",
        }
        for act, sentence in acts.items():
            rtc.reset_error(0xFFFFFFFF)
            with self.assertRaises(Refused) as caught:
                act()
            self.assertIn(sentence, str(caught.exception))
            if "select_rtc" not in sentence:
                self.assertEqual((rtc.get_last_error(), rtc.get_error()), (PARAM_ERROR, PARAM_ERROR), sentence)
        self.assertEqual(rtc.get_input_pointer(), 0)
        self.assertEqual(rtc.get_last_error(), 0)
        self.assertEqual(rtc.get_error(), PARAM_ERROR)
        self.assertEqual(motionrack.Rtc5.error_text(PARAM_ERROR), ["PARAM_ERROR: a parameter is wrong"])
        with self.assertRaises(TypeError):
            rtc.read_mcbsp(Number=1)
        with self.assertRaises(TypeError):
            rtc.read_mcbsp(1, No=1)
        with self.assertRaises(TypeError):
            rtc.mark_abs(Y=1)
        with self.assertRaises(TypeError):
            rtc.mark_abs("a", 1)

    def test_a_running_list_and_a_full_one_have_their_bits(self) -> None:
        rack, rtc = rack_of()
        rtc.set_start_list_1()
        rtc.long_delay(Delay=1000)
        rtc.set_end_of_list()
        rtc.execute_list_1()
        acts: Acts = (rtc.execute_list_2, lambda: rtc.execute_at_pointer(0), lambda: rtc.execute_list(1))
        for act in acts:
            with self.assertRaises(Refused):
                act()
            self.assertEqual(rtc.get_last_error(), BUSY)
        rtc.stop_execution()
        rtc.config_list(2, 2)
        rtc.set_start_list_pos(1, 1)
        self.assertEqual((rtc.get_input_pointer(), rtc.get_list_space()), (1, 1))
        rtc.list_nop()
        with self.assertRaises(Refused):
            rtc.list_nop()
        self.assertEqual(rtc.get_last_error(), REJECTED)
        self.assertEqual(rtc.get_error(), BUSY | REJECTED)
        rtc.reset_error(BUSY)
        self.assertEqual(rtc.get_error(), REJECTED)
        rack.advance(ms=1)

    def test_cards_of_the_rack_are_counted_selected_and_released(self) -> None:
        rack = Rack.from_text('card.a = "rtc5"\ncard.m = "mcx314"\ncard.b = "rtc5"\n')
        rtc: motionrack.Rtc5 = rack.cards["a"].driver
        self.assertEqual((rtc.init_rtc5_dll(), rtc.rtc5_count_cards()), (0, 2))
        self.assertEqual(rtc.select_rtc(2), 2)
        rtc.write_io_port(0xA5)
        self.assertEqual((rack.cards["a"].peek("IO"), rack.cards["b"].peek("IO")), (0, 0xA5))
        self.assertEqual(rtc.get_io_status(), 0xA5)
        rtc.free_rtc5_dll()
        with self.assertRaises(Refused) as caught:
            rtc.get_io_status()
        self.assertIn("select_rtc takes one again", str(caught.exception))
        self.assertEqual(rtc.get_last_error(), 2)
        self.assertEqual(rtc.select_rtc(1), 1)
        self.assertEqual(rtc.get_io_status(), 0)

    def test_control_commands_have_their_documented_effect(self) -> None:
        rack, rtc = rack_of()
        rtc.simulate_encoder(3)
        rack.advance(ms=10)
        self.assertEqual(rtc.get_encoder(), (10_010, 10_010))
        rtc.init_fly_2d(400, -500)
        self.assertEqual(rtc.get_fly_2d_offset(), (400, -500))
        run(rtc, lambda: rtc.store_encoder(0), lambda: rtc.long_delay(100), lambda: rtc.store_encoder(1))
        x0, y0, x1, y1 = rtc.read_encoder()
        self.assertEqual((x0, x1 - x0), (y0, y1 - y0))
        self.assertAlmostEqual(x1 - x0, 1000, delta=20)
        begun = rack.ticks
        run(rtc, lambda: rtc.set_trigger(1, 7, 8), lambda: rtc.mark_abs(500, -500))
        self.assertGreater(rack.ticks, begun)
        busy, position = rtc.measurement_status()
        samples = rtc.get_waveform(1, position + 1)
        self.assertEqual((samples.dtype, samples[-1], busy), (np.dtype(np.int32), 500, 1))
        self.assertTrue((np.diff(samples) >= 0).all())
        rtc.stop_trigger()
        self.assertEqual(rtc.measurement_status(), (0, position))
        rtc.set_hi(1, 0.5, 1, 10, 0)
        rack.advance(ms=1)
        self.assertEqual(rtc.output()[:2], (260, -500))
        rtc.set_mcbsp_out(7, 8)
        rtc.set_mcbsp_out_ptr([7])
        self.assertEqual(rtc.set_mcbsp_freq(4_000_000), 4_000_000)
        rtc.set_laser_mode(1)
        rtc.set_laser_timing(1, 2, 3, 0)
        rtc.mcbsp_init(1, 1)
        rtc.set_standby(10, 1)
        rtc.set_start_list(1)
        rtc.long_delay(1000)
        rtc.set_end_of_list()
        rtc.set_control_mode(1)
        rtc.set_extstartpos(0)
        rtc.simulate_ext_start_ctrl()
        rack.advance(us=20)
        self.assertTrue(rtc.busy())
        rtc.simulate_ext_stop()
        rack.advance(us=20)
        self.assertFalse(rtc.busy())
        self.assertEqual(rtc.load_program_file(), 0)
        self.assertEqual(rtc.get_list_space(), 1000)


class Words(unittest.TestCase):
    """Processing on the fly by position words."""

    def setUp(self) -> None:
        self.rack, self.rtc = rack_of()

    def send(self, word: int) -> None:
        self.rack.wires["scan.mcbsp"] = word - (1 << 32 if word >= 1 << 31 else 0)
        self.rack.advance(us=20)

    def at(self) -> tuple[int, int]:
        return self.rtc.output()[:2]

    def test_set_fly_x_pos_and_set_fly_y_pos_move_with_the_word_until_fly_return(self) -> None:
        self.send(1000)
        run(self.rtc, lambda: self.rtc.set_fly_x_pos(0.5), lambda: self.rtc.list_nop())
        self.assertEqual(self.at(), (500, 0))
        run(self.rtc, lambda: self.rtc.set_fly_x_pos(0), lambda: self.rtc.set_fly_y_pos(-2))
        self.assertEqual(self.at(), (0, -2000))
        run(self.rtc, lambda: self.rtc.set_fly_x_pos(10), lambda: self.rtc.list_nop())
        self.send(0xFFFE0003)
        self.assertEqual(self.at(), (30, 4))
        run(self.rtc, lambda: self.rtc.fly_return(X=70, Y=80))
        self.assertEqual(self.at(), (70, 80))
        self.send(5)
        self.assertEqual((self.at(), self.rtc.read_mcbsp(0)), ((70, 80), 5))

    def test_set_fly_rot_pos_rotates_about_the_centre(self) -> None:
        self.rtc.set_rot_center(0, 0)
        self.send(900)
        run(self.rtc, lambda: self.rtc.jump_abs(1000, 0), lambda: self.rtc.set_fly_rot_pos(3600), self.rtc.list_nop)
        self.assertEqual(self.at(), (0, 1000))
        run(self.rtc, lambda: self.rtc.set_fly_rot_pos(0), lambda: self.rtc.list_nop())
        self.assertEqual(self.at(), (1000, 0))

    def test_set_mcbsp_in_and_its_list_form_fill_location_0_as_well(self) -> None:
        forms: Acts = (
            lambda: self.rtc.set_mcbsp_in(3, 2),
            lambda: run(self.rtc, lambda: self.rtc.set_mcbsp_in_list(Mode=3, Scale=2), lambda: self.rtc.list_nop()),
        )
        for form in forms:
            self.setUp()
            form()
            self.send(0xFFFE0003)
            self.assertEqual(self.at(), (6, -4))
            word = 0xFFFE0003 - (1 << 32)
            self.assertEqual([self.rtc.read_mcbsp(no) for no in range(4)], [word, 3, -2, word])

    def test_set_multi_mcbsp_in_and_its_list_form_take_typed_words(self) -> None:
        forms: Acts = (
            lambda: self.rtc.set_multi_mcbsp_in(0, 0, 0),
            lambda: run(self.rtc, lambda: self.rtc.set_multi_mcbsp_in_list(0, 0, 0), lambda: self.rtc.list_nop()),
        )
        for form in forms:
            self.setUp()
            form()
            for kind, value in ((0, 100), (1, -50), (3, 7)):
                self.send((value << 3 | kind) & 0xFFFFFFFF)
            self.assertEqual(self.at(), (100, -50))
            self.assertEqual([self.rtc.read_multi_mcbsp(kind) for kind in (0, 1, 3)], [100, -50, 7])
            self.assertEqual([self.rtc.read_mcbsp(no) for no in range(3)], [800, -399, 59])

    def test_online_positioning_moves_when_it_is_applied(self) -> None:
        self.rtc.set_mcbsp_x(2)
        self.rtc.set_mcbsp_y(3)
        self.send(0xFFFE0003)
        self.assertEqual(self.at(), (0, 0))
        self.rtc.apply_mcbsp(1, 1)
        self.rack.advance(us=20)
        self.assertEqual(self.at(), (6, -6))
        self.rtc.set_mcbsp_rot(3600)
        self.rtc.set_mcbsp_matrix()
        self.assertEqual(self.rtc.get_mcbsp(), 0xFFFE0003 - (1 << 32))

    def test_read_mcbsp_names_the_command_required_first(self) -> None:
        for location, first in ((0, "first use set_fly_x_pos, set_fly_y_pos"), (1, "set_mcbsp_in with Mode 1 or 3")):
            with self.assertRaises(Refused) as caught:
                self.rtc.read_mcbsp(location)
            self.assertIn(first, str(caught.exception))
            self.assertEqual(self.rtc.get_last_error(), REJECTED)
        with self.assertRaises(Refused) as caught:
            self.rtc.get_mcbsp()
        self.assertIn("no word was received over McBSP yet", str(caught.exception))

    def test_the_scale_is_found_as_the_manual_prints_it_and_the_mark_is_in_its_place(self) -> None:
        belt = (
            '[belt.line]\ncard = "scan"\nvelocity_mm_s = 0\ndirection_deg = 30\n'
            "[belt.line.sender]\nbits_per_mm = 200\ntwo_axes = true\n"
        )
        rack, rtc = rack_of(belt)
        along = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6)])

        def halves(word: int) -> Any:
            return np.array(struct.unpack("<hh", struct.pack("<i", word)))

        def gone() -> Any:
            return np.asarray(rack.parts["line"].position_mm * along)

        run(rtc, lambda: rtc.set_fly_x_pos(0))
        start, place = halves(rtc.read_mcbsp(0)), gone()
        rack.parts["line"].speed_mm_s = 100
        rack.advance(ms=300)
        rack.parts["line"].speed_mm_s = 0
        rack.advance(ms=1)
        increment = (halves(rtc.read_mcbsp(0)) - start) / (gone() - place)
        np.testing.assert_allclose(increment, 200, atol=0.2)
        scale = K / increment
        rack.parts["line"].speed_mm_s = 100
        rtc.set_start_list(1)
        rtc.set_mark_speed(500 * K / 1000)
        rtc.set_fly_x_pos(scale[0])
        rtc.set_fly_y_pos(scale[1])
        rtc.jump_abs(0, 0)
        rtc.mark_abs(10 * K, 0)
        rtc.fly_return(0, 0)
        rtc.set_end_of_list()
        rtc.execute_list(1)
        marked = []
        while rtc.get_status()[0] & 1:
            x, y, laser = rtc.output()
            if laser:
                marked.append(np.array([x, y]) / K - gone())
        np.testing.assert_allclose([marked[0], marked[-1]], [[0, 0], [10, 0]], atol=0.06)
        np.testing.assert_allclose(np.array(marked)[:, 1], 0, atol=0.06)


class Files(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.rack, self.rtc = rack_of()

    def file(self, k: int = K, program: int = 403, flat: bool = False, damage: tuple[int, ...] = ()) -> str:
        """Makes a correction table that is 1:1 except for an offset of 1000 bits in X."""
        header = np.zeros(16, "<i4")
        header[1], header[10] = k, program
        steps = np.arange(257) * 4096
        x = np.minimum(np.tile(steps * (not flat) + 1000, (257, 1)), 1048575)
        y = np.minimum(np.tile(steps[:, None], (1, 257)), 1048575)
        inverse = np.full((2, 257, 257), 524288)
        content = b"".join(part.astype("<i4").tobytes() for part in (header, x, y, inverse))
        whole = bytearray(content + struct.pack("<I", zlib.crc32(content) ^ 0xFFFFFFFF))
        for place in damage:
            whole[place] ^= 1
        path = Path(self.folder.name) / "table.ct5"
        path.write_bytes(whole)
        return str(path)

    def test_a_correction_file_is_used(self) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(self.rtc.load_correction_file(self.file(), 2), 0)
        self.rtc.select_cor_table(2, 0)
        self.rack.advance(us=20)
        self.assertEqual(self.rtc.output()[:2], (1000, 0))
        self.assertEqual((self.rtc.get_table_para(2, 1), self.rtc.get_head_para(1, 1)), (K, K))
        self.assertEqual((self.rtc.table_note(2), self.rtc.get_table_para(1, 1)), ("", 0))
        self.assertEqual(self.rtc.load_correction_file(None, 2), 0)
        self.rack.advance(us=20)
        self.assertEqual(self.rtc.output()[:2], (0, 0))

    def test_a_damaged_file_is_rejected_and_keeps_the_table(self) -> None:
        self.rtc.load_correction_file(self.file(), 1)
        wrong: tuple[dict[str, Any], ...] = (
            {"damage": (700_000,)},
            {"damage": (40,)},
            {"damage": (41,)},
            {"program": 310, "damage": (64,)},
            {"k": 0},
            {"flat": True},
        )
        for how in wrong:
            path = self.file(**how)
            with self.assertRaises(InvalidInput) as caught:
                self.rtc.load_correction_file(path, 1)
            self.assertRegex(str(caught.exception), r"table\.ct5: .*(damaged|0 bits/mm|inverted).*was not loaded")
            self.assertEqual((self.rtc.get_last_error(), self.rtc.get_table_para(1, 1)), (PARAM_ERROR, K))
        with self.assertRaises(FileError):
            self.rtc.load_correction_file("/no/such.ct5", 1)

    def test_an_unknown_checksum_is_a_warning(self) -> None:
        end = 1_056_852
        with self.assertWarnsRegex(UserWarning, "from an older program, whose checksum is unknown; it was not checked"):
            self.rtc.load_correction_file(self.file(program=310, damage=(end - 1, end - 3)), 3)
        self.assertIn("unknown", self.rtc.table_note(3))
        self.assertEqual(self.rtc.get_table_para(3, 1), K)

    def test_a_compensation_table_is_used(self) -> None:
        path = Path(self.folder.name) / "fly.txt"
        path.write_text("[Fly2DTable3]\n0 0 50 0\n1000 0 50 0\n0 1000 50 0\n1000 1000 50 0\n", encoding="utf-8")
        with self.assertRaises(motionrack.Error):
            self.rtc.load_fly_2d_table(str(path), 1)
        self.assertEqual(self.rtc.load_fly_2d_table(str(path), 3), 0)
        run(self.rtc, lambda: self.rtc.set_fly_2d(2, 2), lambda: self.rtc.list_nop())
        self.assertEqual(self.rtc.output()[:2], (100, 0))
        self.rtc.load_fly_2d_table(None, 0)


if __name__ == "__main__":
    unittest.main()
