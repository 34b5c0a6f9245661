"""Measurements of whole programs on whole files: time, peak memory, and their growth with lines, edges, clients and
cards."""
import math
import re
from pathlib import Path

from running import Progress, Trouble, best_of, run

#: One pass of the router's X axis: 100 mm at 800 counts/mm.
COUNTS_A_PASS = 80_000


def spiral(lines: int) -> str:
    """Returns a program with this many lines of 0.3 mm along a spiral that swings in and out, as in bench_job."""
    out = ["G21 G90 G64 P0.02", "G0 X150 Y100", "G1 F3000"]
    angle = 0.0
    for i in range(1, lines + 1):
        radius = 50 + 40 * math.sin(i * 0.001)
        angle += 0.3 / radius
        out.append(f"X{150 + radius * math.cos(angle):.4f} Y{100 + radius * math.sin(angle):.4f}")
    return "\n".join([*out, "M2", ""])


def passes(edges: int) -> str:
    """Returns a program that turns the router's X encoder by about this many counts, to and fro over at most 100 mm."""
    out = ["G21 G90 G64 P0"]
    for i in range(max(1, round(edges / COUNTS_A_PASS))):
        way = min(100.0, edges / 800)
        out.append(f"G0 X{way:.4f}" if i % 2 == 0 else "G0 X0")
    return "\n".join([*out, "M2", ""])


def growth_with_lines(program: Path, scratch: Path, progress: Progress, quick: bool) -> list[dict]:
    """Measures check, run and plan on programs of 1,000 to 300,000 lines."""
    progress.step("programs of many lines")
    rows = []
    for lines in (1_000, 10_000) if quick else (1_000, 10_000, 100_000, 300_000):
        file = scratch / f"spiral{lines}.ngc"
        file.write_text(spiral(lines), encoding="ascii")
        row: dict = {"n": lines}
        for verb, argv in (("check", ["check"]), ("run", ["run", "--no-report", "-q"]), ("plan", ["plan"])):
            Progress.within(f"motionrack {verb}, {lines} lines")
            ran = run([str(program), *argv, str(file)], cwd=scratch)
            row[verb] = {"cpu_s": ran.cpu_s, "peak_bytes": ran.peak_bytes}
        rows.append(row)
        file.unlink()
    Progress.end_within()
    return rows


def counts_decoded(text: str) -> int:
    """Returns up plus down counts of the only channel that `motionrack decode` printed. Raises Trouble if none was."""
    found = re.search(r"^\S+\s+\S+_enc_a,\S+\s+(-?\d+)\s+(\d+)\s+(\d+)", text, re.M)
    if not found:
        raise Trouble(f"motionrack decode told of no encoder:\n{text}")
    return int(found[2]) + int(found[3])


def growth_with_edges(program: Path, scratch: Path, progress: Progress, quick: bool) -> list[dict]:
    """Measures the writing of 10,000 to 10,000,000 encoder edges into VCD files, and their decoding."""
    progress.step("many edges written and decoded")
    rows = []
    for edges in (10_000, 100_000) if quick else (10_000, 100_000, 1_000_000, 10_000_000):
        Progress.within(f"{edges} edges")
        moves, waves = scratch / "passes.ngc", scratch / "passes.vcd"
        moves.write_text(passes(edges), encoding="ascii")
        trace = run(
            [str(program), "trace", str(moves), str(waves), "--signals", "X.enc_a", "--signals", "X.enc_b", "-q"],
            cwd=scratch,
        )
        decode = best_of(1 if quick else 3, [str(program), "decode", str(waves), "-q"], cwd=scratch)
        rows.append(
            {
                "n": counts_decoded(decode.out),
                "file_bytes": waves.stat().st_size,
                "trace": {"cpu_s": trace.cpu_s, "peak_bytes": trace.peak_bytes},
                "decode": {"cpu_s": decode.cpu_s, "peak_bytes": decode.peak_bytes},
            }
        )
        waves.unlink()
    Progress.end_within()
    return rows


_SERVED = {
    "pictures_a_second": r"^pictures +(\d+) a second",
    "lost": r"a second, (-?\d+) of",
    "p50_ms": r"^lateness p50 +([\d.]+)",
    "p99_ms": r"^lateness p99 +([\d.]+)",
    "max_ms": r"^lateness max +([\d.]+)",
    "served_percent": r"^processor +(\d+) %",
    "read_percent": r"served, (\d+) % read",
    "peak_megabytes": r"^memory +([\d.]+) MB",
}


def growth_with_clients(folder: Path, progress: Progress, quick: bool) -> list[dict]:
    """Measures a server with WebSocket clients that read a running job at 20 Hz."""
    progress.step("clients of a served rack")
    rows = []
    for clients in (1, 10) if quick else (1, 10, 50, 100, 200, 400):
        Progress.within(f"{clients} clients")
        out = run([str(folder / "bench_serve"), str(clients), "20", "2" if quick else "20"], memory=False).out
        row: dict = {"n": clients}
        for key, pattern in _SERVED.items():
            found = re.search(pattern, out, re.M)
            if not found:
                raise Trouble(f"bench_serve printed no {key}:\n{out}")
            row[key] = float(found[1])
        rows.append(row)
    Progress.end_within()
    return rows


def growth_with_cards(folder: Path, progress: Progress, quick: bool) -> list[dict]:
    """Measures the peak memory of bench_growth with 1 to 32 cards."""
    progress.step("memory of many cards")
    return [
        {
            "n": cards,
            "peak_bytes": run(
                [str(folder / "bench_growth"), f"--benchmark_filter=^cards/{cards}$", "--benchmark_min_time=0.05"]
            ).peak_bytes,
        }
        for cards in ((1, 8) if quick else (1, 2, 4, 8, 16, 32))
    ]


def captures(scratch: Path, quick: bool) -> list[tuple[str, Path, int, list[str]]]:
    """Writes captures of one turning encoder. Returns for each a description, the file, the number of its samples,
    and the options of `motionrack decode` for it."""
    turns = 100_000 if quick else 4_000_000
    raw, csv = scratch / "turns.bin", scratch / "turns.csv"
    raw.write_bytes(b"\0\1\3\2" * (turns * 4))
    csv.write_bytes(b"enc_a,enc_b\n" + b"0,0\n1,0\n1,1\n0,1\n" * turns)
    rate = ["--sample-rate", "10M"]
    return [
        ("raw capture, a byte a sample, a count each", raw, 16 * turns, [*rate, "--channel", "X=0,1"]),
        ("CSV, a count each row", csv, 4 * turns, [*rate, "--channel", "X=enc_a,enc_b"]),
    ]


def programs(program: Path, scratch: Path, progress: Progress, quick: bool, part: Path) -> list[dict]:
    """Measures CPU time and peak memory of the commands that users run."""
    progress.step("whole programs")
    times = 1 if quick else 5
    table = [
        ("nothing: `motionrack --version`", ["--version"]),
        ("`motionrack check` of the example part", ["check", str(part)]),
        ("`motionrack plan` of it", ["plan", str(part)]),
        ("`motionrack run` of it, 40 s of four axes", ["run", str(part), "--no-report", "-q"]),
        ("the same with its report", ["run", str(part), "--report", "report.html", "-q"]),
        ("the same with a recording of everything", ["run", str(part), "--no-report", "--record", "part.h5", "-q"]),
        ("`motionrack replay` of that", ["replay", "part.h5"]),
        ("`motionrack diff` of it with itself", ["diff", "part.h5", "part.h5"]),
    ]
    rows = []
    for what, argv in table:
        Progress.within(what)
        ran = best_of(times, [str(program), *argv], cwd=scratch)
        rows.append({"what": what, "cpu_s": ran.cpu_s, "peak_bytes": ran.peak_bytes})
    for what, file, samples, told in captures(scratch, quick):
        Progress.within(what)
        ran = best_of(times, [str(program), "decode", str(file), "-q", *told], cwd=scratch)
        rows.append(
            {
                "what": f"`motionrack decode`: {what}, {file.stat().st_size // 1_000_000} MB",
                "cpu_s": ran.cpu_s,
                "peak_bytes": ran.peak_bytes,
                "samples": samples,
                "bytes": file.stat().st_size,
            }
        )
        file.unlink()
    Progress.end_within()
    return rows
