"""What ctest knows of the tests of a build."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any


def entries(build: Path, options: list[str]) -> list[dict[str, Any]]:
    """The tests that ctest chooses with these options, each with its properties and, if it can run, its command."""
    shown = subprocess.run(
        ["ctest", "--test-dir", str(build), "--show-only=json-v1", *options], capture_output=True, text=True, check=True
    )
    tests: list[dict[str, Any]] = json.loads(shown.stdout)["tests"]
    return tests


def property_of(entry: dict[str, Any], name: str, otherwise: Any) -> Any:
    return next((p["value"] for p in entry["properties"] if p["name"] == name), otherwise)
