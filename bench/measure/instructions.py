"""Instructions of one thing, counted by callgrind: the same on a busy machine as on an idle one.

    StartKeepRunning │ the loop ... PauseTiming │ ... │ ResumeTiming ... │ FinishKeepRunning
                     └ counted ───────────────────┘   └ counted ─────────┘

Google Benchmark calls these four around what it times; callgrind writes its counters out, and clears them, where they
are left or entered. What a bench does before its loop is so left out.
"""
import json
import os
import re
import tempfile
from pathlib import Path

from benches import SECONDS, names_of, nanoseconds_each
from kinds import Program, bench_of, plain_name
from running import Progress, Trouble, run, say

_SWITCHES = [
    "--dump-after=benchmark::State::StartKeepRunning*",
    "--dump-before=benchmark::State::PauseTiming*",
    "--dump-after=benchmark::State::ResumeTiming*",
    "--dump-before=benchmark::State::FinishKeepRunning*",
]


def instructions_in(dumps: list[str]) -> int:
    """Instructions of the last timed loop, from callgrind's dumps in their order. Raises Trouble if there is none."""
    total, found = 0, False
    for dump in dumps:
        trigger = re.search(r"^desc: Trigger: (.*)$", dump, re.M)
        summary = re.search(r"^(?:summary|totals): (\d+)", dump, re.M)
        if not trigger or not summary:
            continue
        if "StartKeepRunning" in trigger[1]:
            total, found = 0, True
        elif "PauseTiming" in trigger[1] or "FinishKeepRunning" in trigger[1]:
            total += int(summary[1])
    if not found:
        raise Trouble("callgrind did not see the loop of a bench; is libbenchmark linked as a shared library?")
    return total


def things_in(row: dict, counter: str) -> float:
    """How many things a run did in all."""
    seconds = row["cpu_time"] * SECONDS[row["time_unit"]] * row["iterations"]
    return row["iterations"] if not counter else seconds * 1e9 / nanoseconds_each(row, counter)


def count(binary: Path, name: str, counter: str, quick: bool) -> float:
    """Instructions of one thing of the bench `name`."""
    with tempfile.TemporaryDirectory() as scratch:
        results = Path(scratch) / "results.json"
        dumps = Path(scratch) / "callgrind"
        run(
            [
                "valgrind",
                "--tool=callgrind",
                f"--callgrind-out-file={dumps}",
                *_SWITCHES,
                str(binary),
                f"--benchmark_filter=^{re.escape(name)}$",
                f"--benchmark_out={results}",
                "--benchmark_out_format=json",
                f"--benchmark_min_time={0.0001 if quick else 0.01}",
            ],
            memory=False,
            env={**os.environ, "LD_BIND_NOW": "1"},
        )  # a library's functions are not looked up inside the loop
        parts = sorted(Path(scratch).glob("callgrind.*"), key=lambda path: int(path.suffix[1:]))
        row = json.loads(results.read_text(encoding="utf-8"))["benchmarks"][0]
        return instructions_in([part.read_text(encoding="utf-8", errors="replace") for part in parts]) / things_in(
            row, counter
        )


def measure(folder: Path, programs: list[Program], progress: Progress, quick: bool, results: dict[str, dict]) -> None:
    """Adds "instructions" to the results of the benches that are counted;
    of a quick run, to the first two of a program."""
    for program in programs:
        progress.step(f"instructions of bench_{program.name}")
        if program.prefix:
            continue
        done = 0
        for name in names_of(folder / f"bench_{program.name}"):
            bench, plain = bench_of(program, plain_name(name)), plain_name(name)
            if (
                not bench
                or not bench.counted
                or not re.search(bench.counted, plain)
                or plain not in results.get(program.key, {})
                or "avx512" in plain
            ):
                continue
            if quick and done == 2:
                break
            done += 1
            Progress.within(name)
            try:
                results[program.key][plain]["instructions"] = count(
                    folder / f"bench_{program.name}", name, bench.unit.counter, quick
                )
            except Trouble as trouble:
                say(f"{name} is not counted: {trouble}")
        Progress.end_within()
        say(f"{done} counted")
