"""What goes wrong, by name. All of them are :class:`Error`; each sentence says what was seen, the limit,
and what was (not) done.

    InvalidInput      a rack file, a part program or a name is wrong; nothing was done
    Refused       well formed, but outside a limit or at the wrong time; nothing was done
    MachineFault  the machine stopped: a limit switch, an alarm, the emergency stop, a card that does not answer
    Timeout       what was waited for did not come in time
    FileError   a file could not be read or written
    Stopped       the run was ended by its user; what was recorded is kept

Ctrl-C is a KeyboardInterrupt, as everywhere in Python: what moves is brought to rest first.
"""

from __future__ import annotations


class Error(Exception):
    """Something of motionrack went wrong.

    ``message`` is the sentence; ``file``, ``line``, ``column`` say where in a text (line and column count from 1, 0:
    nowhere). ``problems`` has every problem of a rack file or a program, in the order of their lines,
    where there can be several.
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
    """A mapping (cards, parts, wires, signals of a trace) has nothing of that name;
    the sentence has the names that there are."""

    def __str__(self) -> str:
        return str(self.args[0])


class Refused(Error):
    """Well formed, but outside a limit or at the wrong time; nothing was done."""


class MachineFault(Error):
    """The machine stopped or did not do what it was told."""


class Timeout(Error, TimeoutError):
    """What was waited for did not come in time; the rack stands where the time ended."""


class FileError(Error):
    """A file could not be read or written."""


class Stopped(Error):
    """The run was ended by its user."""
