"""The page docs/reference/performance.md, made from the results of a run."""
from aims import verdicts
from build_page import building
from growth_page import growth, whole_programs
from kinds import Bench, Program, bench_of
from peers_page import peers
from table import PROGRAMS
from text import count, paragraph, ratio, table, time_of


def _head(results: dict) -> list[str]:
    machine = results["machine"]
    others = ", ".join(f"{name} {version}" for name, version in machine["peers"].items() if version)
    return [
        "# Performance",
        "",
        *paragraph(
            "Made by one command, [`bench/page`](../../bench/README.md), which measures everything here one after "
            "the other; each ratio is between two numbers of the same run. Every number is of one core, except those "
            "of a build."
        ),
        "",
        *table(
            ("", ""),
            [
                (
                    "machine",
                    f"{machine['cpu']}{' (virtual)' if machine['virtual'] else ''}, {machine['cores']} cores, "
                    f"{machine['memory_gb']} GB",
                ),
                ("system", f"{machine['system']}, kernel {machine['kernel']}, {machine['compiler']}, Release"),
                ("beside", others),
                (
                    "made",
                    f"{machine['day']}, version {machine['version']}, load {machine['load']:.1f} at the start, "
                    f"{results['minutes']:.0f} minutes"
                    + ("; **a quick run, whose times are not reliable**" if results["quick"] else ""),
                ),
            ],
        ),
        "",
        *paragraph(
            "*each*: the time of one pulse, edge, frame or other unit of the row: the median of five repetitions, and "
            "the maximum distance of a repetition from it. *instructions*: for the same unit, counted by callgrind, so "
            "that other work on the machine does not change them. *times as fast*: compared with the row named, or "
            "with the baseline inside the bench; below 1 the baseline is faster."
        ),
    ]


def _aims(results: dict) -> list[str]:
    rows = verdicts(results)
    return ["", "## Aims", "", *table(("aim", "limit", "measured", ""), rows)] if rows else []


def _compared(bench: Bench, row: dict, rows: dict[str, dict]) -> str:
    """Returns the ratio of a bench to its baseline as text; "" if it has none."""
    if bench.baseline and bench.baseline in rows:
        return f"{ratio(rows[bench.baseline]['ns'] / row['ns'])} `{bench.baseline}`"
    return ratio(row["ratio"]) if "ratio" in row else ""


def _bench_rows(program: Program, measured: dict[str, dict]) -> list[tuple[str, ...]]:
    """Returns a row for each measured name of a program, and for each bench that was not measured."""
    out: list[tuple[str, ...]] = []
    for bench in program.benches:
        names = [name for name in measured if bench_of(program, name) is bench]
        if not names:
            out.append((f"`{bench.name}`", bench.means, bench.unit.thing, "not measured", "", ""))
        for name in names:
            row = measured[name]
            out.append(
                (
                    f"`{name}`",
                    bench.means,
                    bench.unit.thing,
                    time_of(row["ns"]) + (f" ± {100 * row['spread']:.0f} %" if "spread" in row else ""),
                    count(row["instructions"]) if "instructions" in row else "",
                    _compared(bench, row, measured),
                )
            )
    return out


def _below(program: Program, measured: dict[str, dict]) -> list[str]:
    """Returns the second table of programs that have one: ages of frames (dds), slowest blocks (curve)."""
    if program.name == "dds":
        rows = [
            (
                f"`{name}`",
                *(f"{row[key]:,.0f}" for key in ("p50_us", "p99_us", "p999_us", "max_us")),
                f"{row['lost']:.0f}, {row['dropped']:.0f}",
            )
            for name, row in measured.items()
            if "p50_us" in row
        ]
        return (
            ["", *table(("age of a frame, us", "half within", "99 %", "99.9 %", "the oldest", "lost, dropped"), rows)]
            if rows
            else []
        )
    if program.name == "curve":
        rows = [
            (f"`{name}`", f"{row['p99.9_us']:,.1f} us", f"{row['peak_us']:,.0f} us")
            for name, row in measured.items()
            if "peak_us" in row
        ]
        return ["", *table(("a block", "999 of 1,000 within", "the slowest"), rows)] if rows else []
    return []


def _program(program: Program, results: dict) -> list[str]:
    measured = results["benches"].get(program.key, {})
    if program.prefix and not measured:
        return ["", f"### {program.title}", "", *paragraph(f"{program.text} Not measured in this run.")]
    heads = ("bench", "content", "of one", "each", "instructions", "times as fast")
    return [
        "",
        f"### {program.title}",
        "",
        *paragraph(f"`bench_{program.name}`. {program.text}"),
        "",
        *table(heads, _bench_rows(program, measured)),
        *_below(program, measured),
    ]


def page(results: dict) -> str:
    """Returns the page as Markdown."""
    lines = _head(results) + _aims(results) + peers(results) + whole_programs(results) + growth(results)
    lines += building(results)
    lines += ["", "## Every bench", "", "The programs are described in [bench/README.md](../../bench/README.md)."]
    for program in PROGRAMS:
        if program.name != "growth":
            lines += _program(program, results)
    return "\n".join(lines) + "\n"
