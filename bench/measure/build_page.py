"""The section of the page with the cost of building."""
from typing import Any

from aims import COLD_BUILD_CPU_S, COLD_BUILD_S, SECOND_START_S
from text import bytes_of, count, not_measured, paragraph, table, time_of

SHOWN = 10


def _seconds(value: float) -> str:
    return time_of(1e9 * value)


def building(results: dict[str, Any]) -> list[str]:
    got = results.get("build", {})
    out = ["", "## Building", ""]
    if "compilations" not in got:
        return [*out, not_measured(got)]
    made, here = got["compilations"], got["machine"]
    largest = max(made, key=lambda each: int(each["peak_bytes"]))
    sources = sum(each["sources"] for each in made)
    rows = [
        ("wall time", _seconds(got["wall_s"]), f"at most {COLD_BUILD_S} s on 2 cores"),
        ("CPU time", _seconds(got["cpu_s"]), f"at most {COLD_BUILD_CPU_S} s"),
        ("compilations", f"{count(len(made))}, of {count(sources)} sources", ""),
        ("the maximum peak memory of one", f"{bytes_of(largest['peak_bytes'])}: {largest['what']}", ""),
        ("second start, wall time", _seconds(got["second_start_s"]), f"at most {SECOND_START_S} s"),
    ]
    dearest = [(each["what"], _seconds(each["cpu_s"]), bytes_of(each["peak_bytes"])) for each in made[:SHOWN]]
    return [
        *out,
        *paragraph(
            "The program configured and built into an empty folder as `./run` does it (Release, without tests, "
            "Debian's packages already there), with as many parallel compilations as ninja uses on that many cores. "
            "*Second start*: all that `./run --version` does when everything is built: the search for packages, a call "
            f"of ninja, the start of the program; the median of five. Made {here['day']} with version "
            f"{here['version']} on {here['cores']} cores ({here['cpu']}), {here['compiler']}, load {here['load']:.1f} "
            f"at the start, ccache {'on' if got['ccache'] else 'off'}."
        ),
        "",
        *table(("", "measured", "aim"), rows),
        "",
        f"The {min(SHOWN, len(made))} most expensive compilations; sources of one folder are compiled together:",
        "",
        *table(("file", "CPU time", "peak memory"), dearest),
    ]
