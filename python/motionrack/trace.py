"""Signals over time as NumPy arrays, and their pictures."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._time import TICKS_PER_SECOND
from .errors import InvalidInput, FileError, NoSuchName

Values = npt.NDArray[np.int64] | npt.NDArray[np.float64]
_LOOKS = "xyzabcd"


class Trace(Mapping[str, Values]):
    """Signals of a rack over time: ``trace.time``, ``trace["x.position"]``.

    Counts, pulses, registers and digital wires are int64, all else float64 in the unit of ``units``.
    Case is ignored if the name is unique.
    """

    def __init__(
        self,
        ticks: npt.NDArray[np.int64],
        signals: Mapping[str, Values],
        units: Mapping[str, str],
        trace_hash: str,
        title: str = "",
    ) -> None:
        self._ticks = ticks
        self._signals = dict(signals)
        self._units = dict(units)
        self._trace_hash = trace_hash
        self.title = title

    # ---- values ----

    @property
    def ticks(self) -> npt.NDArray[np.int64]:
        """Instants since the rack's start, whole ticks of 100 ps, non-decreasing."""
        return self._ticks

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Instants since the rack's start, s."""
        return self._ticks / float(TICKS_PER_SECOND)

    @property
    def units(self) -> dict[str, str]:
        """The unit of each signal: ``"mm"``, ``"deg/s"``, ``"counts"``, ``""``."""
        return dict(self._units)

    def _name(self, name: str) -> str:
        if name in self._signals:
            return name
        found = [signal for signal in self._signals if signal.lower() == name.lower()]
        if len(found) != 1:
            raise NoSuchName(f"The trace has no signal {name!r}; it has: {', '.join(self._signals) or 'none'}.")
        return found[0]

    def __getitem__(self, name: str) -> Values:
        return self._signals[self._name(name)]

    def __contains__(self, name: object) -> bool:
        return (
            isinstance(name, str)
            and sum(signal.lower() == name.lower() or signal == name for signal in self._signals) == 1
        )

    def __iter__(self) -> Iterator[str]:
        return iter(self._signals)

    def __len__(self) -> int:
        return len(self._signals)

    def hash(self) -> str:
        """Returns the hash of the rack's event trace at the end of this trace: 16 digits.

        It covers every change of a wire and every condition since the start of the rack, with its tick of 100 ps, also
        without recording: the same programs on the same rack have the same hash in C++, C, Python and on the command
        line.
        """
        return self._trace_hash

    def __repr__(self) -> str:
        span = f"{self.time[0]:.6g} .. {self.time[-1]:.6g} s" if len(self._ticks) else "empty"
        return f"<trace of {len(self._signals)} signals, {len(self._ticks)} instants, {span}, hash {self._trace_hash}>"

    # ---- pictures ----

    def _charts(self, names: tuple[str, ...]) -> list[tuple[str, list[str]]]:
        """Returns the signals to draw, grouped by units in the order of the names; all signals if none are given."""
        charts: dict[tuple[str, str], list[str]] = {}
        for name in [self._name(each) for each in names] or list(self._signals):
            kind = name.rsplit(".", 1)[-1] if self._units.get(name) else name
            charts.setdefault((kind, self._units.get(name, "")), []).append(name)
        return [(f"{kind}, {unit}" if unit else kind, members) for (kind, unit), members in charts.items()]

    def svg(self, *names: str, width: int = 720, height: int | None = None) -> str:
        """Returns a picture of these signals (of all if none are named), drawn without matplotlib:
        SVG, 100 to 10000 pixels."""
        charts = self._charts(names)
        drawn = [
            (
                title,
                [
                    (name if len(members) > 1 else "", _LOOKS[i % len(_LOOKS)], self[name])
                    for i, name in enumerate(members)
                ],
            )
            for title, members in charts
        ]
        if not drawn or len(self._ticks) < 2:
            raise InvalidInput("Nothing was drawn: a picture needs at least two instants and one signal.")
        return _core.svg_timeline(self.title, self.time, drawn, [], width, height or min(10000, 60 + 160 * len(drawn)))

    def plot(self, *names: str, path: str | None = None) -> Any:
        """Draws these signals (all if none are named) one below the other over s.

        With matplotlib: returns its figure, saved to ``path`` if given. Without: returns the trace itself, which a
        notebook shows as :meth:`svg`; ``path`` must then end in ``.svg``.
        """
        try:
            from matplotlib.figure import Figure  # type: ignore[import]
        except ImportError:
            if path is not None:
                if not os.fspath(path).endswith(".svg"):
                    raise InvalidInput(
                        f"Without matplotlib pictures are SVG files, and {os.fspath(path)} does not end in .svg. "
                        "Nothing was written; choose such a name, or install matplotlib."
                    ) from None
                self.save_svg(path, *names)
            return self
        charts = self._charts(names)
        if not charts:
            raise InvalidInput("Nothing was drawn: the trace has no signals.")
        figure = Figure(figsize=(9, 1.2 + 1.9 * len(charts)), layout="constrained")
        axes = figure.subplots(len(charts), 1, sharex=True, squeeze=False)[:, 0]
        for plot, (title, members) in zip(axes, charts):
            for name in members:
                whole = np.issubdtype(self[name].dtype, np.integer)
                plot.plot(self.time, self[name], label=name, drawstyle="steps-post" if whole else "default")
            plot.set_ylabel(title)
            plot.grid(alpha=0.3)
            if len(members) > 1:
                plot.legend(loc="best", fontsize="small")
        axes[-1].set_xlabel("s")
        if self.title:
            figure.suptitle(self.title)
        if path is not None:
            figure.savefig(path)
        return figure

    def save_svg(self, path: str, *names: str) -> None:
        """Writes :meth:`svg` to a file."""
        text = self.svg(*names)
        try:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        except OSError as error:
            raise FileError(f"{path} cannot be written: {error}.") from None

    def _repr_svg_(self) -> str | None:
        return self.svg() if self._signals and len(self._ticks) >= 2 else None
