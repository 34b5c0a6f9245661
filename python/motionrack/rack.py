"""A rack: cards, their wires and the connected machine, in virtual time."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from types import TracebackType

from . import _core
from ._time import seconds_of, ticks_of
from .cards import Cards
from .condition import Condition
from .errors import InvalidInput, FileError, Refused, Timeout
from .outcome import Homing, Outcome, homing_of, outcome_of
from .parts import Parts, Wires
from .recording import Recording, Waves

Progress = Callable[[float, int, int], None]


class Rack:
    """A rack of cards. Its time is virtual: it advances only in bus accesses to a card and in the calls that say so.

    One thread at a time may use a rack; the others are Refused. Python's other threads continue while a rack runs. The
    same calls give the same event trace, bit for bit. As a context manager it is closed at the end of the block.
    """

    def __init__(self, world: _core.RackHandle, warnings: Iterable[str] = ()) -> None:
        if not isinstance(world, _core.RackHandle):
            raise TypeError(
                f"A Rack is not created by Rack({world!r}). Use Rack.from_file(path), Rack.from_text(text) or"
                " Rack.template(name)."
            )
        self._world = world
        self.warnings = list(warnings)  #: of the rack file, a sentence each
        self.cards = Cards(world)  #: by their names
        self.parts = Parts(world)  #: axes, stages, belts, tables, scan heads by their names
        self.wires = Wires(world)  #: by their names
        self._name = str(world.config()["name"])

    # ---- making one ----

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Rack:
        """Opens a rack file. InvalidInput with ``problems``, each with its line and column; FileError."""
        return cls(*_core.open_file(os.fspath(path)))

    @classmethod
    def from_text(cls, text: str, name: str = "") -> Rack:
        """Opens a rack from the text of a rack file; ``name`` is its name in errors. ``'card.c1 = "mcx314"'`` is a
        complete rack. InvalidInput."""
        return cls(*_core.open_text(text, name))

    @classmethod
    def template(cls, name: str = "router") -> Rack:
        """Opens a rack from a template: one of :func:`motionrack.templates`. InvalidInput."""
        return cls(*_core.open_text(_core.template_text(name), ""))

    def new_instance(self) -> Rack:
        """Returns another rack of the same file, at time 0."""
        return Rack(self._world.new_instance(), self.warnings)

    def change_card(self, name: str, **settings: float) -> None:
        """Changes settings of a card before the rack's time begins, in the units of their keys in a rack file:
        ``change_card("host", period_us=250)``.

        Each value is checked against its range, and the card alone must be valid. Unlike in a rack file, consistency
        with other cards is not checked, which allows experiments that a rack file rejects. InvalidInput, Refused.
        """
        for key, value in settings.items():
            self._world.set_card(name, key, float(value))

    def close(self) -> None:
        """Ends the rack and frees it; a running recording ends. All its calls are Refused afterwards. FileError if the
        recording's file could not be completed; the rack is closed in any case."""
        if not self._world.closed():
            self._world.close()

    def __enter__(self) -> Rack:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def name(self) -> str:
        """The rack's name in its file."""
        return self._name

    @property
    def axes(self) -> dict[str, str]:
        """Its axes with their units, ``{"X": "mm", "A": "deg"}``."""
        return dict(self._world.config()["axes"])

    def __repr__(self) -> str:
        if self._world.closed():
            return f"<rack {self.name!r}, closed>"
        return f"<rack {self.name!r}: {', '.join(self.cards) or 'no cards'}; {self.time:.9g} s>"

    # ---- time ----

    @property
    def time(self) -> float:
        """Virtual time since the start, s."""
        return seconds_of(self._world.ticks())

    @property
    def ticks(self) -> int:
        """Virtual time since the start, whole ticks of 100 ps."""
        return self._world.ticks()

    def advance(self, seconds: float = 0.0, *, ms: float = 0, us: float = 0, ns: float = 0) -> None:
        """Advances the rack by the sum of the given times, 0 to 14 years in total; whole numbers are exact to the
        tick of 100 ps. Refused beyond that."""
        self._world.advance(ticks_of(seconds, ms, us, ns))

    def wait(self, condition: Callable[[], object], timeout: float, poll: float = 1e-3) -> None:
        """Runs until ``condition()`` is true, which is checked now and every ``poll`` s (> 0);
        Timeout after ``timeout`` s."""
        step, end = ticks_of(poll), self.ticks + ticks_of(timeout)
        if step <= 0:
            raise Refused(f"poll is {poll} s; it must be more than 0. Nothing was run.")
        while not condition():
            if self.ticks >= end:
                raise Timeout(f"The wait timed out after {timeout:g} s; the rack is at {self.time:.9g} s.")
            self._world.advance(min(step, end - self.ticks))

    def wait_wire(self, name: str, level: int, timeout: float) -> None:
        """Runs until a digital wire has that level, and stops at that instant; Timeout after ``timeout`` s.
        InvalidInput.

        The wait also drives pins that a card drives only on demand, such as pulse outputs;
        the event trace then contains them.
        """
        if level not in (0, 1):
            raise Refused(f"The level of {name} is {level}; it must be 0 or 1. Nothing was run.")
        if not self._world.wait_wire(name, level, ticks_of(timeout)):
            raise Timeout(f"{name} did not reach {level} within {timeout:g} s; the rack is at {self.time:.9g} s.")

    # ---- looking ----

    def peek(self, name: str) -> int:
        """Returns a register or value of a card, ``"c1.x.LP"``, without side effects; takes no time. InvalidInput."""
        card, _, value = name.partition(".")
        return _core.peek(self._world, card, value)

    def get(self, name: str) -> float:
        """Returns a quantity of a part or card, ``"X.position_mm"``, ``"c1.fout_hz"``; the name ends in its unit.
        InvalidInput."""
        return self._world.quantity(name)

    def set(self, name: str, value: float) -> None:
        """Moves a part by hand: sets ``position_mm`` (``position_deg``) or ``position_pulses``;
        for a belt or table ``speed_mm_s`` (``speed_deg_s``).

        A motor in step moves to the nearest position of the same electrical phase: read the quantity for the result.
        InvalidInput, Refused.
        """
        self._world.set_quantity(name, float(value))

    @property
    def conditions(self) -> list[Condition]:
        """Conditions of the machine and cards so far (a lost step, a command ignored), oldest first: the last 4096."""
        return [
            Condition(number, seconds_of(ticks), source, code, text)
            for number, ticks, source, code, text in self._world.conditions()
        ]

    def bus_conflicts(self) -> int:
        """Returns the number of conflicts so far of two cards on a line of the grating bus.
        Refused without a grating bus."""
        return _core.bus_conflicts(self._world)

    def frame_picture(self, frame: int = 1) -> str:
        """Returns frame number ``frame`` (from 1) of the grating bus as waves (SVG), from a separate run of this rack.
        Refused without a grating bus."""
        return _core.frame_picture(self._world, frame)

    def trace_hash(self) -> str:
        """Returns the hash of the event trace so far, 16 digits: all wire changes and conditions with their ticks.
        See :meth:`Trace.hash`."""
        return self._world.trace_hash()

    def state_hash(self) -> str:
        """Returns the hash of the rack's state, 16 digits; equal states have equal hashes."""
        return self._world.state_hash()

    # ---- faults ----

    @property
    def faults(self) -> dict[str, list[str]]:
        """The faults that can be injected, by target."""
        return dict(self._world.fault_targets())

    def fault(self, target: str, fault: str, value: float | None = None) -> None:
        """Injects a fault at this instant, or repairs it: ``fault("X", "encoder.broken_a")``, ``fault("X",
        "motor.lose_steps", 64)``.

        The default value is 1; 0 repairs a repairable fault. InvalidInput (unknown name), Refused (the target has no
        such part, value out of range).
        """
        self._world.fault(fault if value is None else f"{fault}={value:.17g}", target)

    def plan_fault(self, text: str, value: float | str | None = None, *, at: float | None = None) -> None:
        """Schedules a fault before the rack's time begins, in the syntax of the command line:
        ``"X.limit_plus=0@0.5s"``, ``"X.encoder.broken_a@1s"``.

        Or by parts: ``plan_fault("X.limit_plus", 0, at=0.5)`` with ``at`` in s (0 to 1e6).
        A wire takes 0, 1 or ``"release"``.
        """
        if at is not None:
            shown = "" if value is None else f"={value if isinstance(value, str) else format(value, '.17g')}"
            text = f"{text}{shown}@{float(at)!r}s"
        self._world.plan_faults([text])

    # ---- the controller ----

    def run(
        self,
        program: str | None = None,
        *,
        path: str | os.PathLike[str] | None = None,
        profile: str | None = None,
        faults: Iterable[str] = (),
        block_delete: bool = False,
        sample_period: float = 1e-3,
        progress: Progress | None = None,
        name: str | None = None,
        tools: str | os.PathLike[str] | None = None,
    ) -> Outcome:
        """Runs a part program to standstill: its text, or the file at ``path``, beside which its subprograms lie.
        It starts at the controller's position of the axes: the initial position of the rack file or that of the last
        :meth:`home`, plus all pulses sent since, by any command. G-code modes are reset.

        ``tools``: path of a tool table (LinuxCNC's ``.tbl``) with the lengths for G43 and the diameters for G41, G42.
        ``profile``: ``"trapezoid"`` or ``"jerk_limited"`` instead of the rack file's. ``faults``: see
        :meth:`plan_fault`. ``sample_period``: of the outcome's trace, s (1e-6 to 3600). ``progress(seconds, line,
        lines)`` is called about every 50 ms of virtual time; it may read the rack, but not move it.

        InvalidInput with all ``problems``, each with line and column, if anything in the program is wrong: nothing
        moved.
        Refused on a rack without axes, while an axis moves, and after an earlier program or :meth:`home` has
        invalidated the position of an axis, until this axis is homed. A fault of the machine is the outcome's
        ``error``.
        """
        given, name = _program(program, path, name, tools, block_delete)
        ran = _core.run(self._world, given, ticks_of(sample_period), profile, list(faults), progress)
        return outcome_of(self._world, ran, name or self.name)

    def check(
        self,
        program: str | None = None,
        *,
        path: str | os.PathLike[str] | None = None,
        block_delete: bool = False,
        name: str | None = None,
        tools: str | os.PathLike[str] | None = None,
    ) -> None:
        """Checks a part program for this rack and raises its errors, with all ``problems``;
        moves nothing and takes no time. See :meth:`run`."""
        _core.check(self._world, _program(program, path, name, tools, block_delete)[0])

    def home(self, axes: str = "", *, type: int | None = None, timeout: float = 3600.0) -> Homing:
        """Homes axes: ``"XY"``; ``""``: every axis with a home switch. ``type``: homing method 1 to 4 instead of the
        rack file's; ``timeout`` in s of each group, 0 to 9e8; Refused beyond that. A failure is the
        outcome's ``error``."""
        return homing_of(*_core.home(self._world, axes, type, ticks_of(timeout)))

    # ---- recordings ----

    def record(self, *signals: str, period: float = 1e-3, max_samples: int = 1_000_000) -> Recording:
        """Starts to sample wires (``"c1.xdrive"``), values of cards (``"c1.x.LP"``) and quantities
        (``"X.position_mm"``) every ``period`` s (1e-6 to 3600).

            with rack.record("X.position_mm", "c1.x.LP") as recording:
                rack.advance(1)
            recording.trace.plot()

        Beyond ``max_samples`` instants, every second one is dropped and the period doubled; the end is kept.
        One recording at a time. InvalidInput, Refused.
        """
        return Recording(self._world, signals, ticks_of(period), max_samples, self.name)

    def waves(self, path: str | os.PathLike[str], *signals: str) -> Waves:
        """Starts to write waves of wires, pulses and counters to a file that ends in ``.vcd``, ``.csv``
        or ``.h5``, until :meth:`Waves.stop` or the end of the block.

        ``signals``: patterns with * and ?; default: all except pins that cards drive on demand.
        Refused, InvalidInput, FileError.
        """
        return Waves(self._world, os.fspath(path), signals)

    # ---- the whole rack ----

    def copy(self) -> Rack:
        """Returns an independent rack in the same state: the same calls have the same results in both.
        Recordings stay with this rack."""
        return Rack(self._world.copy(), self.warnings)

    def snapshot(self) -> Snapshot:
        """Returns the state of the whole rack, for :meth:`restore`. The state of function libraries belongs to the host
        and is not included."""
        return Snapshot(self._world.copy())

    def restore(self, snapshot: Snapshot) -> None:
        """Restores a state of this rack or of another one of the same file, including its time.
        Refused while a recording runs."""
        if snapshot._world.config() != self._world.config():
            raise Refused("The snapshot is of a rack of another kind; nothing was done.")
        self._world.copy_from(snapshot._world)


def _text_of(path: str | os.PathLike[str]) -> str:
    try:
        with open(path, encoding="utf-8", errors="replace", newline="") as file:  # comments may have any encoding
            return file.read()
    except OSError as error:
        raise FileError(f"{os.fspath(path)} cannot be read: {error.strerror}. Nothing was moved.") from None


def _program(
    program: str | None,
    path: str | os.PathLike[str] | None,
    name: str | None,
    tools: str | os.PathLike[str] | None,
    block_delete: bool,
) -> tuple[_core.Program, str]:
    """Returns a program with its files, and its name in messages."""
    if (program is None) == (path is None):
        raise InvalidInput("A program is given as text or by its path, one of the two. Nothing was moved.")
    folder = "" if path is None else os.path.dirname(os.fspath(path)) or "."
    text = program if path is None else _text_of(path)
    name = name if name is not None else "" if path is None else os.fspath(path)
    table, table_name = ("", "") if tools is None else (_text_of(tools), os.fspath(tools))
    return _core.Program(text or "", name, folder, table, table_name, block_delete), name


class Snapshot:
    """The state of a whole rack at an instant."""

    def __init__(self, world: _core.RackHandle) -> None:
        self._world = world

    @property
    def time(self) -> float:
        """Instant of the snapshot, s since the rack's start."""
        return seconds_of(self._world.ticks())

    def hash(self) -> str:
        """Returns the hash of the state, 16 digits; equal states have equal hashes."""
        return self._world.state_hash()

    def __repr__(self) -> str:
        return f"<snapshot at {self.time:.9g} s>"
