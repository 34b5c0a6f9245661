"""Instructions per thing, counted by callgrind: the load of the machine does not change them.

    StartKeepRunning │ the loop ... PauseTiming │ ... │ ResumeTiming ... │ FinishKeepRunning
                     └ counted ───────────────────┘   └ counted ─────────┘

Google Benchmark calls these four functions around the code that it times. callgrind dumps and clears its counters on
their entry or exit, so that instructions before the loop are not counted.
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
    """Returns the instructions of the last timed loop in callgrind's dumps. Raises Trouble if there is none."""
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
    """Returns the number of things that a run did in all."""
    seconds = row["cpu_time"] * SECONDS[row["time_unit"]] * row["iterations"]
    return row["iterations"] if not counter else seconds * 1e9 / nanoseconds_each(row, counter)


def count(binary: Path, name: str, counter: str, quick: bool) -> float:
    """Returns the instructions per thing of the bench `name`."""
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
        )  # LD_BIND_NOW: resolves functions of libraries before the loop
        parts = sorted(Path(scratch).glob("callgrind.*"), key=lambda path: int(path.suffix[1:]))
        row = json.loads(results.read_text(encoding="utf-8"))["benchmarks"][0]
        return instructions_in([part.read_text(encoding="utf-8", errors="replace") for part in parts]) / things_in(
            row, counter
        )


def measure(folder: Path, programs: list[Program], progress: Progress, quick: bool, results: dict[str, dict]) -> None:
    """Adds "instructions" to the results of all counted benches;
    in a quick run, to those of the first two of each program."""
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
