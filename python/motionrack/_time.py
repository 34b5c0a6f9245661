"""Converts seconds to whole ticks of 100 ps and back."""

from __future__ import annotations

import math

from .errors import Refused

TICKS_PER_SECOND = 10_000_000_000


def ticks_of(seconds: float = 0.0, ms: float = 0, us: float = 0, ns: float = 0) -> int:
    """Returns the sum of the times in ticks of 100 ps, rounded; whole numbers of s, ms, us and ns are exact."""
    total = 0
    for value, size in ((seconds, TICKS_PER_SECOND), (ms, 10_000_000), (us, 10_000), (ns, 10)):
        if isinstance(value, int):
            total += value * size
            continue
        if not math.isfinite(value):
            raise Refused(f"A time is {value}; it must be a finite number. Nothing was done.")
        total += math.floor(value * size + 0.5)
    if abs(total) > 9_000_000_000_000_000_000:
        raise Refused(f"A time is {total / TICKS_PER_SECOND:.0f} s; it must be at most 900000000 s. Nothing was done.")
    return total


def seconds_of(ticks: int) -> float:
    """Converts ticks of 100 ps to s."""
    return ticks / TICKS_PER_SECOND
