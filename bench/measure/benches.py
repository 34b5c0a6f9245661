"""Runs of the benchmark programs (Google Benchmark): the median of each bench's repetitions, and their spread."""
import json
import re
import statistics
import subprocess
import tempfile
from pathlib import Path

from kinds import Bench, Program, bench_of, plain_name
from running import Progress, Trouble, run, say
from table import PROGRAMS

#: Counters whose median goes into the results, if a bench has them.
KEPT = (
    "ratio",
    "sim_s/s",
    "real time",
    "p50_us",
    "p99_us",
    "p999_us",
    "p99.9_us",
    "max_us",
    "peak_us",
    "lost",
    "dropped",
    "snapshot_bytes",
)
SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


def nanoseconds_each(row: dict, counter: str) -> float:
    """Returns the time of one thing, ns, from a row of Google Benchmark's JSON.
    Raises Trouble if the row does not have the counter."""
    if not counter:
        clock = row["real_time"] if "/real_time" in row["name"] else row["cpu_time"]
        return clock * SECONDS[row["time_unit"]] * 1e9
    if counter not in row:
        raise Trouble(f"{row['name']} has no counter {counter}; correct bench/measure/table.py.")
    return 1e9 / row[counter] if counter.endswith(("/s", "_per_second")) else 1e9 * row[counter]


def summary_of(rows: list[dict], bench: Bench) -> dict:
    """Returns the median of a bench's repetitions and, of two or more, the spread:
    the maximum distance from the median, as a fraction of it."""
    times = [nanoseconds_each(row, bench.unit.counter) for row in rows]
    median = statistics.median(times)
    out: dict = {"ns": median}
    if len(times) > 1 and median:
        out["spread"] = max(abs(t - median) for t in times) / median
    for counter in KEPT:
        if counter in rows[0]:
            out[counter] = statistics.median(row[counter] for row in rows)
    return out


def read_results(text: str, program: Program) -> dict[str, dict]:
    """Returns a summary of each bench in a program's JSON. Raises Trouble if a bench failed or is not in table.py."""
    rows: dict[str, list[dict]] = {}
    for row in json.loads(text)["benchmarks"]:
        if row.get("error_occurred"):
            raise Trouble(f"{row['name']}: {row['error_message']}")
        if row["run_type"] == "iteration":
            rows.setdefault(plain_name(row["name"]), []).append(row)
    out = {}
    for name, runs in rows.items():
        bench = bench_of(program, name)
        if not bench:
            raise Trouble(
                f"bench_{program.name} has the bench {name}, which is not in bench/measure/table.py; add it there with "
                "what it means."
            )
        out[name] = summary_of(runs, bench)
    return out


def allowed(prefix: tuple[str, ...]) -> bool:
    """Returns whether this machine can run programs with this command prefix; tries it with the program `true`."""
    if not prefix:
        return True
    try:
        return subprocess.run([*prefix, "true"], capture_output=True, check=False).returncode == 0
    except OSError:
        return False


def _follow(argv: list[str], expected: int) -> None:
    """Runs a program and shows its progress by bench. Raises Trouble if it fails."""
    with subprocess.Popen(argv, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        done: set[str] = set()
        said = []
        for line in process.stdout or ():
            said.append(line)
            name = line.split(" ")[0]
            if " ns " in line or " ms " in line or " us " in line:
                done.add(re.sub(r"_(mean|median|stddev|cv)$", "", name))
                Progress.within(f"{len(done)}/{expected} {name}")
    Progress.end_within()
    if process.returncode != 0:
        raise Trouble(f"{' '.join(argv)} ended with code {process.returncode}:\n{''.join(said)[-2000:]}")


def names_of(binary: Path, pattern: str = ".") -> list[str]:
    return run([str(binary), "--benchmark_list_tests=true", f"--benchmark_filter={pattern}"], memory=False).out.split()


def run_program(folder: Path, program: Program, quick: bool) -> dict[str, dict]:
    """Runs one program; returns the summaries of its benches. `quick`: one short repetition, without `network`."""
    binary = folder / f"bench_{program.name}"
    pattern = "|".join(
        f"^{re.escape(bench.name)}(/|$)" for bench in program.benches if not (quick and bench.name == "network")
    )
    with tempfile.TemporaryDirectory() as scratch:
        results = Path(scratch) / "results.json"
        _follow(
            [
                *program.prefix,
                str(binary),
                f"--benchmark_filter={pattern}",
                f"--benchmark_out={results}",
                "--benchmark_out_format=json",
                f"--benchmark_repetitions={1 if quick else 5}",
                f"--benchmark_min_time={0.005 if quick else 0.25}",
            ],
            len(names_of(binary, pattern)),
        )
        return read_results(results.read_text(encoding="utf-8"), program)


def measure(folder: Path, programs: list[Program], progress: Progress, quick: bool) -> dict[str, dict]:
    """Runs the programs; returns {section: {name: summary}}. Leaves out programs whose prefix cannot be used."""
    out: dict[str, dict] = {}
    for program in programs:
        progress.step(
            f"bench_{program.name}{' under ' + ' '.join(program.prefix) if program.prefix else ''}: "
            f"{len(program.benches)} benches"
        )
        if quick and program.prefix:
            say("left out in a quick run")
        elif not allowed(program.prefix):
            say(f"left out: this machine does not allow {' '.join(program.prefix)}")
        else:
            out[program.key] = run_program(folder, program, quick)
    return out


def chosen(names: list[str]) -> list[Program]:
    """Returns the programs with these names, all if no name is given. Raises Trouble for an unknown name."""
    known = {program.name for program in PROGRAMS}
    for name in names:
        if name not in known:
            raise Trouble(f"There is no bench program {name}; there are: {', '.join(sorted(known))}.")
    return [program for program in PROGRAMS if not names or program.name in names]
