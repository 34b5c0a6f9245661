"""Cards of a rack by their own maps: registers, fields, channels, values, the function library.

    card = rack.cards["c1"]
    card.RR0.DRV             a field, looked at without any effect and without taking time
    card.RR3.read().DEND     an access of the bus with all its effects
    card.WR0 = 0x0120        an access of the bus
    card.x.LP                what belongs to a channel
    card.driver.TCurve_F(1, 100, 2000, 200, 12000)
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from . import _core
from ._time import ticks_of
from .errors import BadInput, NoSuchName, Refused, Timeout


def _field(reg: Mapping[str, Any], name: str) -> tuple[str, int, str]:
    for field in reg["fields"]:
        if field[0].lower() == name.lower():
            return field[0], field[1], field[2]
    known = ", ".join(field[0] for field in reg["fields"])
    raise BadInput(f"Register {reg['name']} has no field {name}; it has: {known or 'none'}. Nothing was done.")


def _shift(mask: int) -> int:
    return (mask & -mask).bit_length() - 1


class Word(int):
    """What a register showed: a whole number whose fields are attributes, ``word.DRV``."""

    _reg: Mapping[str, Any]

    def __new__(cls, value: int, reg: Mapping[str, Any]) -> Word:
        word = super().__new__(cls, value)
        word._reg = reg
        return word

    def __getattr__(self, name: str) -> int:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            _, mask, _ = _field(self._reg, name)
        except BadInput as error:
            raise AttributeError(str(error)) from None
        return (int(self) & mask) >> _shift(mask)

    @property
    def fields(self) -> dict[str, int]:
        """All fields by their names."""
        return {name: (int(self) & mask) >> _shift(mask) for name, mask, _ in self._reg["fields"]}

    def __dir__(self) -> list[str]:
        return ["fields", *(field[0] for field in self._reg["fields"])]

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={value}" for name, value in self.fields.items() if value)
        digits = -(-self._reg["width"] // 4)
        return f"{self._reg['name']} {int(self):0{digits}X}h" + (f" ({shown})" if shown else "")


class Register:
    """One register of a card, or of one of its channels.

    Its fields are attributes, looked at without effect: ``card.RR0.DRV``. ``read`` and ``write`` are accesses of the
    bus: they have all their effects and take the card's bus time.
    """

    __slots__ = ("_card", "_reg", "_name")

    def __init__(self, card: Card, reg: Mapping[str, Any], channel: str = "") -> None:
        self._card = card
        self._reg = reg
        self._name = f"{channel}.{reg['name']}" if channel else str(reg["name"])

    @property
    def name(self) -> str:
        """As the card's reference page has it; of a channel with its name in front."""
        return self._name

    @property
    def meaning(self) -> str:
        """What it is, in a line."""
        return str(self._reg["meaning"])

    @property
    def offset(self) -> int:
        """Byte offset in the card's map."""
        return int(self._reg["offset"])

    @property
    def width(self) -> int:
        """Bits, 1 to 32."""
        return int(self._reg["width"])

    @property
    def access(self) -> str:
        """``"read"``, ``"write"``, or ``"read_clears"``: reading it clears it."""
        return str(self._reg["access"])

    def peek(self) -> Word:
        """What it holds, without any effect; takes no time. BadInput where the card keeps no such word."""
        return Word(self._card.peek(self._name), self._reg)

    def read(self) -> Word:
        """Reads it over the bus, with all effects; of a register that exists once a channel:
        that of the channel the card shows."""
        if self.access == "write":
            raise Refused(
                f"Register {self._name} can only be written; nothing was done. Use peek() to see what was written."
            )
        return Word(self._card.read(self.offset, self._bits()), self._reg)

    def write(self, value: int | None = None, **fields: int) -> None:
        """Writes it over the bus, with all effects: a word (0 to 2**width - 1), fields by their names,
        or fields over a word."""
        if self.access != "write":
            raise Refused(f"Register {self._name} can only be read; nothing was written.")
        word = 0 if value is None else int(value)
        if value is None and not fields:
            raise Refused(f"Nothing is given to be written to register {self._name}.")
        if not 0 <= word < 1 << self.width:
            raise Refused(
                f"{word} does not fit into register {self._name}: 0 to {(1 << self.width) - 1}. Nothing was written."
            )
        for key, number in fields.items():
            name, mask, _ = _field(self._reg, key)
            if not 0 <= int(number) << _shift(mask) <= mask:
                raise Refused(
                    f"{number} does not fit into field {name} of {self._name}: 0 to {mask >> _shift(mask)}. Nothing "
                    "was written."
                )
            word = (word & ~mask) | int(number) << _shift(mask)
        self._card.write(self.offset, word, self._bits())

    def _bits(self) -> int:
        return next(bits for bits in (8, 16, 32) if self.width <= bits)

    def __getattr__(self, name: str) -> int:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            _field(self._reg, name)
        except BadInput as error:
            raise AttributeError(str(error)) from None
        return int(getattr(self.peek(), name))

    def __int__(self) -> int:
        return int(self.peek())

    __index__ = __int__

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, int):
            return NotImplemented
        return int(self) == other

    __hash__ = None  # type: ignore[assignment]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(field[0] for field in self._reg["fields"])]

    def __repr__(self) -> str:
        try:
            return f"<{self.peek()!r}: {self.meaning}>"
        except BadInput:
            return f"<{self._name}: {self.meaning}>"


class Channel:
    """What a card has once a channel: ``card.x.LP`` (a whole number), ``card.x.RR1`` (a register)."""

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
        except BadInput as error:
            raise AttributeError(str(error)) from None

    def __dir__(self) -> list[str]:
        start = self._name + "."
        values = [value[len(start) :] for value in self._card._about["values"] if value.startswith(start)]
        return [*(reg["name"] for reg in self._card._about["map"]["registers"] if reg["per_axis"]), *values]

    def __repr__(self) -> str:
        return f"<channel {self._name} of {self._card.name}>"


class Card:
    """One card of a rack. Registers and channels are attributes, by the names of its map; case does not matter."""

    def __init__(self, world: _core.World, name: str) -> None:
        about = _core.describe_card(world, name)
        registers = {str(reg["name"]).lower(): reg for reg in about["map"]["registers"]}
        for key, value in (
            ("_world", world),
            ("_name", name),
            ("_about", about),
            ("_registers", registers),
            ("_driver", None),
        ):
            object.__setattr__(self, key, value)

    _world: _core.World
    _name: str
    _about: dict[str, Any]
    _registers: dict[str, Any]
    _driver: Any

    # ---- what it is ----

    @property
    def name(self) -> str:
        """Its name in the rack file."""
        return self._name

    @property
    def type(self) -> str:
        """``"mcx314"``, ``"databoard4002"``, ``"ioflex02"``, ``"grating_bus"``, ``"grating_decoder"`` or ``"rtc5"``."""
        return str(self._about["type"])

    @property
    def title(self) -> str:
        """What it is, in a line."""
        return str(self._about["map"]["title"])

    @property
    def map(self) -> dict[str, Any]:
        """Everything that is declared of the card: registers, commands, machines (of states) and pins."""
        return dict(self._about["map"])

    @property
    def registers(self) -> dict[str, Register]:
        """All registers by their names."""
        return {str(reg["name"]): Register(self, reg) for reg in self._about["map"]["registers"]}

    @property
    def channels(self) -> dict[str, Channel]:
        """Its channels by their names: ``card.channels["x"]`` is ``card.x``;
        of cards that number them ``card.channels["0"].POSITION``."""
        names = [
            *self._about["channels"],
            *(value.partition(".")[0] for value in self._about["values"] if "." in value),
        ]
        return {name: Channel(self, name) for name in dict.fromkeys(names)}

    @property
    def values(self) -> list[str]:
        """What ``peek`` knows beside the registers: ``"x.LP"``."""
        return list(self._about["values"])

    @property
    def pins(self) -> dict[str, str]:
        """Its pins and what they are; ``rack.wires["c1.xlmtp"]`` is the level of one."""
        return dict(self._about["pins"])

    # ---- looking, reading, writing ----

    def peek(self, name: str) -> int:
        """A register or value by its name (``"RR0"``, ``"x.LP"``), without any effect; takes no time.
        BadInput with the names that there are."""
        return _core.peek(self._world, self._name, name)

    def read(self, offset: int, bits: int = 16) -> int:
        """One access of the bus, with all effects: ``offset`` in bytes in the card's map, ``bits`` 8,
        16 or 32 as the card's bus makes them."""
        return _core.read(self._world, self._name, bits, int(self._about["base"]) + offset)

    def write(self, offset: int, value: int, bits: int = 16) -> None:
        """One access of the bus, with all effects; ``value`` 0 to 2**bits - 1."""
        _core.write(self._world, self._name, bits, int(self._about["base"]) + offset, value)

    def view(self, clearing: bool = False) -> str:
        """What its registers show through the bus, in words; ``clearing``: RR3 too, which reading clears.
        Refused for cards without a view."""
        return _core.view(self._world, self._name, clearing)

    def wait_interrupt(self, timeout: float) -> None:
        """Until its interrupt line is active, at most ``timeout`` s, then Timeout."""
        if not _core.wait_interrupt(self._world, self._name, ticks_of(timeout)):
            raise Timeout(f"Card {self._name} asked for no interrupt within {timeout:g} s.")

    def refused_frames(self) -> int:
        """Frames that a motion card on a grating bus did not publish since the start. Refused for other cards."""
        return _core.refused_frames(self._world, self._name)

    # ---- its function library ----

    @property
    def driver(self) -> Any:
        """Its function library, an object of its type (Mcx314, Databoard4002, Ioflex02, GratingCard, Rtc5);
        made at first use, or by :meth:`open`."""
        if self._driver is None:
            self.open()
        return self._driver

    def open(self, **settings: Any) -> Any:
        """A function library with settings of its own: of a databoard4002 ``counts_per_mm`` (> 0) and ``select`` (0 to
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
        except BadInput as error:
            raise AttributeError(str(error)) from None

    def __setattr__(self, name: str, value: int) -> None:
        reg = self._registers.get(name.lower())
        if reg is None:
            raise AttributeError(f"Card {self._name} has no register {name}; nothing was written.")
        Register(self, reg).write(value)

    def __dir__(self) -> list[str]:
        return [
            *super().__dir__(),
            *(str(reg["name"]) for reg in self._about["map"]["registers"]),
            *self._about["channels"],
        ]

    def __repr__(self) -> str:
        return f"<card {self._name}: {self.type}>"

    def _repr_html_(self) -> str:
        rows = []
        for reg in self.registers.values():
            try:
                shown = repr(reg.peek())
            except BadInput:
                shown = reg.name
            rows.append(
                f"<tr><td>{shown}</td><td>{reg.offset:#04x}</td><td>{reg.access}</td><td>{reg.meaning}</td></tr>"
            )
        return f"<b>{self._name}</b>: {self.title}<table>{''.join(rows)}</table>"


class Cards(Mapping[str, Card]):
    """The cards of a rack by their names."""

    def __init__(self, world: _core.World) -> None:
        self._world = world
        self._names = list(world.config()["cards"])
        self._cards: dict[str, Card] = {}

    def __getitem__(self, name: str) -> Card:
        if name not in self._names:
            raise NoSuchName(
                f"There is no card {name!r} in this rack; its cards are: {', '.join(self._names) or 'none'}. Nothing "
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
