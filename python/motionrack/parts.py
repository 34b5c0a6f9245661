"""Wires and parts of a rack by their names: ``rack.wires["X.limit_plus"]``, ``rack.parts["X"].position_mm``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping

from . import _core
from .errors import InvalidInput, NoSuchName


class Wires(MutableMapping[str, float]):
    """All wires by name: ``CARD.PIN``, ``NAME.END`` or ``estop``. The value of a digital wire is 0 or 1, of an analog
    wire its voltage, V.

    Setting a wire forces it and disconnects its driver; ``del`` or None releases it. InvalidInput (unknown wire),
    Refused (an output, an invalid value).
    """

    def __init__(self, world: _core.RackHandle) -> None:
        self._world = world

    def __getitem__(self, name: str) -> float:
        try:
            return self._world.wire(name)
        except InvalidInput as error:
            raise NoSuchName(error.message) from None

    def __setitem__(self, name: str, value: float | None) -> None:
        if value is None:
            self._world.release_wire(name)
        else:
            self._world.set_wire(name, float(value))

    def __delitem__(self, name: str) -> None:
        self._world.release_wire(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._world.wires())

    def __len__(self) -> int:
        return len(self._world.wires())

    @property
    def drivable(self) -> list[str]:
        """Names of the wires that can be set."""
        return [name for name, drivable in self._world.wires().items() if drivable]

    def __repr__(self) -> str:
        return f"<{len(self)} wires>"


class Part:
    """True values of an axis, a stage, a belt, a table or a scan head, independent of all counters;
    the names of quantities end in their units.

    Setting a quantity moves the part by hand; Refused if that is not possible.
    """

    def __init__(self, world: _core.RackHandle, name: str, quantities: dict[str, str]) -> None:
        for key, value in (("_world", world), ("_name", name), ("_quantities", quantities)):
            object.__setattr__(self, key, value)

    _world: _core.RackHandle
    _name: str
    _quantities: dict[str, str]

    @property
    def name(self) -> str:
        """Its name in the rack file."""
        return self._name

    @property
    def quantities(self) -> dict[str, str]:
        """Its quantities and their meanings."""
        return dict(self._quantities)

    def __getattr__(self, name: str) -> float:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._quantities:
            raise AttributeError(f"{self._name} has no quantity {name}; it has: {', '.join(self._quantities)}.")
        return self._world.quantity(f"{self._name}.{name}")

    def __setattr__(self, name: str, value: float) -> None:
        self._world.set_quantity(f"{self._name}.{name}", float(value))

    def __dir__(self) -> list[str]:
        return ["name", "quantities", *self._quantities]

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={getattr(self, name):g}" for name in self._quantities)
        return f"<{self._name}: {shown}>"


class Parts(Mapping[str, Part]):
    """The parts of a rack by their names."""

    def __init__(self, world: _core.RackHandle) -> None:
        self._world = world
        self._parts = {name: Part(world, name, quantities) for name, quantities in world.quantities().items()}

    def __getitem__(self, name: str) -> Part:
        if name not in self._parts:
            raise NoSuchName(
                f"Unknown part {name!r}; the parts of this rack are: {', '.join(self._parts) or 'none'}. Nothing "
                "was done."
            )
        return self._parts[name]

    def __contains__(self, name: object) -> bool:
        return name in self._parts

    def __iter__(self) -> Iterator[str]:
        return iter(self._parts)

    def __len__(self) -> int:
        return len(self._parts)

    def __repr__(self) -> str:
        return repr(dict(self._parts))
