"""Numbers and tables as a page shows them: three digits, thousands with commas."""
import re
import textwrap
from collections.abc import Sequence

_COLUMNS = 118

_SCALES = ((1e9, "s"), (1e6, "ms"), (1e3, "us"), (1, "ns"))


def digits(value: float) -> str:
    """Three significant digits."""
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
    """Nanoseconds in the unit that suits them."""
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
    """Why a part of the page is empty, of its results."""
    return "Not measured in this run" + (f": {got['missing']}" if got else ".")


def paragraph(text: str) -> list[str]:
    """The lines of a paragraph; text in backquotes stays on one line."""
    joined = re.sub(r"`[^`]*`", lambda code: code[0].replace(" ", "\0"), text)
    lines = textwrap.wrap(joined, _COLUMNS, break_long_words=False, break_on_hyphens=False)
    return [line.replace("\0", " ") for line in lines]


def table(heads: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> list[str]:
    """A Markdown table. Bars inside cells are escaped."""

    def line(cells: tuple[str, ...]) -> str:
        return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"

    return [line(heads), "|" + "---|" * len(heads), *(line(row) for row in rows)]
