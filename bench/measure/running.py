"""Runs of programs with their wall time, CPU time and peak memory, and the display of progress."""
import os
import re
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple


class Trouble(Exception):
    """Failure of a measurement; its text is a sentence for the user."""


class Ran(NamedTuple):
    out: str
    wall_s: float
    cpu_s: float
    peak_bytes: int


def say(text: str) -> None:
    print(f"bench/page: {text}", file=sys.stderr, flush=True)


class Progress:
    """Progress of a known number of steps: `step` prints the current one and how many are left."""

    def __init__(self, steps: int):
        self._steps, self._done, self._begin = steps, 0, time.monotonic()

    def step(self, what: str) -> None:
        self._done += 1
        minutes = (time.monotonic() - self._begin) / 60
        say(f"[{self._done}/{self._steps}] {what} ({minutes:.0f} min so far, {self._steps - self._done} steps left)")

    @staticmethod
    def within(text: str) -> None:
        """Writes over one line of the terminal; prints nothing elsewhere."""
        if sys.stderr.isatty():
            print(f"\r\033[K  {text}", end="", file=sys.stderr, flush=True)

    @staticmethod
    def end_within() -> None:
        if sys.stderr.isatty():
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def peak_of(pid: int) -> int:
    """Returns the peak resident memory of a running process so far, in bytes; 0 if it has ended."""
    try:
        found = re.search(
            r"VmHWM:\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text(encoding="ascii", errors="replace")
        )
    except OSError:
        return 0
    return int(found[1]) * 1024 if found else 0


def run(
    argv: list[str],
    *,
    cwd: str | Path | None = None,
    codes: tuple[int, ...] = (0,),
    limit_s: float = 1800,
    env: dict[str, str] | None = None,
    memory: bool = True,
) -> Ran:
    """Runs a program to its end. Raises Trouble if its exit code is not in `codes` or it takes longer than `limit_s`.

    The kernel's peak memory of a child includes this Python process before exec, so it counts only above Python's own
    peak; the memory of smaller programs is sampled every 2 ms while they run (`memory`).
    """
    begin = time.monotonic()
    with subprocess.Popen(
        argv, cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=env
    ) as process:
        assert process.stdout
        os.set_blocking(process.stdout.fileno(), False)
        parts: list[bytes] = []
        peak = 0
        while True:
            parts.append(process.stdout.read() or b"")
            if memory:
                peak = max(peak, peak_of(process.pid))
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - begin > limit_s:
                process.send_signal(signal.SIGKILL)
                too_long = f"{argv[0]} took more than {limit_s:g} s and was ended."
                os.wait4(process.pid, 0)
                process.returncode = -9
                raise Trouble(too_long)
            time.sleep(0.002 if memory else 0.02)
        wall = time.monotonic() - begin
        parts.append(process.stdout.read() or b"")
        process.returncode = os.waitstatus_to_exitcode(status)
    out = b"".join(parts).decode("utf-8", "replace")
    if process.returncode not in codes:
        raise Trouble(f"{' '.join(argv)} ended with code {process.returncode}:\n{out[-2000:]}")
    if usage.ru_maxrss > resource.getrusage(resource.RUSAGE_SELF).ru_maxrss:
        peak = usage.ru_maxrss * 1024
    return Ran(out, wall, usage.ru_utime + usage.ru_stime, peak)


def best_of(times: int, argv: list[str], **how) -> Ran:
    """Runs a program several times; returns the run with the least CPU time, with the highest peak memory of all."""
    runs = [run(argv, **how) for _ in range(times)]
    return min(runs, key=lambda ran: ran.cpu_s)._replace(peak_bytes=max(ran.peak_bytes for ran in runs))
