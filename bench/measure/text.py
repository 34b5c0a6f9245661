"""Formats of numbers and tables on the page: three digits, thousands with commas."""
import re
import textwrap
from collections.abc import Sequence

_COLUMNS = 118

_SCALES = ((1e9, "s"), (1e6, "ms"), (1e3, "us"), (1, "ns"))


def digits(value: float) -> str:
    """Returns a number with three significant digits."""
    if value == 0:
        return "0"
    size = abs(value)
    if size >= 100:
        return f"{float(f'{value:.3g}'):,.0f}"
    places = 0
    while size < 100 and places < 7:
        size *= 10
        places += 1
    return f"{value:.{places}f}"


def time_of(ns: float) -> str:
    """Returns a time in the largest unit that is not longer than it: s, ms, us or ns."""
    for scale, unit in _SCALES:
        if ns >= scale:
            return f"{digits(ns / scale)} {unit}"
    return f"{digits(ns)} ns"


def bytes_of(value: float) -> str:
    return f"{digits(value / 1e6)} MB" if value >= 1e6 else f"{digits(value / 1e3)} kB"


def count(value: float) -> str:
    return f"{value:,.0f}" if value >= 1000 or value == int(value) else digits(value)


def ratio(value: float) -> str:
    return digits(value)


def not_measured(got: dict) -> str:
    """Returns the sentence for a part of the page that is empty, with the reason from its results."""
    return "Not measured in this run" + (f": {got['missing']}" if got else ".")


def paragraph(text: str) -> list[str]:
    """Returns the lines of a paragraph; keeps text in backquotes on one line."""
    joined = re.sub(r"`[^`]*`", lambda code: code[0].replace(" ", "\0"), text)
    lines = textwrap.wrap(joined, _COLUMNS, break_long_words=False, break_on_hyphens=False)
    return [line.replace("\0", " ") for line in lines]


def table(heads: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> list[str]:
    """Returns a Markdown table; escapes bars inside cells."""

    def line(cells: tuple[str, ...]) -> str:
        return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"

    return [line(heads), "|" + "---|" * len(heads), *(line(row) for row in rows)]
