"""Benches as such: what a program of them is made of, and whose a measured name is."""
import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]


class Unit(NamedTuple):
    """`thing`: one of it is what a bench's time is of. `counter`: counts it, as a rate ("pulses/s") or a time of one
    ("each"); "": one call of the bench is one thing."""

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
    section: str = ""  # of the results; by default the program's name

    @property
    def key(self) -> str:
        return self.section or self.name


def names_in_sources() -> dict[str, set[str]]:
    """The benches that the sources declare, by program."""
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
    """A name as Google Benchmark prints it, without what only says how it was timed."""
    return re.sub(r"/(min_time:[\d.]+|real_time|process_time|repeats:\d+)", "", name)


def belongs(measured: str, bench: Bench) -> bool:
    """Whether a measured name is of this bench, with whatever arguments."""
    return measured == bench.name or measured.startswith(bench.name + "/")


def bench_of(program: Program, measured: str) -> Bench | None:
    """The bench with the longest name that a measured one is of."""
    found = [bench for bench in program.benches if belongs(measured, bench)]
    return max(found, key=lambda bench: len(bench.name)) if found else None
