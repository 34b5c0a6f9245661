"""Measurements of other programs on the same work in the same run: sigrok-cli, LinuxCNC's stepgen and encoder under
halrun, LinuxCNC's interpreter.

(bench_axis and bench_grating measure verilator themselves.)
"""
import os
import re
import shutil
import signal
import statistics
import subprocess
from pathlib import Path

from running import Progress, Trouble, best_of, run
from whole import counts_decoded, passes, spiral

#: Settings of LinuxCNC. Its fast thread makes and counts steps, its slow one sets speeds and captures positions.
BASE_NS, SLOW_NS, AXES, STEPS_A_SECOND, PERIODS = 40_000, 1_000_000, 4, 20_000, 50_000

_HAL = """
loadrt threads name1=base period1={base} fp1=0 name2=slow period2={slow}
loadrt stepgen step_type={types} ctrl_type={controls}
loadrt encoder num_chan={axes}
loadrt sampler depth=60000 cfg=SSSS
addf stepgen.make-pulses base
addf encoder.update-counters base
addf sampler.0 base
addf stepgen.update-freq slow
addf stepgen.capture-position slow
addf encoder.capture-position slow
net made stepgen.make-pulses.time => sampler.0.pin.0
net read encoder.update-counters.time => sampler.0.pin.1
net turned encoder.0.rawcounts => sampler.0.pin.2
net whole base.time => sampler.0.pin.3
{channels}
start
loadusr -w halsampler -n {periods} {file}
stop
"""
_CHANNEL = """
net a{n} stepgen.{n}.phase-A => encoder.{n}.phase-A
net b{n} stepgen.{n}.phase-B => encoder.{n}.phase-B
setp stepgen.{n}.position-scale 1
setp stepgen.{n}.steplen 1
setp stepgen.{n}.maxaccel 0
setp stepgen.{n}.velocity-cmd {speed}
setp stepgen.{n}.enable 1
"""


def missing(*programs: str) -> str:
    """Returns the first of these programs that is not installed; "" if all are."""
    return next((program for program in programs if not shutil.which(program)), "")


def hal_text(file: Path, periods: int) -> str:
    """Returns a HAL configuration in which each stepgen's quadrature outputs drive one encoder counter."""
    return _HAL.format(
        base=BASE_NS,
        slow=SLOW_NS,
        types=",".join(["2"] * AXES),
        controls=",".join(["v"] * AXES),
        axes=AXES,
        periods=periods,
        file=file,
        channels="\n".join(_CHANNEL.format(n=n, speed=STEPS_A_SECOND) for n in range(AXES)),
    )


def clock_ghz() -> float:
    """Returns the rate, ticks per ns, of the counter from which LinuxCNC takes its times: the TSC of x86, whose rate
    follows from the kernel's BogoMIPS. Raises Trouble if that value is missing."""
    found = re.search(
        r"^bogomips\s*:\s*([\d.]+)", Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace"), re.M | re.I
    )
    if not found:
        raise Trouble("/proc/cpuinfo does not tell the rate of the CPU's counter.")
    return float(found[1]) / 2000


def read_periods(text: str) -> dict:
    """Returns means of the periods that halsampler wrote, without their first tenth: ticks of make-pulses, of
    update-counters and of the whole thread, over the fastest nine tenths (in the others the core was interrupted), and
    encoder counts a period, over all.

    Raises Trouble if fewer than 1,000 periods are left, or the encoder did not turn.
    """
    rows = [
        [int(word) for word in line.split()[:4]]
        for line in text.splitlines()
        if re.match(r"-?\d+ -?\d+ -?\d+ -?\d+", line)
    ]
    rows = rows[len(rows) // 10 :]
    if len(rows) < 1000:
        raise Trouble(f"halsampler wrote {len(rows)} periods, at least 1,000 were expected.")
    counts = abs(rows[-1][2] - rows[0][2]) / (len(rows) - 1)
    if counts < 0.1:
        raise Trouble(f"LinuxCNC's encoder counted {counts:g} a period; stepgen did not turn it.")
    made, read, whole = (statistics.mean(sorted(row[i] for row in rows)[: len(rows) * 9 // 10]) for i in (0, 1, 3))
    return {"periods": len(rows), "make": made, "count": read, "thread": whole, "counts_a_period": counts}


def linuxcnc_steps(scratch: Path, progress: Progress, quick: bool) -> dict:
    """Measures the CPU time of a step of LinuxCNC's software step generator, and of counting it."""
    progress.step("LinuxCNC: stepgen and encoder under halrun")
    if missing("halrun"):
        return {"missing": "`halrun` (Debian: linuxcnc-uspace) is not there."}
    file, script, pipes = scratch / "periods.txt", scratch / "steps.hal", scratch / "pipes"
    script.write_text(hal_text(file, 5_000 if quick else PERIODS), encoding="ascii")
    # HAL refuses to run as root unless this variable names another user.
    env = {
        **os.environ,
        "HOME": str(scratch),
        "RTAPI_FIFO_PATH": str(pipes / "fifo"),
        **({"RTAPI_UID": "65534"} if os.geteuid() == 0 else {}),
    }
    pipes.mkdir()
    pipes.chmod(0o777)
    scratch.chmod(0o711)
    try:
        out = run(["halrun", str(script)], cwd=scratch, limit_s=60, codes=tuple(range(256)), memory=False, env=env).out
    finally:
        subprocess.run(["halrun", "-U"], capture_output=True, check=False, env=env)
    if not file.exists():
        raise Trouble(f"halrun did not run:\n{out[-2000:]}")
    got = read_periods(file.read_text(encoding="ascii", errors="replace"))
    ghz = clock_ghz()
    steps = AXES * got["counts_a_period"]
    return {
        "periods": got["periods"],
        "realtime": "non-realtime" not in out,
        "steps_a_period": steps,
        "make_ns": got["make"] / ghz / steps,
        "count_ns": got["count"] / ghz / steps,
        "period_ns": (got["make"] + got["count"]) / ghz,
        "thread_ns": got["thread"] / ghz,
    }


def last_number(text: str) -> int:
    """Returns the last count that sigrok-cli printed. Raises Trouble if it printed none."""
    found = re.findall(r": (-?\d+)\s*$", text, re.M)
    if not found:
        raise Trouble(f"sigrok-cli told no count:\n{text[-2000:]}")
    return int(found[-1])


def sigrok(program: Path, scratch: Path, progress: Progress, quick: bool) -> dict:
    """Measures sigrok-cli's graycode decoder and motionrack decode on the same VCD file."""
    progress.step("sigrok-cli: graycode decoder")
    if missing("sigrok-cli"):
        return {"missing": "`sigrok-cli` is not there."}
    edges = 8_000 if quick else 400_000
    moves, waves = scratch / "sigrok.ngc", scratch / "sigrok.vcd"
    moves.write_text(passes(edges), encoding="ascii")
    run(
        [
            str(program),
            "trace",
            str(moves),
            str(waves),
            "--signals",
            "X.enc_a",
            "--signals",
            "X.enc_b",
            "--timescale-ns",
            "1000",
            "-q",
        ],
        cwd=scratch,
    )
    theirs = best_of(
        1 if quick else 3,
        ["sigrok-cli", "-I", "vcd", "-i", str(waves), "-P", "graycode:d0=X_enc_a:d1=X_enc_b", "-A", "graycode=count"],
        cwd=scratch,
        codes=(0, -signal.SIGABRT),
    )  # Debian's sigrok-cli aborts when its Python ends, after all of its output
    ours = best_of(1 if quick else 5, [str(program), "decode", str(waves), "-q"], cwd=scratch)
    counts = counts_decoded(ours.out)
    told = re.search(r"_enc_b\s+(-?\d+)", ours.out)
    if not told:
        raise Trouble(f"motionrack decode told no place of X:\n{ours.out[-2000:]}")
    end = int(told[1])
    # sigrok-cli prints a count when the encoder leaves it, so its last one may be one off.
    if abs(last_number(theirs.out) - end) > 1:
        raise Trouble(f"sigrok-cli counted {last_number(theirs.out)}, motionrack decode {end}.")
    return {
        "edges": counts,
        "file_bytes": waves.stat().st_size,
        "theirs": {"cpu_s": theirs.cpu_s, "peak_bytes": theirs.peak_bytes},
        "ours": {"cpu_s": ours.cpu_s, "peak_bytes": ours.peak_bytes},
    }


def interpreter(program: Path, scratch: Path, progress: Progress, quick: bool) -> dict:
    """Measures LinuxCNC's rs274 and motionrack canon, which translate the same program into canonical calls."""
    progress.step("LinuxCNC: rs274")
    if missing("rs274"):
        return {"missing": "`rs274` (Debian: linuxcnc-uspace) is not there."}
    lines = 2_000 if quick else 200_000
    file = scratch / "canon.ngc"
    file.write_text(spiral(lines), encoding="ascii")
    times = 1 if quick else 3
    theirs = best_of(times, ["rs274", "-g", "-v", "x.var", str(file)], cwd=scratch, codes=(0, 1))
    ours = best_of(times, [str(program), "canon", "--numbered", str(file)], cwd=scratch)
    # rs274 also prints a call for the line that only sets the feed rate; comparing the last `lines` calls skips it.
    moves = [re.findall(r"STRAIGHT_FEED(.*)", ran.out)[-lines:] for ran in (theirs, ours)]
    if moves[0] != moves[1] or len(moves[0]) < lines:
        raise Trouble(
            f"rs274 read {len(moves[0])} straight feeds of {lines}, motionrack canon {len(moves[1])}, or not the same "
            "ones."
        )
    return {
        "lines": lines,
        "theirs": {"cpu_s": theirs.cpu_s, "peak_bytes": theirs.peak_bytes},
        "ours": {"cpu_s": ours.cpu_s, "peak_bytes": ours.peak_bytes},
    }
