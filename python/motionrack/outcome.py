"""Results of a part program, and of homing."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from . import _core
from ._time import seconds_of
from .errors import Error
from .trace import Trace, Values


@dataclass(frozen=True)
class AxisOutcome:
    """Result of one axis. Positions in ``unit`` (mm or deg), velocities per s, accelerations per s2."""

    axis: str
    unit: str
    servo: bool  #: true for a servo: it receives no pulses; its pulse numbers are encoder counts
    min_position: float
    max_position: float
    max_velocity: float
    max_accel: float
    pulses_sent: int  #: of both directions
    pulses_net: int  #: forward less backward
    pulse_position: int  #: the card's counter LP at the end
    pulse_start: int  #: counter LP at the start of the program
    encoder_counts: int  #: change of the card's encoder counter EP
    expected_counts: int  #: expected change, if every pulse had moved the motor
    lost_pulses: int  #: pulses that the motor did not follow
    planned_end: float
    actual_end: float  #: true position, by the last homing
    peak_velocity: float
    peak_accel: float  #: over 4 samples without a velocity step
    peak_velocity_step: float  #: largest change of velocity at once


@dataclass(frozen=True)
class ExecutedMove:
    """An executed move: length in mm (deg), velocities per s, start and end in s since the rack's start."""

    move: int
    line: int
    kind: str  #: rapid, feed, arc or dwell
    length: float
    entry_velocity: float
    cruise_velocity: float
    exit_velocity: float
    start: float
    end: float
    deviation_mm: float  #: maximum deviation in it


@dataclass(frozen=True)
class Warning:
    """A condition as a sentence, at an instant (s since the rack's start); line 0: none."""

    seconds: float
    line: int
    text: str


@dataclass(frozen=True)
class MaxDeviation:
    """The point of the largest distance from the programmed path."""

    mm: float
    seconds: float  #: since the rack's start
    line: int
    position: tuple[float, float, float]  #: true position, mm


@dataclass(frozen=True)
class ProgramEvent:
    """A spindle, tool or message word, with the move executed before it (-1: none)."""

    line: int
    after_move: int
    text: str


@dataclass(frozen=True)
class Outcome:
    """Result of a part program. ``ok``: it ended as programmed without lost steps; else ``error`` has the reason."""

    ok: bool
    error: Error | None
    duration_s: float  #: virtual time of the job
    ticks: int  #: virtual time of the job in ticks of 100 ps
    planned_duration_s: float
    path_mm: float  #: planned path of X, Y, Z
    moves: int  #: planned
    dwells: int
    stops: int  #: moves that end at standstill
    peak_path_velocity: float  #: mm/s, planned
    lines: int  #: read
    moves_read: int  #: moves of the program, without dwells
    program_ended: bool  #: by M2 or M30
    axes: Mapping[str, AxisOutcome]
    max_deviation: MaxDeviation
    tolerance_mm: float  #: maximum deviation that the program allows
    warnings: list[Warning]
    faults_not_done: list[str]  #: planned faults that were not injected: the run ended before, or the part refused them
    program_events: list[ProgramEvent]
    program_events_left_out: int
    executed_moves: list[ExecutedMove]
    executed_moves_left_out: int
    chip_segments: int  #: commands to the card
    events: int  #: events of the kernel during the run
    trace_hash: str  #: of the event trace, 16 digits; see Trace.hash
    rest_axis: str | None  #: servo axis with the largest position error
    rest_off: float  #: position error of that axis, mm or deg
    position_valid: bool  #: False once steps were lost
    trace: Trace = field(repr=False)
    _ran: Any = field(repr=False, compare=False)

    def check(self) -> Outcome:
        """Raises ``error`` if there is one; else returns the outcome itself."""
        if self.error is not None:
            raise self.error
        return self

    def summary(self) -> str:
        """Returns the summary of ``motionrack run``."""
        return str(self._ran.summary())

    def json(self) -> str:
        """Returns the output of ``motionrack run --json``."""
        return str(self._ran.json())

    def svg(self, perspective: bool = False) -> str:
        """Returns a picture of the programmed and the executed path, from above or in perspective (SVG). Refused after
        the rack was closed."""
        return str(self._ran.svg(perspective))

    def write_report(self, path: str) -> None:
        """Writes the report of ``motionrack run``: one HTML file. FileError."""
        self._ran.write_report(path)

    def write_csv(self, path: str) -> None:
        """Writes position, velocity and deviation of every sample as CSV. FileError."""
        self._ran.write_csv(path)

    def write_events(self, path: str) -> None:
        """Writes moves, warnings and the stop as CSV. FileError."""
        self._ran.write_events(path)

    def _repr_html_(self) -> str:
        return f"<pre>{self.summary()}</pre>{self.svg()}"

    def __str__(self) -> str:
        return self.summary().rstrip("\n")


def outcome_of(world: _core.RackHandle, ran: _core.Ran, title: str) -> Outcome:
    """Converts all data of a job from C++, adding names and units."""
    data = dict(ran.data())
    axes = {axis["axis"]: AxisOutcome(**axis) for axis in data.pop("axes")}
    error = ran.error()
    ticks, signals = ran.samples()
    trace = Trace(ticks, signals, job_units(signals, axes), data["trace_hash"], title)
    deviation = MaxDeviation(
        data.pop("max_deviation_mm"),
        seconds_of(data.pop("max_deviation_ticks")),
        data.pop("max_deviation_line"),
        data.pop("max_deviation_position"),
    )
    return Outcome(
        ok=error is None and data["position_valid"],
        error=error,
        duration_s=seconds_of(data["ticks"]),
        axes=axes,
        max_deviation=deviation,
        warnings=[Warning(seconds_of(at), line, text) for at, line, text in data.pop("warnings")],
        faults_not_done=world.not_done(),
        program_events=[ProgramEvent(*event) for event in data.pop("program_events")],
        executed_moves=[ExecutedMove(**move) for move in data.pop("executed_moves")],
        trace=trace,
        _ran=ran,
        **data,
    )


def job_units(signals: Mapping[str, Values], axes: Mapping[str, AxisOutcome]) -> dict[str, str]:
    """Returns the units of the samples of a job."""
    ends = {"position": "", "velocity": "/s", "accel": "/s2"}
    out = {"deviation": "mm"}
    for name in signals:
        axis, _, what = name.partition(".")
        if what:
            out[name] = "V" if what == "volts" else axes[axis].unit + ends[what]
    return out


@dataclass(frozen=True)
class Homing:
    """Result of homing. ``axes`` has the report of ``motionrack home --json`` for each axis:
    states, switch edges, positions (mm or deg), times (s)."""

    ok: bool
    error: Error | None
    duration_s: float
    axes: Mapping[str, dict[str, Any]]
    pictures: Mapping[str, str] = field(
        repr=False
    )  #: position, velocity and states over time, SVG, of each axis that started
    _text: str = field(repr=False)
    _json: str = field(repr=False)

    def check(self) -> Homing:
        """Raises ``error`` if there is one; else returns the outcome itself."""
        if self.error is not None:
            raise self.error
        return self

    def summary(self) -> str:
        """Returns the report of ``motionrack home``."""
        return self._text

    def json(self) -> str:
        """Returns the output of ``motionrack home --json``."""
        return self._json

    def __str__(self) -> str:
        return self._text.rstrip("\n")

    def _repr_html_(self) -> str:
        return f"<pre>{self._text}</pre>{''.join(self.pictures.values())}"


def homing_of(error: Error | None, text: str, as_json: str, pictures: dict[str, str]) -> Homing:
    """Converts a homing report from C++."""
    data = json.loads(as_json)
    return Homing(
        ok=bool(data["homed"]),
        error=error,
        duration_s=float(data["duration_s"]),
        axes={axis["axis"]: axis for axis in data["axes"]},
        pictures=pictures,
        _text=text,
        _json=as_json,
    )
