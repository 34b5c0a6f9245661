"""Performance aims of the product, and the verdict on each from the results of a run."""
from typing import Callable, NamedTuple

#: Limits of ./run, s: a build into an empty folder on two cores, its CPU time, and a start with nothing to build.
COLD_BUILD_S, COLD_BUILD_CPU_S, SECOND_START_S = 240, 480, 1


class Aim(NamedTuple):
    says: str
    value: Callable[[dict], float]  # reads it from the results; raises what verdicts() catches if it was not measured
    limit: float
    form: str  # format of the value
    at_most: bool = False


def _ns(results: dict, section: str, name: str) -> float:
    return results["benches"][section][name]["ns"]


def _times(section: str, name: str, baseline: str) -> Callable[[dict], float]:
    return lambda results: _ns(results, section, baseline) / _ns(results, section, name)


def _of(section: str, name: str) -> Callable[[dict], float]:
    return lambda results: _ns(results, section, name)


def _own(section: str, name: str, counter: str) -> Callable[[dict], float]:
    return lambda results: results["benches"][section][name][counter]


def _millions(section: str, name: str) -> Callable[[dict], float]:
    return lambda results: 1e3 / _ns(results, section, name)


def _late(results: dict) -> float:
    rows = results["growth"]["clients"]
    return next(row["p99_ms"] for row in (rows if isinstance(rows, list) else []) if row["n"] == 200)


def _cold_build(results: dict) -> float:
    """Returns the wall time of a build. Raises KeyError unless the machine has two cores, for which the limit holds."""
    build = results["build"]
    if build["machine"]["cores"] != 2:
        raise KeyError("cores")
    return build["wall_s"]


def _widest(kind: str, size: int, counter: str) -> Callable[[dict], float]:
    """Returns a function that finds the maximum of a counter over the kernels of one kind and size."""
    return lambda results: max(
        row[counter]
        for name, row in results["benches"]["decode"].items()
        if name.startswith(kind + "/") and name.endswith(f"/{size}")
    )


AIMS = [
    Aim(
        "four axes cruise at 4 Mpps, the host polls each ms: virtual seconds a second",
        _own("chip", "cruise/look_each_ms", "sim_s/s"),
        10_000,
        "{:,.0f}",
    ),
    Aim(
        "a whole move with its ramps, no listener: times the twin",
        _times("chip", "moves/servo", "moves_twin/servo"),
        1_000,
        "{:,.0f}",
    ),
    Aim(
        "edges listened to and decoded: millions a second", _millions("chip", "edges_in_batches/4_Mpps"), 200, "{:,.0f}"
    ),
    Aim(
        "a step of an axis' speed with a machine listening, ns",
        _of("chip", "speed_steps/t_curve_machines"),
        60,
        "{:.1f}",
        True,
    ),
    Aim(
        "an edge at an even speed, generated and decoded, ns", _of("chip", "edges_in_batches/4_Mpps"), 1, "{:.2f}", True
    ),
    Aim("an edge on a line, ns", _of("chip", "path_edges/line"), 1, "{:.2f}", True),
    Aim("an edge on a circle, ns", _of("chip", "path_edges/arc"), 1, "{:.2f}", True),
    Aim(
        "an edge on a circle at constant vector speed, ns",
        _of("chip", "path_edges/arc_at_constant_vector_speed"),
        1,
        "{:.2f}",
        True,
    ),
    Aim(
        "sampled lines of one axis, a byte a sample: times a table of 16, with the CPU's widest kernels",
        _widest("one_axis_bytes", 16384, "ratio"),
        20,
        "{:.1f}",
    ),
    Aim("four axes in a byte: times a table of 65,536", _widest("four_axes_in_a_byte", 16384, "ratio"), 8, "{:.1f}"),
    Aim(
        "frames of the grating bus, eight scales and eleven cards: times a clocked simulation",
        _times("grating", "frames_of_cards/alone", "frames_clocked"),
        1_000,
        "{:,.0f}",
    ),
    Aim(
        "the same with every wire listened to",
        _times("grating", "frames_of_cards/every_wire_watched", "frames_clocked"),
        1_000,
        "{:,.0f}",
    ),
    Aim("200 WebSocket clients at 20 Hz: lateness of 99 % of the slices, ms", _late, 5, "{:.1f}", True),
    Aim(
        "RTC5, a vector each tick with encoder correction and table: millions of ticks a second",
        _millions("rtc5", "run_card/micro_vectors_fly_table"),
        100,
        "{:,.0f}",
    ),
    Aim(
        "RTC5, long vectors, unobserved: millions of ticks a second",
        _millions("rtc5", "run_card/long_marks_unseen"),
        10_000,
        "{:,.0f}",
    ),
    Aim("a build into an empty folder on two cores, s", _cold_build, COLD_BUILD_S, "{:.0f}", True),
    Aim("its CPU time, s", lambda results: results["build"]["cpu_s"], COLD_BUILD_CPU_S, "{:.0f}", True),
    Aim(
        "`./run --version` with nothing to build, s",
        lambda results: results["build"]["second_start_s"],
        SECOND_START_S,
        "{:.2f}",
        True,
    ),
]


def verdicts(results: dict) -> list[tuple[str, str, str, str]]:
    """Returns a row (aim, limit, measured value, verdict) for each aim that the run measured."""
    out = []
    for aim in AIMS:
        try:
            value = aim.value(results)
        except (KeyError, StopIteration, ValueError):
            continue
        met = value <= aim.limit if aim.at_most else value >= aim.limit
        limit = ("at most " if aim.at_most else "at least ") + f"{aim.limit:,g}"
        out.append((aim.says, limit, aim.form.format(value), "met" if met else "**not met**"))
    return out
