"""A machine that is operated while it runs, in steps of simulated time with commands between them."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from types import TracebackType

from . import _core
from ._time import ticks_of
from .errors import Refused, Timeout
from .rack import Rack


@dataclass(frozen=True)
class AxisStatus:
    """One axis: positions in ``unit`` (mm or deg), velocity per s.
    ``true_position`` is the position of the simulated table, independent of all counters."""

    unit: str
    position_valid: bool  #: the positions are those of the machine: homed, declared or kept over a clean restart
    enabled: bool
    commanded: float
    actual: float
    true_position: float
    velocity: float
    pulses: int
    counts: int


@dataclass(frozen=True)
class Alarm:
    """An alarm (ISA-18.2): ``active`` until a reset or until its cause ends; ``seconds`` since the start."""

    number: int
    seconds: float
    source: str
    text: str
    active: bool
    acknowledged: bool


@dataclass(frozen=True)
class Status:
    """The status of a machine at one instant."""

    seconds: float
    ticks: int
    state: str  #: disabled, standstill, homing, moving, jogging, hold, stopping, error stop or service
    reason: str  #: why it stopped last, or why it holds
    axes: dict[str, AxisStatus]
    program: str
    line: int
    lines: int
    program_runs: bool
    feed_override: float
    rapid_override: float
    homing: str
    alarms: list[Alarm]


class Machine:
    """A rack that is operated while it runs: programs with hold and resume, jogs, homing, alarms,
    as on the operator panel.

    Time advances only in :meth:`advance` and :meth:`wait`, in slices of 2 ms; commands are executed between two slices,
    also during a motion. The same commands at the same times give the same event trace.
    The position of an axis with a home switch is not valid until the axis is homed or its position is set.
    """

    def __init__(self, rack: Rack) -> None:
        """Creates a machine with the file of ``rack``, at time 0, disabled. Refused if no program can run on it."""
        self._core: _core.SteppedMachine | None = _core.SteppedMachine(rack._world)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Machine:
        """See :meth:`Rack.from_file`."""
        return cls(Rack.from_file(path))

    @classmethod
    def from_text(cls, text: str) -> Machine:
        """See :meth:`Rack.from_text`."""
        return cls(Rack.from_text(text))

    @classmethod
    def template(cls, name: str = "router") -> Machine:
        """See :meth:`Rack.template`."""
        return cls(Rack.template(name))

    def _operated(self) -> _core.SteppedMachine:
        if self._core is None:
            raise Refused("The machine was closed; nothing was done. Open another one.")
        return self._core

    def close(self) -> None:
        """Stops all motion and ends the machine."""
        self._core = None

    def __enter__(self) -> Machine:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # ---- time ----

    def advance(self, seconds: float = 0.0, *, ms: float = 0) -> None:
        """Runs the machine for the sum of the given times, in whole slices of 2 ms."""
        self._operated().advance(ticks_of(seconds, ms))

    def wait(self, until: str | Callable[[Status], object], timeout: float, poll: float = 2e-3) -> Status:
        """Runs until the machine has that state, or ``until(status)`` is true,
        checked every ``poll`` s (at least a slice, 0.002). Timeout after ``timeout`` s."""
        end = self.status.ticks + ticks_of(timeout)
        while True:
            status = self.status
            if status.state == until if isinstance(until, str) else until(status):
                return status
            if status.ticks >= end:
                raise Timeout(
                    f"Timed out after {timeout:g} s; the machine is {status.state} at "
                    f"{status.seconds:.9g} s. {status.reason}".rstrip()
                )
            self.advance(max(poll, 2e-3))

    # ---- looking ----

    @property
    def status(self) -> Status:
        """The status of the machine at this instant."""
        data = dict(self._operated().status())
        axes = {letter: AxisStatus(**axis) for letter, axis in data.pop("axes").items()}
        return Status(axes=axes, alarms=[Alarm(*alarm) for alarm in data.pop("alarms")], **data)

    @property
    def state(self) -> str:
        """disabled, standstill, homing, moving, jogging, hold, stopping, error stop or service."""
        return self.status.state

    def trace_hash(self) -> str:
        """Returns the hash of the event trace so far; see :meth:`Trace.hash`."""
        return self._operated().trace_hash()

    def get(self, name: str) -> float:
        """Returns a quantity of a part, ``"X.position_mm"``; see :meth:`Rack.get`."""
        return self._operated().quantity(name)

    # ---- commands; rejected commands change nothing ----

    def enable(self, axes: str = "") -> None:
        """Enables these axes; ``""``: all."""
        self._operated().enable(True, axes)

    def disable(self, axes: str = "") -> None:
        """Stops all motion, then disables these axes; ``""``: all."""
        self._operated().enable(False, axes)

    def start_program(self, program: str, name: str = "") -> None:
        """Checks the whole program, then starts it. InvalidInput with line and column;
        Refused unless the machine is enabled and at standstill, with valid positions."""
        self._operated().start_program(program, name)

    def hold(self) -> None:
        """Feed hold: decelerates along the path."""
        self._operated().hold()

    def resume(self) -> None:
        """Resumes after a feed hold."""
        self._operated().resume()

    def stop(self) -> None:
        """Decelerates all axes to a stop and discards programs; nothing moves until a reset. Never refused."""
        self._operated().stop()

    def reset(self) -> None:
        """Ends a stop; moves nothing."""
        self._operated().reset()

    def home(self, axes: str = "") -> None:
        """Homes these axes; ``""``: all that have a home switch."""
        self._operated().home(axes)

    def jog(self, axis: str, speed: float) -> None:
        """Jogs at ``speed`` (mm/s or deg/s, the sign is the direction); must be repeated within 0.25 s to continue."""
        self._operated().jog(axis, speed)

    def jog_by(self, axis: str, distance: float, speed: float) -> None:
        """Jogs by a distance, mm or deg, at ``speed`` per s (> 0)."""
        self._operated().jog_by(axis, distance, speed)

    def set_position(self, axis: str, position: float) -> None:
        """Sets the position of a stationary axis, mm or deg, and makes it valid. Refused while an axis moves."""
        self._operated().set_position(axis, position)

    def set_overrides(self, feed: float = 1.0, rapid: float = 1.0) -> None:
        """Sets the feed override (more than 0 up to 2) and the rapid override (more than 0 up to 1)."""
        self._operated().set_overrides(feed, rapid)

    def acknowledge_alarm(self, alarm: int) -> bool:
        """Acknowledges an alarm by its number; False for an unknown number."""
        return self._operated().acknowledge_alarm(alarm)

    # ---- the machine ----

    def wire(self, name: str) -> float:
        """Returns the level of a wire; see :class:`Wires`."""
        return self._operated().wire(name)

    def set_wire(self, name: str, value: float | None) -> None:
        """Forces a wire; None releases it. See :class:`Wires`."""
        self._operated().set_wire(name, value)

    def fault(self, target: str, fault: str, value: float | None = None) -> None:
        """Injects a fault at this instant, or repairs it; see :meth:`Rack.fault`."""
        self._operated().fault(fault if value is None else f"{fault}={value:.17g}", target)

    def __repr__(self) -> str:
        if self._core is None:
            return "<machine, closed>"
        status = self.status
        return f"<machine: {status.state}; {status.seconds:.9g} s>"
