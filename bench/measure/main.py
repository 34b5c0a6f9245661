"""Command line of bench/page, which builds the programs: measures everything, writes docs/reference/performance.md."""
import argparse
import json
import sys
import tempfile
import time
from pathlib import Path
from typing import Callable

import benches
import build
import instructions
import peers
import whole
from kinds import ROOT
from machine import machine
from page import page
from running import Progress, Trouble, say
from table import PROGRAMS

STORED = ROOT / "bench/measured.json"
PAGE = ROOT / "docs/reference/performance.md"


def options(argv: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="bench/page",
        description="Runs every benchmark, counts instructions, measures a build, memory, growth and peers, and writes "
        "docs/reference/performance.md. Takes some 35 minutes on an otherwise idle machine; progress is "
        "reported during the run.",
        epilog="Example: bench/page --quick    a small run of everything, into build/bench/performance.md",
    )
    parser.add_argument(
        "--quick",
        action="store_true",
        help="a small run, whose times are not reliable: each bench once, small files; the page goes to "
        "build/bench/performance.md; no build is measured",
    )
    parser.add_argument(
        "--only",
        nargs="+",
        default=[],
        metavar="PROGRAM",
        help="these benchmark programs alone, without peers, growth and whole programs; the page goes to "
        "build/bench/performance.md. One of: " + ", ".join(sorted({program.name for program in PROGRAMS})) + ". Or "
        "'build': how long a build takes, which is put into bench/measured.json beside the numbers that are there; the "
        "whole page is written",
    )
    parser.add_argument(
        "--from",
        dest="stored",
        metavar="FILE",
        help="measure nothing, write the page from these results (a run's are in bench/measured.json)",
    )
    parser.add_argument(
        "--output",
        metavar="FILE",
        help="where the page goes, '-': standard output; its results go beside it, as FILE with .json",
    )
    parser.add_argument("--build", default="build/bench", metavar="FOLDER", help=argparse.SUPPRESS)
    return parser.parse_args(argv)


def tried(measuring: Callable, *how):
    """Returns the result of a measurement, or {"missing": reason} after Trouble: the run continues without it."""
    try:
        return measuring(*how)
    except Trouble as trouble:
        say(str(trouble))
        return {"missing": str(trouble).splitlines()[0]}


def measure(folder: Path, names: list[str], quick: bool) -> dict:
    """Measures all parts of a run and returns the results. `folder`: the build folder."""
    begin = time.monotonic()
    programs = benches.chosen(names)
    progress = Progress(2 * len(programs) + (0 if names else 8) + (0 if names or quick else 1))
    results: dict = {"quick": quick, "machine": machine(folder), "benches": {}, "growth": {}, "peers": {}}
    if results["machine"]["load"] > 0.5:
        say(
            f"the machine is busy (load {results['machine']['load']:.1f}): times and ratios of peers will be off; end "
            "other programs, or accept that"
        )
    binaries, program = folder / "bench", folder / "bin/motionrack"
    if not names and not quick:
        results["build"] = tried(build.measure, progress)
    results["benches"] = benches.measure(binaries, programs, progress, quick)
    with tempfile.TemporaryDirectory(prefix="motionrack-page-") as name:
        scratch = Path(name)
        if not names:
            of_file, of_benches = (program, scratch, progress, quick), (binaries, progress, quick)
            results["peers"] = {
                "linuxcnc": tried(peers.linuxcnc_steps, scratch, progress, quick),
                "sigrok": tried(peers.sigrok, *of_file),
                "rs274": tried(peers.interpreter, *of_file),
            }
            results["programs"] = tried(whole.programs, *of_file, ROOT / "examples/02_part/part.ngc")
            results["growth"] = {
                "lines": tried(whole.growth_with_lines, *of_file),
                "edges": tried(whole.growth_with_edges, *of_file),
                "cards": tried(whole.growth_with_cards, *of_benches),
                "clients": tried(whole.growth_with_clients, *of_benches),
            }
    instructions.measure(binaries, programs, progress, quick, results["benches"])
    results["minutes"] = (time.monotonic() - begin) / 60
    return results


def with_build() -> dict:
    """Returns the stored results with a new measurement of the build."""
    return {**json.loads(STORED.read_text(encoding="utf-8")), "build": build.measure(Progress(1))}


def measured(asked: argparse.Namespace, folder: Path) -> dict:
    """Measures the parts that the options name. Raises Trouble for parts that are not measured together."""
    if "build" not in asked.only:
        return rounded(measure(folder, asked.only, asked.quick))
    if asked.quick or asked.only != ["build"]:
        raise Trouble(
            "A build is measured whole, and alone; nothing was measured. Do bench/page --only build, then the rest."
        )
    return rounded(with_build())


def rounded(value):
    """Rounds all floats to five significant digits: more would only add differences between two runs."""
    if isinstance(value, float):
        return float(f"{value:.5g}")
    if isinstance(value, dict):
        return {key: rounded(each) for key, each in value.items()}
    return [rounded(each) for each in value] if isinstance(value, list) else value


def stored_text(results: dict) -> str:
    """Returns the results as JSON with one bench or compilation per line, so that two runs can be compared by line."""
    sections = ",\n".join(
        f'  "{section}": {{\n'
        + ",\n".join(f"   {json.dumps(name)}: {json.dumps(row)}" for name, row in rows.items())
        + "\n  }"
        for section, rows in results["benches"].items()
    )
    bare: dict = {**results, "benches": None}
    made = results.get("build", {}).get("compilations")
    if made:
        bare["build"] = {**results["build"], "compilations": None}
    text = json.dumps(bare, indent=1).replace('"benches": null', '"benches": {\n' + sections + "\n }")
    if made:
        lines = ",\n".join(f"   {json.dumps(each)}" for each in made)
        text = text.replace('"compilations": null', '"compilations": [\n' + lines + "\n  ]")
    return text + "\n"


def main(argv: list[str]) -> int:
    asked = options(argv)
    try:
        if asked.stored:
            results, output = json.loads(Path(asked.stored).read_text(encoding="utf-8")), asked.output or PAGE
        else:
            folder = ROOT / asked.build
            results = measured(asked, folder)
            partial = asked.quick or asked.only not in ([], ["build"])
            output = asked.output or (folder / "performance.md" if partial else PAGE)
            stored = STORED if output == PAGE else Path(output).with_suffix(".json")
            if output != "-":
                stored.write_text(stored_text(results), encoding="utf-8")
        if output == "-":
            sys.stdout.write(page(results))
        else:
            Path(output).write_text(page(results), encoding="utf-8")
            say(f"wrote {output}")
    except (Trouble, OSError, json.JSONDecodeError) as trouble:
        say(str(trouble))
        return 1
    except KeyboardInterrupt:
        say("stopped; nothing was written")
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
