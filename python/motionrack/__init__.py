"""Racks of motion-control cards, in software.

    import motionrack

    rack = motionrack.Rack.template("router")
    outcome = rack.run("G21 G90\\nG1 X10 Y5 F600\\nM2\\n")
    outcome.axes["X"].actual_end      # mm
    outcome.trace.plot("x.velocity")   # NumPy arrays inside

Lengths are mm, angles degrees, times s of virtual time, unless a name or a docstring says otherwise. Every error is a
:class:`motionrack.Error` with a sentence.
"""

from __future__ import annotations

from . import _core
from ._core import Databoard4002, GratingCard, Ioflex02, Mcx314, Mcx314Library, Rtc5, SlopeTable, SpeedMeter, SpeedScale
from ._version import __version__
from .cards import Card, Cards, Channel
from .condition import Condition
from .errors import InvalidInput, Error, FileError, MachineFault, NoSuchName, Refused, Stopped, Timeout
from .live import LiveCard
from .machine import Alarm, AxisStatus, Machine, Status
from .outcome import AxisOutcome, ExecutedMove, Homing, MaxDeviation, Outcome, ProgramEvent, Warning
from .parts import Part, Parts, Wires
from .rack import Rack, Snapshot
from .recording import Recording, Waves
from .registers import Register, Word
from .trace import Trace


def templates() -> list[str]:
    """Returns the names of the templates for :meth:`Rack.template`; the first is the default."""
    return _core.template_names()


def template_text(name: str = "router") -> str:
    """Returns the rack file of a template: every key with its unit, range and default as a comment. InvalidInput."""
    return _core.template_text(name)


__all__ = [
    "Alarm",
    "AxisOutcome",
    "AxisStatus",
    "Card",
    "Cards",
    "Channel",
    "Condition",
    "Databoard4002",
    "Error",
    "ExecutedMove",
    "FileError",
    "GratingCard",
    "Homing",
    "InvalidInput",
    "Ioflex02",
    "LiveCard",
    "Machine",
    "MachineFault",
    "MaxDeviation",
    "Mcx314",
    "Mcx314Library",
    "NoSuchName",
    "Outcome",
    "Part",
    "Parts",
    "ProgramEvent",
    "Rack",
    "Recording",
    "Refused",
    "Register",
    "Rtc5",
    "SlopeTable",
    "Snapshot",
    "SpeedMeter",
    "SpeedScale",
    "Status",
    "Stopped",
    "Timeout",
    "Trace",
    "Warning",
    "Waves",
    "Wires",
    "Word",
    "__version__",
    "template_text",
    "templates",
]
