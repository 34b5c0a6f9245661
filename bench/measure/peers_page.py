"""The tables of the page that compare other programs on the same work, with the differences in their tasks."""
from text import bytes_of, count, not_measured, paragraph, ratio, table, time_of


def _rows_of(ours: dict, theirs: dict, names: tuple[str, str], things: float) -> list[tuple[str, ...]]:
    times = theirs["cpu_s"] / ours["cpu_s"]
    return [
        (names[0], time_of(1e9 * ours["cpu_s"] / things), bytes_of(ours["peak_bytes"]), ratio(times)),
        (names[1], time_of(1e9 * theirs["cpu_s"] / things), bytes_of(theirs["peak_bytes"]), "1"),
    ]


def _verilator(results: dict) -> list[str]:
    axis, frames = results["benches"].get("axis", {}), results["benches"].get("grating", {})
    rows = []
    for case, what in (
        ("servo", "4.5 million pulses, up to 4 Mpps"),
        ("servo_s", "5.2 million pulses, S-curves"),
        ("stepper", "52,000 pulses, up to 40 kpps"),
    ):
        clocked = axis.get(f"drive_clocked/{case}")
        if not clocked:
            continue
        rows.append((f"one axis, {what}", "verilator", time_of(clocked["ns"]) + " a pulse", "1"))
        for name, how in (
            (f"drive/{case}_heard", "the virtual chip, each pulse with its instant"),
            (f"drive/{case}", "the virtual chip, pulses counted"),
        ):
            if name in axis:
                rows.append(("", how, time_of(axis[name]["ns"]) + " a pulse", ratio(clocked["ns"] / axis[name]["ns"])))
    if "frames_clocked" in frames:
        rows.append(
            ("a period of 200 us, 8 scales, 11 cards", "verilator", time_of(frames["frames_clocked"]["ns"]), "1")
        )
        for name, how in (
            ("every_wire_watched", "the virtual cards, every wire listened to"),
            ("alone", "the virtual cards, no observer"),
        ):
            row = frames.get(f"frames_of_cards/{name}")
            if row:
                rows.append(("", how, time_of(row["ns"]), ratio(frames["frames_clocked"]["ns"] / row["ns"])))
    if not rows:
        return []
    return [
        "",
        "### verilator: the same logic, clocked",
        "",
        *paragraph(
            "Compiled from the Verilog implementations of the cards' rules (`tests/verilog`), one thread, `-O3`. Same "
            "work: the pulses of both, and the frames of both, are compared before or after the measurement, pulses to "
            "the tick of 125 ns. The difference: verilator evaluates the logic at each clock and could show every "
            "register at each of them; the virtual cards compute the result up to the next requested instant. The "
            "Verilog was written to be read, not to be fast, and has one axis, without registers, interpolation or "
            "encoders."
        ),
        "",
        *table(("work", "by", "each", "times as fast"), rows),
    ]


def _linuxcnc(results: dict) -> list[str]:
    got, chip = results["peers"].get("linuxcnc", {}), results["benches"].get("chip", {})
    out = ["", "### LinuxCNC: steps made and counted", ""]
    if "missing" in got or not got:
        return [*out, not_measured(got)]
    theirs = got["make_ns"] + got["count_ns"]
    rows = [
        (
            "LinuxCNC: stepgen (quadrature) and encoder, four channels",
            f"{time_of(theirs)} ({time_of(got['make_ns'])} and {time_of(got['count_ns'])})",
            "1",
        )
    ]
    for name, how in (
        ("edges_one_by_one/20_kpps", "the virtual chip, motors, encoders; edges decoded one by one"),
        ("edges_in_batches/20_kpps", "the same, decoded in batches"),
    ):
        if name in chip:
            rows.append((how, time_of(chip[name]["ns"]), ratio(theirs / chip[name]["ns"])))
    return [
        *out,
        *paragraph(
            "Four axes at 20,000 steps a second, each step one edge of a quadrature encoder that is counted. "
            f"LinuxCNC's thread of 40 us makes {got['steps_a_period']:.2f} steps a period. The difference: HAL runs in "
            "step with the clock and cannot run faster, so its time is the CPU time that its own two functions report "
            f"(of the fastest nine tenths of {count(got['periods'])} periods, "
            f"{'with' if got['realtime'] else 'without'} a real-time kernel), without the thread that wakes them, "
            f"which takes {time_of(got['thread_ns'])} a period in all, sampling included. It pays for each period "
            "whether a step falls into it or not; at fewer steps a second a step costs it more. It must end within "
            "each period and drives real pins; the virtual chip has no such constraint, and so may generate edges in "
            "batches. The chip puts each pulse on a tick of 125 ns, stepgen on a period of its thread."
        ),
        "",
        *table(("by", "a step", "times as fast"), rows),
    ]


def _sigrok(results: dict) -> list[str]:
    got = results["peers"].get("sigrok", {})
    out = ["", "### sigrok-cli: encoder counts from a capture", ""]
    if "missing" in got or not got:
        return [*out, not_measured(got)]
    return [
        *out,
        *paragraph(
            f"One VCD file of {count(got['edges'])} encoder edges ({bytes_of(got['file_bytes'])}, 1 us a tick), "
            "counted by the decoder `graycode` and by `motionrack decode`; both ended at the same count. The "
            "difference: sigrok's decoder is written in Python and gets each sample of 1 us, and sigrok prints each "
            "count; `motionrack decode` prints the sums. The strength of sigrok is its many other protocols."
        ),
        "",
        *table(
            ("by", "an edge, CPU time", "peak memory", "times as fast"),
            _rows_of(got["ours"], got["theirs"], ("motionrack decode", "sigrok-cli"), got["edges"]),
        ),
    ]


def _rs274(results: dict) -> list[str]:
    got = results["peers"].get("rs274", {})
    out = ["", "### LinuxCNC's interpreter: G-code into canonical calls", ""]
    if "missing" in got or not got:
        return [*out, not_measured(got)]
    return [
        *out,
        *paragraph(
            f"A program of {count(got['lines'])} short lines read and printed as canonical calls, by `rs274 -g` and by "
            "`motionrack canon --numbered`, whose moves are compared. The difference: `motionrack canon` knows the "
            "program's whole text before it begins, `rs274` reads line by line from the file."
        ),
        "",
        *table(
            ("by", "a line, CPU time", "peak memory", "times as fast"),
            _rows_of(got["ours"], got["theirs"], ("motionrack canon", "rs274"), got["lines"]),
        ),
    ]


def peers(results: dict) -> list[str]:
    return [
        "",
        "## Beside others",
        "",
        "The same work, done one after the other on the same machine in the same run.",
        *_verilator(results),
        *_linuxcnc(results),
        *_sigrok(results),
        *_rs274(results),
    ]
