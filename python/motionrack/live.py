"""A real card of this computer, behind a live port.

    with motionrack.LiveCard("port:/dev/port,offset=0x300,width=8") as card:
        card.library.RESET()
        card.library.SetRange(800000)
        card.library.TCurve_F(1, 100, 2000, 400, 2000)
        card.library.wait(1, 10000)
        print(card.library.ReadLPS(1), card.RR0.read().DRV)

    with motionrack.LiveCard("port:/dev/port,offset=0x300,gap_ns=1000", "databoard4002", select=13) as card:
        card.driver.connect()
        card.driver.move_to(1000)
        print(card.driver.position(), card.STAT.read().READY)

The axes are at standstill after the block, also after an exception. docs/howto/live-port.md has the preparations.
"""

from __future__ import annotations

import atexit
import contextlib
import weakref
from types import TracebackType
from typing import Any

from . import _core
from .errors import InvalidInput, Error, Stopped, Timeout
from .registers import MappedCard, Register

ExceptionKind = type[BaseException]  # in LiveCard, the property `type` hides Python's `type`
_open: weakref.WeakSet[LiveCard] = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    for card in list(_open):
        with contextlib.suppress(Error):
            card.close()


class LiveCard(MappedCard):
    """A real card: its registers are attributes by the names of its map, case does not matter; ``library`` has the
    functions of an MCX314's source, ``driver`` the same library as virtual cards.

    Ctrl-C, an exception in a ``with`` block, its end, :meth:`close` and :meth:`quick_stop` stop all axes: an MCX314 at
    once and without a ramp, a DataBoard 4002 by its command Q. Ctrl-C acts while a call waits, in Python's main
    thread. A stop stays active: until :meth:`reset_stop` nothing is written, and calls raise Stopped. If the program
    ends in another way (a signal other than Ctrl-C, loss of power), the axes continue to drive: limit switches and
    emergency stop must be wired to the card, not depend on the program.

    One thread at a time may call it, the others are Refused; only :meth:`quick_stop` may be called from any thread.
    While it is open, no other port can be opened on its registers, by this or another program with motionrack.
    """

    _port: _core.LivePort
    _driver: _core.Mcx314 | _core.Databoard4002 | None
    _library: _core.Mcx314Library | None
    _place: str

    def __init__(self, place: str, type: str = "mcx314", *, select: int = 13) -> None:
        """Opens the card at ``place`` without writing to it or resetting it. Reads the status of an MCX314.

        ``place``: ``"uio:/dev/uio0"``, ``"memory:PATH"`` (a file that can be mapped: a PCI memory region),
        ``"port:PATH"`` (a file with two bytes an access: a PCI I/O region, ``/dev/port``), then ``,offset=N`` bytes
        (0 to 2**40), ``,stride=N`` bytes (1 to 4096), ``,width=8``, ``,map=N`` (0 to 4), ``,interrupt=PATH``,
        ``,gap_ns=N`` (0 to 10**9). ``type``: ``"mcx314"`` or ``"databoard4002"``; other cards have no map that a real
        one has. ``select``: number of a DataBoard 4002 on its bus, 0 to 255.

        InvalidInput: wrong place or type. FileError: not found, no permission, too short. Refused: already open, or the
        required accesses are not possible. On an error nothing is opened.
        """
        port = _core.LivePort(place, type, select)
        super().__init__(port.map(), _port=port, _driver=None, _library=None, _place=place)
        _open.add(self)

    # ---- the card ----

    @property
    def place(self) -> str:
        """The address with which it was opened."""
        return self._place

    @property
    def type(self) -> str:
        """``"mcx314"`` or ``"databoard4002"``."""
        return str(self._map["name"])

    @property
    def seconds(self) -> float:
        """Real time since it was opened, s. Refused after it was closed."""
        return self._port.now()

    # ---- its function library ----

    @property
    def library(self) -> _core.Mcx314Library:
        """The functions of the MCX314's source under their names, each with the arguments, ranges and sentences of its
        declaration. Assumes the state after ``RESET()``. Refused if ``driver`` is in use, for a card of another type,
        and after the card was closed."""
        if self._library is None:
            object.__setattr__(self, "_library", _core.Mcx314Library.of_live_port(self._port))
        assert self._library is not None
        return self._library

    @property
    def driver(self) -> Any:
        """The same library as :attr:`Card.driver` of virtual cards, with times in s: after ``initialise()`` of an
        MCX314, or ``connect()`` of a DataBoard 4002, a program is the same for both. Refused if ``library`` is in use,
        and after the card was closed."""
        if self._driver is None:
            made = (
                _core.Mcx314.of_live_port(self._port)
                if self.type == "mcx314"
                else _core.Databoard4002.of_live_port(self._port)
            )
            object.__setattr__(self, "_driver", made)
        assert self._driver is not None
        return self._driver

    # ---- stops ----

    def quick_stop(self) -> None:
        """Stops all axes: an MCX314 ends its pulses at once and without a ramp, a DataBoard 4002 receives Q. A running
        call of another thread raises Stopped. Callable from any thread, in every state. The stop stays active until
        :meth:`reset_stop`. FileError if the computer refuses the write, MachineFault if the card does not accept Q."""
        self._port.quick_stop()

    def reset_stop(self) -> None:
        """Releases a stop. No axis moves; stopped drives do not resume."""
        self._port.reset_stop()

    @property
    def stopped(self) -> bool:
        """True while a stop is active."""
        return self._port.stopped()

    def close(self) -> None:
        """Stops all axes and closes the card; a second call has no effect. Refused inside a call of this thread.
        FileError or MachineFault if the stop could not be written; the card is closed nevertheless.
        """
        self._port.close()
        _open.discard(self)

    @property
    def closed(self) -> bool:
        """True once the card was closed."""
        return self._port.closed()

    def __enter__(self) -> LiveCard:
        return self

    def __exit__(self, kind: ExceptionKind | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    # ---- peeking, reading, writing ----

    def read(self, offset: int, bits: int = 16) -> int:
        """Makes one read access with all side effects. ``offset``: in the card's map, of a readable register; ``bits``:
        16, or 8 at the ports of a DataBoard 4002. Allowed during a stop. InvalidInput, FileError.
        """
        self._check_bits(bits)
        return self._port.read(offset)

    def write(self, offset: int, value: int, bits: int = 16) -> None:
        """Makes one write access with all side effects to a writable register; ``value`` 0 to 2**bits - 1. Library and
        driver do not take account of the change. InvalidInput, Refused, Stopped, FileError.
        """
        self._check_bits(bits)
        self._port.write(offset, value)

    def peek(self, name: str) -> int:
        """Always InvalidInput: a real card cannot be read without an access."""
        raise InvalidInput(
            f"Register {name} of a real card cannot be looked at without an access. Nothing was read. Use read()."
        )

    def view(self, clearing: bool = False) -> str:
        """Returns its registers as decoded text; allowed during a stop. For an MCX314 it writes NOP and read commands
        to WR0, which move nothing; ``clearing``: also RR3, which reading clears. A DataBoard 4002 is selected and
        receives the commands P and R. FileError, MachineFault."""
        return self._port.view(clearing)

    def wait_interrupt(self, timeout: float) -> None:
        """Waits for its interrupt; Timeout after ``timeout`` s (0 to 9e8, or infinite). Stopped; Refused
        without ``interrupt=`` in the address (a UIO node needs none)."""
        if not self._port.wait_interrupt(timeout):
            if self.stopped:
                raise Stopped(f"The card at {self._place} was stopped while it was waited for its interrupt.")
            raise Timeout(f"The card at {self._place}: timed out after {timeout:g} s: no interrupt.")

    def _check_bits(self, bits: int) -> None:
        width = int(self._map["registers"][0]["width"])
        if bits != width:
            raise InvalidInput(f"The registers of a real {self.type} have {width} bits, not {bits}. Nothing was done.")

    # ---- names as attributes ----

    def __getattr__(self, name: str) -> Register:
        if name.startswith("_"):
            raise AttributeError(name)
        reg = self._registers.get(name.lower())
        if reg is None:
            raise AttributeError(f"{self._subject()} has no register {name}.")
        return Register(self, reg)

    def _subject(self) -> str:
        return f"The {self.type}"

    def __repr__(self) -> str:
        state = "closed" if self.closed else "stopped" if self.stopped else "open"
        return f"<real {self.type} at {self._place}: {state}>"
