"""Cards of a rack: registers, fields, channels and values by the names of the card's map, and the function library.

    card = rack.cards["c1"]
    card.RR0.DRV             a field, read without side effects; takes no time
    card.RR3.read().DEND     a bus access with all its side effects
    card.WR0 = 0x0120        a bus access
    card.x.LP                a value or register of a channel
    card.driver.TCurve_F(1, 100, 2000, 200, 12000)
    card.library.TCurve_F(1, 100, 2000, 200, 12000)      as on a real card, see LiveCard
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from . import _core
from ._time import ticks_of
from .errors import InvalidInput, NoSuchName, Refused, Timeout
from .registers import MappedCard, Register


class Channel:
    """Values and registers of one channel: ``card.x.LP`` (a whole number), ``card.x.RR1`` (a register)."""

    __slots__ = ("_card", "_name")

    def __init__(self, card: Card, name: str) -> None:
        self._card = card
        self._name = name

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        reg = self._card._registers.get(name.lower())
        if reg is not None and reg["per_axis"]:
            return Register(self._card, reg, self._name)
        try:
            return self._card.peek(f"{self._name}.{name}")
        except InvalidInput as error:
            raise AttributeError(str(error)) from None

    def __dir__(self) -> list[str]:
        start = self._name + "."
        values = [value[len(start) :] for value in self._card._about["values"] if value.startswith(start)]
        return [*(reg["name"] for reg in self._card._map["registers"] if reg["per_axis"]), *values]

    def __repr__(self) -> str:
        return f"<channel {self._name} of {self._card.name}>"


class Card(MappedCard):
    """One card of a rack. Registers and channels are attributes, by the names of its map; case does not matter."""

    def __init__(self, world: _core.RackHandle, name: str) -> None:
        about = _core.describe_card(world, name)
        super().__init__(about["map"], _world=world, _name=name, _about=about, _driver=None, _library=None)

    _world: _core.RackHandle
    _name: str
    _about: dict[str, Any]
    _driver: Any
    _library: _core.Mcx314Library | None

    # ---- identity ----

    @property
    def name(self) -> str:
        """Its name in the rack file."""
        return self._name

    @property
    def type(self) -> str:
        """Its type, as the rack file names it: ``"mcx314"``."""
        return str(self._about["type"])

    @property
    def channels(self) -> dict[str, Channel]:
        """Its channels by their names: ``card.channels["x"]`` is ``card.x``;
        for cards with numbered channels ``card.channels["0"].POSITION``."""
        names = [
            *self._about["channels"],
            *(value.partition(".")[0] for value in self._about["values"] if "." in value),
        ]
        return {name: Channel(self, name) for name in dict.fromkeys(names)}

    @property
    def values(self) -> list[str]:
        """Names of ``peek`` other than registers: ``"x.LP"``."""
        return list(self._about["values"])

    @property
    def pins(self) -> dict[str, str]:
        """Its pins and their meanings; ``rack.wires["c1.xlmtp"]`` is the level of one."""
        return dict(self._about["pins"])

    # ---- peeking, reading, writing ----

    def peek(self, name: str) -> int:
        """Returns a register or value by its name (``"RR0"``, ``"x.LP"``), without side effects; takes no time.
        InvalidInput, with the known names."""
        return _core.peek(self._world, self._name, name)

    def read(self, offset: int, bits: int = 16) -> int:
        """Makes one bus access with all side effects: ``offset`` in bytes in the card's map, ``bits`` 8,
        16 or 32 according to the card's bus."""
        return _core.read(self._world, self._name, bits, int(self._about["base"]) + offset)

    def write(self, offset: int, value: int, bits: int = 16) -> None:
        """Makes one bus access with all side effects; ``value`` 0 to 2**bits - 1."""
        _core.write(self._world, self._name, bits, int(self._about["base"]) + offset, value)

    def view(self, clearing: bool = False) -> str:
        """Returns its registers as decoded text, read through the bus; ``clearing``: also RR3, which reading clears.
        Refused for cards without a view."""
        return _core.view(self._world, self._name, clearing)

    def wait_interrupt(self, timeout: float) -> None:
        """Waits until its interrupt line is active; Timeout after ``timeout`` s (0 to 9e8). Refused
        beyond that."""
        if not _core.wait_interrupt(self._world, self._name, ticks_of(timeout)):
            raise Timeout(f"Card {self._name}: timed out after {timeout:g} s: no interrupt.")

    def refused_frames(self) -> int:
        """Returns the number of frames that a motion card on a grating bus did not publish since the start. Refused for
        other cards."""
        return _core.refused_frames(self._world, self._name)

    # ---- its function library ----

    @property
    def driver(self) -> Any:
        """Its function library, an object of its type (Mcx314, Databoard4002, Ioflex02, GratingCard, Rtc5);
        created at first use, or by :meth:`open`."""
        if self._driver is None:
            self.open()
        return self._driver

    def open(self, **settings: Any) -> Any:
        """Creates the function library with settings: for a databoard4002 ``counts_per_mm`` (> 0) and ``select`` (0 to
        255)."""
        kinds: dict[str, Any] = {
            "mcx314": _core.Mcx314,
            "databoard4002": _core.Databoard4002,
            "ioflex02": _core.Ioflex02,
            "grating_bus": _core.GratingCard,
            "rtc5": _core.Rtc5,
        }
        kind = kinds.get(self.type)
        if kind is None:
            raise Refused(f"Card {self._name} is a {self.type}, which has no function library. Nothing was done.")
        driver = kind(self._world, self._name, **settings)
        object.__setattr__(self, "_driver", driver)
        return driver

    @property
    def library(self) -> _core.Mcx314Library:
        """The functions of an MCX314's source with their original arguments, checked as on a real card
        (:attr:`LiveCard.library`). Cannot be used together with ``driver``. Refused for cards of other types."""
        if self._library is None:
            if self.type != "mcx314":
                raise Refused(
                    f"Card {self._name} is a {self.type}, whose source has no functions with whole numbers. Nothing "
                    "was done. Use driver."
                )
            object.__setattr__(self, "_library", _core.Mcx314Library(self._world, self._name))
        assert self._library is not None
        return self._library

    # ---- names as attributes ----

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        reg = self._registers.get(name.lower())
        if reg is not None:
            return Register(self, reg)
        if name in self._about["channels"]:
            return Channel(self, name)
        try:
            return self.peek(name)
        except InvalidInput as error:
            raise AttributeError(str(error)) from None

    def _subject(self) -> str:
        return f"Card {self._name}"

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._about["channels"]]

    def __repr__(self) -> str:
        return f"<card {self._name}: {self.type}>"

    def _repr_html_(self) -> str:
        rows = []
        for reg in self.registers.values():
            try:
                shown = repr(reg.peek())
            except InvalidInput:
                shown = reg.name
            rows.append(
                f"<tr><td>{shown}</td><td>{reg.offset:#04x}</td><td>{reg.access}</td><td>{reg.meaning}</td></tr>"
            )
        return f"<b>{self._name}</b>: {self.title}<table>{''.join(rows)}</table>"


class Cards(Mapping[str, Card]):
    """The cards of a rack by their names."""

    def __init__(self, world: _core.RackHandle) -> None:
        self._world = world
        self._names = list(world.config()["cards"])
        self._cards: dict[str, Card] = {}

    def __getitem__(self, name: str) -> Card:
        if name not in self._names:
            raise NoSuchName(
                f"Unknown card {name!r}; the cards of this rack are: {', '.join(self._names) or 'none'}. Nothing "
                "was done."
            )
        if name not in self._cards:
            self._cards[name] = Card(self._world, name)
        return self._cards[name]

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return repr(dict(self))
