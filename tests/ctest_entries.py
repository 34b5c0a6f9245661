"""Tests of a build, as ctest lists them."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any


def entries(build: Path, options: list[str]) -> list[dict[str, Any]]:
    """Returns the tests that ctest chooses with these options: properties and, if the test can run, its command."""
    shown = subprocess.run(
        ["ctest", "--test-dir", str(build), "--show-only=json-v1", *options], capture_output=True, text=True, check=True
    )
    tests: list[dict[str, Any]] = json.loads(shown.stdout)["tests"]
    return tests


def property_of(entry: dict[str, Any], name: str, otherwise: Any) -> Any:
    return next((p["value"] for p in entry["properties"] if p["name"] == name), otherwise)
