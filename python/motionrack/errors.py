"""Exceptions of the package, all subclasses of :class:`Error`; each sentence has the value, the limit and the effect.

    InvalidInput      a rack file, a part program or a name is wrong; nothing was done
    Refused       well formed, but outside a limit or at the wrong time; nothing was done
    MachineFault  the machine stopped: a limit switch, an alarm, the emergency stop, a card that does not answer
    Timeout       a wait timed out
    FileError   a file could not be read or written
    Stopped       the run was ended by its user; the recording is kept

Ctrl-C raises KeyboardInterrupt, as everywhere in Python, after the moving axes have stopped.
"""

from __future__ import annotations


class Error(Exception):
    """An error of motionrack.

    ``message`` is the sentence; ``file``, ``line``, ``column`` are its location in a text (line and column count from
    1, 0: nowhere). ``problems`` has every problem of a rack file or a program, in the order of their lines.
    """

    def __init__(self, message: str = "", file: str = "", line: int = 0, column: int = 0) -> None:
        place = file
        if line > 0:
            place += f":{line}" if place else str(line)
            if column > 0:
                place += f":{column}"
        super().__init__(f"{place}: {message}" if place else message)
        self.message = message
        self.file = file
        self.line = line
        self.column = column
        self.problems: list[Error] = []


class InvalidInput(Error):
    """A rack file, a part program or a name is wrong; nothing was done."""


class NoSuchName(InvalidInput, KeyError):
    """A mapping (cards, parts, wires, signals of a trace) does not have that name; the sentence lists all names."""

    def __str__(self) -> str:
        return str(self.args[0])


class Refused(Error):
    """Well formed, but outside a limit or at the wrong time; nothing was done."""


class MachineFault(Error):
    """The machine stopped, or did not execute a command."""


class Timeout(Error, TimeoutError):
    """A wait timed out; the rack is at the end of that time."""


class FileError(Error):
    """A file could not be read or written."""


class Stopped(Error):
    """The run was ended by its user."""
