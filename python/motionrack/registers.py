"""Registers and their fields, of virtual and real cards."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

from .errors import InvalidInput, Refused


def _field(reg: Mapping[str, Any], name: str) -> tuple[str, int, str]:
    for field in reg["fields"]:
        if field[0].lower() == name.lower():
            return field[0], field[1], field[2]
    known = ", ".join(field[0] for field in reg["fields"])
    raise InvalidInput(f"Register {reg['name']} has no field {name}; it has: {known or 'none'}. Nothing was done.")


def _shift(mask: int) -> int:
    return (mask & -mask).bit_length() - 1


class Word(int):
    """The value of a register: a whole number whose fields are attributes, ``word.DRV``."""

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
        except InvalidInput as error:
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

    Its fields are attributes, read without side effects: ``card.RR0.DRV``. ``read`` and ``write`` are bus accesses:
    they have all side effects and take the card's bus time.
    """

    __slots__ = ("_card", "_reg", "_name")

    def __init__(self, card: MappedCard, reg: Mapping[str, Any], channel: str = "") -> None:
        self._card = card
        self._reg = reg
        self._name = f"{channel}.{reg['name']}" if channel else str(reg["name"])

    @property
    def name(self) -> str:
        """Its name in the card's reference page; for a register of a channel with its prefix: ``"x.RR1"``."""
        return self._name

    @property
    def meaning(self) -> str:
        """Its meaning, in a line."""
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
        """``"read"``, ``"write"``, or ``"read_clears"``: reading the register clears it."""
        return str(self._reg["access"])

    def peek(self) -> Word:
        """Returns the register's value without side effects; takes no time. InvalidInput if the card does not store
        it."""
        return Word(self._card.peek(self._name), self._reg)

    def read(self) -> Word:
        """Reads it over the bus, with all side effects. A register per channel is read for the channel selected on the
        card."""
        if self.access == "write":
            raise Refused(
                f"Register {self._name} can only be written; nothing was done. Use peek() to see the written value."
            )
        return Word(self._card.read(self.offset, self._bits()), self._reg)

    def write(self, value: int | None = None, **fields: int) -> None:
        """Writes it over the bus, with all side effects: a word (0 to 2**width - 1), fields by their names,
        or a word with some of its fields replaced."""
        if self.access != "write":
            raise Refused(f"Register {self._name} can only be read; nothing was written.")
        word = 0 if value is None else int(value)
        if value is None and not fields:
            raise Refused(
                f"No value and no field was given for register {self._name}. Nothing was written. Pass a value, or "
                "fields by their names."
            )
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
        except InvalidInput as error:
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
        except InvalidInput:
            return f"<{self._name}: {self.meaning}>"


class MappedCard(ABC):
    """The registers of a card as attributes, by the names of its map; case does not matter."""

    _map: Mapping[str, Any]
    _registers: dict[str, Any]

    def __init__(self, declared: Mapping[str, Any], **own: Any) -> None:
        registers = {str(reg["name"]).lower(): reg for reg in declared["registers"]}
        for key, value in {"_map": declared, "_registers": registers, **own}.items():
            object.__setattr__(self, key, value)  # a plain assignment writes a register

    @property
    def title(self) -> str:
        """Its meaning, in a line."""
        return str(self._map["title"])

    @property
    def map(self) -> dict[str, Any]:
        """The declaration of the card: registers, commands, state machines and pins."""
        return dict(self._map)

    @property
    def registers(self) -> dict[str, Register]:
        """All registers by their names. Behind a live port registers per axis belong to the axis of the last
        command."""
        return {str(reg["name"]): Register(self, reg) for reg in self._map["registers"]}

    @abstractmethod
    def peek(self, name: str) -> int:
        """Returns a register by its name, without side effects."""

    @abstractmethod
    def read(self, offset: int, bits: int = 16) -> int:
        """Makes one read access with all side effects."""

    @abstractmethod
    def write(self, offset: int, value: int, bits: int = 16) -> None:
        """Makes one write access with all side effects."""

    @abstractmethod
    def _subject(self) -> str:
        """Returns the name of the card for the start of a sentence."""

    def __setattr__(self, name: str, value: int) -> None:
        reg = self._registers.get(name.lower())
        if reg is None:
            raise AttributeError(f"{self._subject()} has no register {name}; nothing was written.")
        Register(self, reg).write(value)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(str(reg["name"]) for reg in self._map["registers"])]
