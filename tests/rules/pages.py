"""Shared parts of the scripts that make pages of docs/ from data files: cells, links, check for outdated pages."""

from __future__ import annotations

from pathlib import Path

from found import text_of


def cell(text: object) -> str:
    """Returns a text as a cell of a Markdown table."""
    return " ".join(str(text).split()).replace("|", "\\|").replace("<", "&lt;")


def link(path: Path | str, text: object) -> str:
    """Returns a link from a page two folders below the root to a file of the tree."""
    return f"[{cell(text)}](../../{path})"


def stale(root: Path, pages: dict[Path, str], write: bool) -> list[str]:
    """Writes the pages if `write`; returns a sentence for each that differs from its file."""
    if write:
        for path, text in pages.items():
            (root / path).write_text(text, encoding="utf-8")
    files = {path: text_of(root / path) if (root / path).exists() else "" for path in pages}
    return [f"{path} is out of date" for path, text in pages.items() if files[path] != text]
