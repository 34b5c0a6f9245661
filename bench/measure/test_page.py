"""Tests of the performance page: it has every bench of the sources and agrees with its stored results;
the output of other programs is parsed correctly."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import benches
import build
import instructions
import main as command
import peers
import whole
from aims import verdicts
from kinds import ROOT, Bench, Unit, bench_of, names_in_sources, plain_name
from main import PAGE, STORED, stored_text
from page import page
from running import Trouble, peak_of, run
from table import PROGRAMS
from text import bytes_of, digits, time_of

_MACHINE = {
    "cpu": "C",
    "virtual": False,
    "cores": 2,
    "memory_gb": 4,
    "system": "S",
    "kernel": "6.1",
    "compiler": "c++",
    "load": 0.0,
    "day": "2000-01-01",
    "version": "1",
    "peers": {"verilator": "5"},
}


def results_of(**sections) -> dict:
    return {"quick": False, "minutes": 1.0, "machine": _MACHINE, "benches": {}, "growth": {}, "peers": {}, **sections}


def build_of(wall_s: float = 200.0, cores: int = 2) -> dict:
    """Returns the results of twelve compilations: room_0 takes the most CPU time, room_11 the most memory."""
    return {
        "machine": {"cpu": "C", "cores": cores, "compiler": "c++ 12", "day": "2000-01-02", "version": "1", "load": 0.3},
        "ccache": False,
        "wall_s": wall_s,
        "cpu_s": 481.0,
        "second_start_s": 0.5,
        "compilations": [
            {"what": f"room_{i}, 3 sources", "sources": 3, "cpu_s": 40.0 - i, "peak_bytes": 100_000_000 * (i + 1)}
            for i in range(12)
        ],
    }


def google(name: str, cpu: float, **counters) -> dict:
    return {
        "name": name,
        "run_type": "iteration",
        "iterations": 10,
        "cpu_time": cpu,
        "real_time": 2 * cpu,
        "time_unit": "ns",
        **counters,
    }


class EveryBench(unittest.TestCase):
    def test_is_in_the_table_with_what_it_means(self):
        told: dict[str, set[str]] = {}
        for program in PROGRAMS:
            told.setdefault(program.name, set()).update(bench.name for bench in program.benches)
            for bench in program.benches:
                self.assertTrue(bench.means and bench.unit.thing, bench.name)
                self.assertTrue(
                    not bench.baseline or any(bench.baseline == other.name for other in program.benches), bench.name
                )
        self.assertEqual(told, names_in_sources(), "bench/measure/table.py has a line for each bench of the sources")

    def test_is_on_the_page(self):
        text = PAGE.read_text(encoding="utf-8")
        for program, names in names_in_sources().items():
            for name in names:
                self.assertTrue(
                    f"`{name}`" in text or f"`{name}/" in text,
                    f"{program}: {name} is not in {PAGE}; make it anew: bench/page",
                )

    def test_that_was_not_measured_is_on_the_page_as_such(self):
        text = page(results_of())
        for program, names in names_in_sources().items():
            for name in names:
                self.assertRegex(text, rf"\| `{name}` \|.*not measured", program)


class ThePage(unittest.TestCase):
    def test_is_what_its_stored_results_say(self):
        results = json.loads(STORED.read_text(encoding="utf-8"))
        self.assertEqual(
            page(results), PAGE.read_text(encoding="utf-8"), "make it anew: bench/page --from bench/measured.json"
        )
        self.assertEqual(json.loads(stored_text(results)), results)

    def test_tells_times_ratios_and_aims(self):
        rows = {
            "cruise/look_each_ms": {"ns": 0.004, "spread": 0.02, "sim_s/s": 15_000, "instructions": 0.0251},
            "cruise_twin": {"ns": 32.0, "spread": 0.0},
        }
        text = page(results_of(benches={"chip": rows}))
        self.assertIn("0.00400 ns ± 2 % | 0.0251 | 8,000 `cruise_twin` |", text)
        self.assertIn("| at least 10,000 | 15,000 | met |", text)

    def test_tells_where_others_are_faster(self):
        alike = {"peak_bytes": 1_000_000}
        text = page(
            results_of(
                peers={
                    "sigrok": {
                        "edges": 10,
                        "file_bytes": 100,
                        "theirs": {"cpu_s": 1, **alike},
                        "ours": {"cpu_s": 2, **alike},
                    }
                }
            )
        )
        self.assertIn("| motionrack decode | 200 ms | 1.00 MB | 0.500 |", text)

    def test_tells_why_a_part_of_a_run_is_missing(self):
        gone = {"missing": "bench_serve ended with code 1:"}
        text = page(results_of(peers={"rs274": gone}, programs=gone, growth={"clients": gone, "cards": gone}))
        self.assertEqual(text.count("Not measured in this run: bench_serve ended with code 1:"), 3)

    def test_is_written_by_the_command_from_results(self):
        with tempfile.TemporaryDirectory() as folder:
            results, out = Path(folder) / "r.json", Path(folder) / "p.md"
            results.write_text(json.dumps(results_of()), encoding="utf-8")
            subprocess.run(
                [ROOT / "bench/page", "--from", "r.json", "--output", "p.md"],
                cwd=folder,
                check=True,
                capture_output=True,
            )
            self.assertEqual(out.read_text(encoding="utf-8"), page(results_of()))
            broken = subprocess.run(
                [ROOT / "bench/page", "--from", "none.json"], cwd=folder, capture_output=True, text=True, check=False
            )
            self.assertEqual(broken.returncode, 1)
            self.assertIn("none.json", broken.stderr)
        said = subprocess.run([ROOT / "bench/page", "--help"], check=True, capture_output=True, text=True).stdout
        self.assertIn("Example:", said)

    def test_shows_three_digits(self):
        self.assertEqual(
            [digits(value) for value in (0, 0.00394, 0.5, 1, 12.34, 123.4, 12_345)],
            ["0", "0.00394", "0.500", "1.00", "12.3", "123", "12,300"],
        )
        self.assertEqual(
            [time_of(ns) for ns in (0.25, 57.5, 43_100, 4.05e7, 1.5e9)],
            ["0.250 ns", "57.5 ns", "43.1 us", "40.5 ms", "1.50 s"],
        )
        self.assertEqual(bytes_of(6_700), "6.70 kB")


class ABuild(unittest.TestCase):
    def test_is_on_the_page_with_its_ten_dearest_files(self):
        text = page(results_of(build=build_of()))
        for row in (
            "| wall time | 200 s | at most 240 s on 2 cores |",
            "| CPU time | 481 s | at most 480 s |",
            "| compilations | 12, of 36 sources |  |",
            "| the maximum peak memory of one | 1,200 MB: room_11, 3 sources |  |",
            "| second start, wall time | 500 ms | at most 1 s |",
            "| room_0, 3 sources | 40.0 s | 100 MB |",
            "| room_9, 3 sources | 31.0 s | 1,000 MB |",
            "Made 2000-01-02 with version 1 on 2 cores (C), c++ 12, load 0.3 at the start, ccache off.",
        ):
            self.assertIn(row + "\n", text)
        self.assertNotIn("| room_10,", text)
        gone = page(results_of(build={"missing": "no room on the disk"}))
        self.assertIn("## Building\n\nNot measured in this run: no room on the disk\n", gone)

    def test_meets_its_aims_or_not(self):
        quick, slow, wide = (
            {says: met for says, _, _, met in verdicts(results_of(build=build_of(*how)))}
            for how in ((200.0, 2), (241.0, 2), (100.0, 16))
        )
        cold, cpu, start = (
            "a build into an empty folder on two cores, s",
            "its CPU time, s",
            "`./run --version` with nothing to build, s",
        )
        self.assertEqual(quick, {cold: "met", cpu: "**not met**", start: "met"})
        self.assertEqual(slow[cold], "**not met**")
        self.assertNotIn(cold, wide, "the limit is of two cores")

    def test_alone_keeps_the_other_numbers(self):
        before = json.loads(STORED.read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(build, "measure", return_value=build_of()):
            out = Path(folder) / "p.md"
            self.assertEqual(command.main(["--only", "build", "--output", str(out)]), 0)
            text = out.with_suffix(".json").read_text(encoding="utf-8")
            self.assertEqual(json.loads(text), {**before, "build": build_of()})
            self.assertIn('\n   {"what": "room_3, 3 sources", "sources": 3, ', text)
            self.assertEqual(out.read_text(encoding="utf-8"), page(json.loads(text)))
            out.unlink()
            for refused in (["--only", "build", "chip"], ["--quick", "--only", "build"]):
                self.assertEqual(command.main([*refused, "--output", str(out)]), 1)
                self.assertFalse(out.exists())

    def test_has_what_each_compilation_took(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "one.cpp").write_text("int main() { return 0; }\n", encoding="ascii")
            (folder / "bad.cpp").write_text("int main() { return nothing; }\n", encoding="ascii")
            log = folder / "log"
            env = {**os.environ, "MOTIONRACK_COMPILATIONS": str(log), "CCACHE_DISABLE": "1"}

            def compiled(source: str) -> int:
                argv = [sys.executable, str(build.LAUNCHER), "c++", "-o", f"{source}.o", "-c", source]
                return subprocess.run(argv, cwd=folder, env=env, capture_output=True, check=False).returncode

            self.assertEqual(compiled("bad.cpp"), 1)
            self.assertFalse(log.exists(), "what failed is not measured")
            self.assertEqual(compiled("one.cpp"), 0)
            self.assertTrue((folder / "one.cpp.o").exists())
            (got,) = build.compilations(log.read_text(encoding="utf-8"), folder)
        self.assertEqual((got.what, got.sources), ("one.cpp", 1))
        self.assertTrue(0 < got.cpu_s < 60, got)
        self.assertTrue(10_000_000 < got.peak_bytes < 1_000_000_000, got)

    def test_names_sources_that_are_compiled_together_by_their_folder(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            unity = folder / "motionrack/server.dir/Unity"
            unity.mkdir(parents=True)

            def named(file: str, *sources: Path) -> tuple[str, int]:
                lines = "".join(f'#include "{source}"\n\n' for source in sources)
                (unity / file).write_text("/* generated by CMake */\n\n" + lines, encoding="ascii")
                return build.named(unity / file, folder)

            room = ROOT / "motionrack/frontends/server"
            made = folder / "motionrack/frontends/server/made.cpp"
            self.assertEqual(
                named("unity_0_cxx.cxx", room / "a.cpp", made, room / "b/c.cpp"),
                ("motionrack/frontends/server, 3 sources", 3),
            )
            self.assertEqual(named("unity_0_c.c", room / "a.c"), ("motionrack/frontends/server/a.c", 1))
            two = (room / "a.cpp", room / "b.cpp")
            self.assertEqual(named("unity_1_cxx.cxx", *two), ("motionrack/frontends/server, 2 sources, part 2", 2))
            self.assertEqual(named("unity_0_cxx.cxx", *two), ("motionrack/frontends/server, 2 sources, part 1", 2))
            with self.assertRaisesRegex(Trouble, "includes no source"):
                named("unity_2_cxx.cxx")
        with self.assertRaisesRegex(Trouble, "launcher.py"):
            build.compilations("", folder)

    def test_is_that_of_run(self):
        self.assertEqual(build.build_of_run(), 'motionrack "${release_options[@]}" -DMOTIONRACK_TESTS=OFF')


class Results(unittest.TestCase):
    def test_are_the_median_of_the_repetitions_and_their_spread(self):
        program = next(program for program in PROGRAMS if program.name == "chip")
        rows = [google("cruise/look_each_ms", 60, **{"pulses/s": rate, "sim_s/s": 5}) for rate in (1e9, 2e9, 4e9)]
        mean = {**google("cruise/look_each_ms_mean", 60), "run_type": "aggregate"}
        got = benches.read_results(json.dumps({"benchmarks": [*rows, mean]}), program)
        self.assertEqual(got, {"cruise/look_each_ms": {"ns": 0.5, "spread": 1.0, "sim_s/s": 5}})

    def test_of_failed_or_unknown_benches_are_refused_with_a_sentence(self):
        program = PROGRAMS[0]
        failed = {**google("snapshot", 1), "error_occurred": True, "error_message": "an edge was lost"}
        for row, part in (
            (failed, "an edge was lost"),
            (google("unheard_of", 1), "table.py"),
            (google("cruise_twin", 1), "pulses/s"),
        ):
            with self.assertRaisesRegex(Trouble, part):
                benches.read_results(json.dumps({"benchmarks": [row]}), program)
        with self.assertRaisesRegex(Trouble, "there are: axis"):
            benches.chosen(["unheard_of"])

    def test_have_names_without_what_only_says_how_they_were_timed(self):
        self.assertEqual(
            plain_name("network/period_us:200/scales:8/min_time:20.000/real_time"), "network/period_us:200/scales:8"
        )
        program = next(program for program in PROGRAMS if program.name == "dds")
        bench = bench_of(program, "network/period_us:200/scales:8")
        assert bench
        self.assertEqual(bench.name, "network")

    def test_take_real_time_where_the_bench_does(self):
        self.assertEqual(benches.nanoseconds_each(google("a", 5), ""), 5)
        self.assertEqual(benches.nanoseconds_each(google("a/real_time", 5), ""), 10)
        self.assertEqual(benches.nanoseconds_each(google("a", 5, each=2e-9), "each"), 2)
        self.assertEqual(benches.summary_of([google("a", 5)], Bench("a", "", Unit(""))), {"ns": 5})


class Instructions(unittest.TestCase):
    def test_are_those_of_the_last_loop_without_its_pauses(self):
        def dump(trigger: str, cost: int) -> str:
            return f"version: 1\ndesc: Trigger: {trigger}\nevents: Ir\nsummary: {cost}\nfn=(1)\ntotals: {cost}\n"

        start, pause = (
            "--dump-after=benchmark::State::StartKeepRunning()",
            "--dump-before=benchmark::State::PauseTiming()",
        )
        resume, finish = (
            "--dump-after=benchmark::State::ResumeTiming()",
            "--dump-before=benchmark::State::FinishKeepRunning()",
        )
        dumps = [
            dump(start, 7),
            dump(finish, 5),
            dump(start, 900),
            dump(pause, 30),
            dump(resume, 800),
            dump(finish, 12),
            dump("Program termination", 99),
        ]
        self.assertEqual(instructions.instructions_in(dumps), 42)
        with self.assertRaises(Trouble):
            instructions.instructions_in([dump("Program termination", 99)])

    def test_are_of_one_thing(self):
        self.assertEqual(instructions.things_in(google("a", 5), ""), 10)
        self.assertAlmostEqual(instructions.things_in(google("a", 5, **{"pulses/s": 4e9}), "pulses/s"), 200)


class Others(unittest.TestCase):
    def test_are_read_as_they_print(self):
        self.assertEqual(
            whole.counts_decoded("X          X_enc_a,X_enc_b          400         1600         1200         1010.7"),
            2800,
        )
        self.assertEqual(peers.last_number("graycode-1: 1\ngraycode-1: -2\n"), -2)
        rows = "".join(f"120 200 {i} 900 \n" for i in range(2000))
        self.assertEqual(
            peers.read_periods(rows), {"periods": 1800, "make": 120, "count": 200, "thread": 900, "counts_a_period": 1}
        )
        for bad in ("1 2 3 4\n", "120 200 5 900\n" * 2000):
            with self.assertRaises(Trouble):
                peers.read_periods(bad)

    def test_that_fail_are_told_with_what_they_said(self):
        self.assertEqual(run(["sh", "-c", "echo said; exit 3"], codes=(3,)).out, "said\n")
        with self.assertRaisesRegex(Trouble, "code 3:\nsaid"):
            run(["sh", "-c", "echo said; exit 3"])

    def test_have_their_memory_measured_not_ours(self):
        own = bytearray(80_000_000)
        self.assertLess(run(["true"]).peak_bytes, 10_000_000)
        self.assertGreater(peak_of(os.getpid()), len(own))
        self.assertEqual(peak_of(2**30), 0)


if __name__ == "__main__":
    unittest.main()
