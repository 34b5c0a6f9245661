"""Rule: tests/known_breaches.txt only shrinks: known_breaches.py ROOT

No version of the list, that of the tree included, has a row that the version before did not have, or a larger factor.
A test reads each row, and each row has its reason.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from found import files_of, finish, git, text_of

ROOT = Path(sys.argv[1]).resolve()
LIST = "tests/known_breaches.txt"
LIMITS = ("max_accel", "max_velocity_step")
ROW = re.compile(r"(?P<runs>[a-z_]+) (?P<limit>[a-z_]+) (?P<factor>[0-9.]+) (?P<why>\S.*)")
READ = re.compile(r'known_breaches\("([a-z_]+)"\)')
Factors = dict[tuple[str, str], float]


def factors_in(text: str) -> tuple[Factors, list[str]]:
    """Returns the factor of each runs and limit, and a sentence for each invalid line."""
    out: Factors = {}
    wrong = []
    for line in text.splitlines():
        if line.startswith("#") or not line:
            continue
        match = ROW.fullmatch(line)
        if match is None or match["limit"] not in LIMITS or float(match["factor"]) <= 1:
            wrong.append(f"{LIST}: `{line}` is not: runs, one of {', '.join(LIMITS)}, factor above 1, why")
        elif (match["runs"], match["limit"]) in out:
            wrong.append(f"{LIST}: {match['runs']} has two rows for {match['limit']}")
        else:
            out[match["runs"], match["limit"]] = float(match["factor"])
    return out, wrong


def growth(before: Factors, after: Factors, version: str) -> list[str]:
    """Returns a sentence for each new row and each larger factor of a version."""
    out = []
    for (runs, limit), factor in after.items():
        known = before.get((runs, limit))
        if known is None:
            out.append(f"{LIST}, {version}: the row {runs} {limit} is new")
        elif factor > known:
            out.append(f"{LIST}, {version}: {runs} {limit} was {known:g} and is {factor:g}")
    return out


def earlier_versions() -> list[tuple[str, Factors]]:
    """Returns the committed versions, the oldest first; none in an archive."""
    commits = git(ROOT, "log", "--reverse", "--format=%h", "HEAD", "--", LIST) or ""
    out = []
    for commit in commits.split():
        text = git(ROOT, "show", f"{commit}:{LIST}")
        if text is not None:
            out.append((commit, factors_in(text)[0]))
    return out


def main() -> None:
    now, wrong = factors_in(text_of(ROOT / LIST))
    versions = [*earlier_versions(), ("as it is", now)]
    for (_, before), (version, after) in zip(versions, versions[1:]):
        wrong += growth(before, after, version)
    read = {
        runs
        for path in files_of(ROOT)
        if path.suffix in (".cpp", ".hpp") and "test" in str(path)
        for runs in READ.findall(text_of(ROOT / path))
    }
    wrong += [f"{LIST}: no test reads the row {runs}" for runs in sorted({runs for runs, _ in now} - read)]
    finish(wrong, f"keep the limits, or lower the factor in {LIST}; it only shrinks", f"{len(now)} known breaches")


if __name__ == "__main__":
    main()
