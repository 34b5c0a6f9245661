#!/usr/bin/python3
"""Writes motionrack/_core.pyi from the built module, using the signatures that pybind11 stores in it:
PYTHONPATH=BUILD/python python3 python/tools/stubs.py."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

from motionrack import _core

HEAD = '''"""The C++ side of the package; made by python/tools/stubs.py."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
'''
PYBIND = (
    (r"motionrack\._core\.", ""),
    (r"numpy\.ndarray\[numpy\.(\w+)\]", r"npt.NDArray[np.\1]"),
    (r"(int|float)\[\d+\]", r"\1"),
    (r"\bList\[", "list["),
    (r"\bTuple\[", "tuple["),
    (r"\bDict\[", "dict["),
    (r"Optional\[([\w.]+(?:\[[^\]]*\])?)\]", r"\1 | None"),
    (r"\bobject\b", "Any"),
    (r"\bdict\b(?!\[)", "dict[str, Any]"),
    (r"\blist\b(?!\[)", "list[Any]"),
    (r"\btuple\b(?!\[)", "tuple[Any, ...]"),
)


def typed(text: str) -> str:
    for pattern, python in PYBIND:
        text = re.sub(pattern, python, text)
    return text


def parameters(text: str) -> str:
    """Returns the type of an argument, which may be any sequence or array."""
    text = re.sub(r"npt\.NDArray\[[\w.]+\]", "npt.ArrayLike", typed(text))
    text = text.replace("list[", "Sequence[")
    return re.sub(r"^self: \w+", "self", text)


def function(name: str, doc: str, indent: str = "", static: bool = False) -> Iterator[str]:
    match = re.match(rf"{re.escape(name)}\((.*)\) -> (.*)$", doc.splitlines()[0])
    assert match, f"no signature of {name}: {doc!r}"
    if static:
        yield f"{indent}@staticmethod"
    head = f"{indent}def {name}({parameters(match[1])}) -> {typed(match[2])}:"
    said = "\n".join(doc.splitlines()[1:]).strip()
    if not said:
        yield f"{head} ..."
        return
    yield head
    yield f'{indent}    """{said}"""'


def members(kind: type) -> Iterator[str]:
    yield f"class {kind.__name__}:"
    if kind.__doc__:
        yield f'    """{kind.__doc__.strip()}"""'
    for name, value in vars(kind).items():
        if not name.startswith("_") or (name == "__init__" and "Initialize self" not in (value.__doc__ or "")):
            if isinstance(value, property):
                yield "    @property"
                answer = typed((value.fget.__doc__ or "-> Any").splitlines()[0].rpartition("-> ")[2])
                yield f"    def {name}(self) -> {answer}:"
                yield f'        """{(value.__doc__ or "").strip()}"""'
                if value.fset is not None:
                    yield f"    @{name}.setter"
                    yield f"    def {name}(self, value: {answer}) -> None: ..."
            elif isinstance(value, (int, str)):
                yield f"    {name}: {type(value).__name__}"
            else:
                yield from function(name, getattr(kind, name).__doc__ or "", "    ", isinstance(value, staticmethod))


def stub() -> str:
    lines = [HEAD]
    for name, value in vars(_core).items():
        if name.startswith("_"):
            continue
        lines += ["", *members(value), ""] if isinstance(value, type) else list(function(name, value.__doc__ or ""))
    return re.sub(r"\n{3,}", "\n\n\n", "\n".join(lines)).rstrip() + "\n"


if __name__ == "__main__":
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1] / "motionrack" / "_core.pyi"
    path.write_text(stub(), encoding="utf-8")
