"""Recordings of a running rack: samples as NumPy arrays, waves written to a file."""

from __future__ import annotations

from collections.abc import Iterable
from types import TracebackType

from . import _core
from .errors import Refused
from .trace import Trace


class _Open:
    """A recording from its creation until it is stopped, at the latest at the end of its ``with`` block."""

    def __init__(self, world: _core.RackHandle) -> None:
        self._world = world
        self._runs = True

    def stop(self) -> object:
        raise NotImplementedError

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._runs and not self._world.closed():
            self.stop()


class Recording(_Open):
    """Samples of signals of a rack; see :meth:`Rack.record`."""

    def __init__(
        self, world: _core.RackHandle, signals: Iterable[str], period: int, max_samples: int, title: str
    ) -> None:
        self._title = title
        self._trace: Trace | None = None
        world.begin_samples(list(signals), period, max_samples)
        super().__init__(world)

    def __enter__(self) -> Recording:
        return self

    def stop(self) -> Trace:
        """Ends the recording with a last sample at this instant."""
        if self._trace is None:
            ticks, signals, units = self._world.end_samples()
            self._trace = Trace(ticks, signals, units, self._world.trace_hash(), self._title)
            self._runs = False
        return self._trace

    @property
    def trace(self) -> Trace:
        """The recorded data. Refused while the recording runs."""
        if self._trace is None:
            raise Refused("The recording still runs; stop it first.")
        return self._trace


class Waves(_Open):
    """Waves that are written to a file; see :meth:`Rack.waves`."""

    def __init__(self, world: _core.RackHandle, path: str, signals: Iterable[str]) -> None:
        self.path = path
        world.begin_waves(path, list(signals))
        super().__init__(world)

    def __enter__(self) -> Waves:
        return self

    def stop(self) -> None:
        """Ends the file. FileError."""
        if self._runs:
            self._runs = False
            self._world.end_waves()
