"""The tables of the page with whole programs, and with growth by lines, edges, clients and cards."""
from kinds import belongs
from table import PROGRAMS
from text import bytes_of, count, digits, not_measured, paragraph, table, time_of


def _each(cpu_s: float, things: float) -> str:
    return time_of(1e9 * cpu_s / things)


def whole_programs(results: dict) -> list[str]:
    made = results.get("programs", {})
    if not isinstance(made, list):
        return ["", "## Whole programs", "", not_measured(made)]
    rows = [
        (
            row["what"],
            time_of(1e9 * row["cpu_s"]),
            f"{digits(row['bytes'] / row['cpu_s'] / 1e6)} MB/s, {_each(row['cpu_s'], row['samples'])} a sample"
            if "bytes" in row
            else "",
            bytes_of(row["peak_bytes"]),
        )
        for row in made
    ]
    return [
        "",
        "## Whole programs",
        "",
        *paragraph(
            "The program from its start to its end, files in the page cache: the minimum CPU time of some runs, and "
            "the peak of its resident memory."
        ),
        "",
        *table(("program", "CPU time", "", "peak memory"), rows),
    ]


def _lines(rows: list[dict]) -> list[str]:
    cells = [
        (
            count(row["n"]),
            *(
                cell
                for verb in ("check", "run", "plan")
                for cell in (_each(row[verb]["cpu_s"], row["n"]), bytes_of(row[verb]["peak_bytes"]))
            ),
        )
        for row in rows
    ]
    return [
        "",
        *paragraph(
            "**Blocks.** A spiral of lines of 0.3 mm, by `motionrack check`, `run` (planned, executed, monitored; no "
            "report) and `plan` (jerk-limited): CPU time a line, start of the program included, and peak memory."
        ),
        "",
        *table(("lines", "check, a line", "memory", "run, a line", "memory", "plan, a line", "memory"), cells),
    ]


def _edges(rows: list[dict]) -> list[str]:
    cells = [
        (
            count(row["n"]),
            bytes_of(row["file_bytes"]),
            _each(row["trace"]["cpu_s"], row["n"]),
            bytes_of(row["trace"]["peak_bytes"]),
            _each(row["decode"]["cpu_s"], row["n"]),
            bytes_of(row["decode"]["peak_bytes"]),
        )
        for row in rows
    ]
    return [
        "",
        *paragraph(
            "**Edges.** Encoder edges of a running axis written into a VCD file by `motionrack trace`, and counted "
            "from it by `motionrack decode`: CPU time an edge, start of the program included, and peak memory."
        ),
        "",
        *table(("edges", "file", "trace, an edge", "memory", "decode, an edge", "memory"), cells),
    ]


def _clients(rows: list[dict]) -> list[str]:
    cells = [
        (
            count(row["n"]),
            count(row["pictures_a_second"]),
            f"{row['lost']:.0f}",
            f"{row['p50_ms']:.2f} ms",
            f"{row['p99_ms']:.2f} ms",
            f"{row['max_ms']:.1f} ms",
            f"{row['served_percent']:.0f} %",
            f"{1e4 * row['served_percent'] / row['pictures_a_second']:.0f} us" if row["pictures_a_second"] else "",
            f"{row['peak_megabytes']:.0f} MB",
        )
        for row in rows
    ]
    return [
        "",
        *paragraph(
            "**Clients.** WebSocket clients that read snapshots 20 times a second from a job of four axes in step with "
            "real time (`bench_serve`): the lateness of slices of 2 ms of the rack's time, the server's share of one "
            "core, the same per snapshot (the job, which runs anyway, included), and its peak memory."
        ),
        "",
        *table(
            (
                "clients",
                "snapshots a second",
                "lost",
                "half of the slices within",
                "99 %",
                "the latest",
                "of a core",
                "a snapshot",
                "memory",
            ),
            cells,
        ),
    ]


def _cards(results: dict) -> list[str]:
    cards = results["growth"].get("cards", [])
    memory = {f"cards/{row['n']}": row["peak_bytes"] for row in cards} if isinstance(cards, list) else {}
    program = next(program for program in PROGRAMS if program.name == "growth")
    measured = results["benches"].get("growth", {})
    cells = []
    for bench in program.benches:
        names = [name for name in measured if belongs(name, bench)]
        if not names:
            cells.append((f"`{bench.name}`", bench.means, "not measured", "", "", "", ""))
        for name in names:
            row = measured[name]
            cells.append(
                (
                    f"`{name}`",
                    bench.means,
                    f"{time_of(row['ns'])} a {bench.unit.thing}",
                    count(row["instructions"]) if "instructions" in row else "",
                    count(row["sim_s/s"]),
                    bytes_of(row["snapshot_bytes"]) if "snapshot_bytes" in row else "",
                    bytes_of(memory[name]) if name in memory else "",
                )
            )
    return [
        "",
        *paragraph(f"**Axes and cards.** `bench_growth`. {program.text} Memory is that of the whole process."),
        "",
        *table(
            ("bench", "content", "each", "instructions", "virtual seconds a second", "snapshot", "peak memory"), cells
        ),
    ]


def growth(results: dict) -> list[str]:
    out = ["", "## Growth", *_cards(results)]
    for what, told, shown in (
        ("lines", "Blocks", _lines),
        ("edges", "Edges", _edges),
        ("clients", "Clients", _clients),
    ):
        rows = results["growth"].get(what, {})
        out += shown(rows) if isinstance(rows, list) else ["", f"**{told}.** {not_measured(rows)}"]
    return out
