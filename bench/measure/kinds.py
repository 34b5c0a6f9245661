"""Types that describe benchmark programs, and the assignment of measured names to benches."""
import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]


class Unit(NamedTuple):
    """Unit of a bench. `thing`: the noun whose time is measured. `counter`: a rate of things ("pulses/s") or the time
    of one ("each"); "": one call of the bench is one thing."""

    thing: str
    counter: str = ""


class Bench(NamedTuple):
    name: str
    means: str
    unit: Unit
    baseline: str = ""
    counted: str = "."


class Program(NamedTuple):
    name: str
    title: str
    text: str
    benches: list[Bench]
    prefix: tuple[str, ...] = ()
    section: str = ""  # key in the results; by default the program's name

    @property
    def key(self) -> str:
        return self.section or self.name


def names_in_sources() -> dict[str, set[str]]:
    """Returns the names of the benches that the sources declare, by program."""
    out: dict[str, set[str]] = {}
    for path in sorted((ROOT / "bench").glob("*_bench.cpp")):
        text = path.read_text(encoding="utf-8")
        names = set(re.findall(r"\bBENCHMARK\((\w+)\)", text))
        names |= {f"{family}/{case}" for family, case in re.findall(r"\bBENCHMARK_CAPTURE\((\w+),\s*(\w+)", text)}
        names |= {
            f"{family}<{kind}>" for family, kind in re.findall(r"\bBENCHMARK_TEMPLATE\((\w+),\s*([\w:]+)\)", text)
        }
        names |= set(re.findall(r'\badd\("(\w+)"', text))
        if names:
            out[path.name.removesuffix("_bench.cpp")] = names
    return out


def plain_name(name: str) -> str:
    """Returns a name that Google Benchmark prints, without the parts that only say how it was timed."""
    return re.sub(r"/(min_time:[\d.]+|real_time|process_time|repeats:\d+)", "", name)


def belongs(measured: str, bench: Bench) -> bool:
    """Returns whether a measured name is of this bench, with any arguments."""
    return measured == bench.name or measured.startswith(bench.name + "/")


def bench_of(program: Program, measured: str) -> Bench | None:
    """Returns the bench of a measured name, the one with the longest name; None if there is none."""
    found = [bench for bench in program.benches if belongs(measured, bench)]
    return max(found, key=lambda bench: len(bench.name)) if found else None
