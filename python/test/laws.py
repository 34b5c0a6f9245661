"""Checks the laws of sessions in every rack and machine that a test opens: python -m laws TESTS... runs these tests.

Counters change with pulses, nothing moves after a program or homing, nor in an error stop, a program keeps
the velocity limits, and time advances as requested. A violation raises an AssertionError in the call that detects it.
tests/invariants/session_laws.hpp has the same laws for C programs.
"""

from __future__ import annotations

import functools
import unittest
import weakref
from collections.abc import Callable
from typing import Any

from motionrack import _core

LOOK_BEHIND = 1_000_000_000  # ticks, 0.1 s: motion that continues after a program is visible within this time
MIN_SECONDS = 0.01  # minimum interval of a mean velocity
STANDS_WITHIN = 0.05  # mm or deg: a servo that holds its position oscillates

checks: list[str] = []  #: names of the checks made so far


class Picture:
    """State of a rack at one instant, read by its own queries."""

    def __init__(self, world: _core.RackHandle) -> None:
        self.channels: dict[str, tuple[str, str, float]] = world.config()["channels"]
        self.ticks = world.ticks()
        self.pulses = {axis: round(world.quantity(f"{axis}.pulses")) for axis in self.channels}
        self.counters = {axis: _core.peek(world, card, name) for axis, (card, name, _) in self.channels.items()}


def check_counters(before: Picture, now: Picture) -> None:
    """Asserts that counters, which have 32 bits, changed by the pulses sent between the two states."""
    for axis, sent in sent_between(before, now).items():
        counted = now.counters[axis] - before.counters[axis]
        assert (sent - counted) % 2**32 == 0, f"axis {axis} was sent {sent} pulses and its counter went by {counted}"


def check_rest(before: Picture, now: Picture) -> None:
    """Asserts that nothing moved between two states without a command between them."""
    for axis, sent in sent_between(before, now).items():
        assert sent == 0, f"axis {axis} was sent {sent} pulses without an order"


def check_velocities(before: Picture, now: Picture) -> None:
    """Asserts that the mean velocities between the two states, rounded to whole pulses, are within their limits."""
    seconds = (now.ticks - before.ticks) * 1e-10
    for axis, sent in sent_between(before, now).items():
        limit = now.channels[axis][2]
        assert abs(sent) <= limit * 1.01 * seconds + 2, f"axis {axis} made {abs(sent) / seconds} pulses/s, not {limit}"


def check_error_stop(before: dict[str, Any], now: dict[str, Any]) -> None:
    """Asserts that a machine without a command between two statuses stays in an error stop and does not move."""
    assert now["ticks"] >= before["ticks"], f"time went back from {before['ticks']} to {now['ticks']}"
    if before["state"] != "error stop":
        return
    assert now["state"] == "error stop", f"the error stop ended without a reset: {now['state']}"
    for letter, axis in now["axes"].items():
        moved = axis["true_position"] - before["axes"][letter]["true_position"]
        assert abs(moved) <= STANDS_WITHIN, f"axis {letter} moved by {moved} in an error stop"


def sent_between(before: Picture, now: Picture) -> dict[str, int]:
    """Returns the pulses sent to each axis between two states."""
    return {axis: now.pulses[axis] - before.pulses[axis] for axis in now.channels}


def put(owner: Any, name: str, call: Callable[..., Any]) -> None:
    """Replaces a function by another with the same documentation."""
    setattr(owner, name, functools.wraps(getattr(owner, name))(call))


def install_on_racks() -> None:
    """Replaces the calls of a rack that advance time by calls that check the laws."""
    pass_time: Callable[[_core.RackHandle, int], None] = _core.RackHandle.advance
    run: Callable[..., Any] = _core.run
    home: Callable[..., Any] = _core.home

    def advance(world: _core.RackHandle, ticks: int) -> None:
        before = Picture(world) if world.started() else None
        pass_time(world, ticks)
        now = Picture(world)
        if before is not None:
            checks.append("advance")
            assert now.ticks - before.ticks == ticks, f"{ticks} ticks were to pass, {now.ticks - before.ticks} did"
            check_counters(before, now)

    def check_end(world: _core.RackHandle) -> None:
        later = world.copy()
        before = Picture(later)
        pass_time(later, LOOK_BEHIND)
        check_rest(before, Picture(later))
        checks.append("end")

    def run_program(world: _core.RackHandle, program: Any, *more: Any) -> Any:
        *options, progress = more
        last: list[Picture] = []

        def look(seconds: float, line: int, lines: int) -> Any:
            now = Picture(world)
            if not last or now.ticks - last[0].ticks >= MIN_SECONDS * 1e10:
                for before in last:
                    check_velocities(before, now)
                last[:] = [now]
            return progress(seconds, line, lines) if progress is not None else None

        ran = run(world, program, *options, look)
        check_end(world)
        return ran

    def home_axes(world: _core.RackHandle, *more: Any) -> Any:
        homed = home(world, *more)
        check_end(world)
        return homed

    put(_core.RackHandle, "advance", advance)
    put(_core, "run", run_program)
    put(_core, "home", home_axes)


def install_on_machines() -> None:
    """Replaces the calls of a machine that advance time or reset it by calls that check the laws."""
    operate, end_stop = _core.SteppedMachine.advance, _core.SteppedMachine.reset
    reset: weakref.WeakSet[_core.SteppedMachine] = weakref.WeakSet()  # machines reset since their time last advanced

    def step(machine: _core.SteppedMachine, ticks: int) -> None:
        before = machine.status()
        operate(machine, ticks)
        checks.append("machine")
        if machine not in reset:
            check_error_stop(before, machine.status())
        reset.discard(machine)

    def release(machine: _core.SteppedMachine) -> None:
        reset.add(machine)
        end_stop(machine)

    put(_core.SteppedMachine, "advance", step)
    put(_core.SteppedMachine, "reset", release)


if __name__ == "__main__":
    install_on_racks()
    install_on_machines()
    unittest.main(module=None)
