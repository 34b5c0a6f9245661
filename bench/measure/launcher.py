"""Compiler launcher for ninja: runs a compiler and appends a line to the file that MOTIONRACK_COMPILATIONS names, with
CPU seconds, peak resident bytes and the source. Imports little, as it starts once for each compilation:

    launcher.py COMPILER ARGUMENTS...
"""
import os
import sys


def main(argv: list[str]) -> int:
    """Returns the compiler's exit code. Writes no line if the compiler fails or is not called with -c."""
    pid = os.posix_spawnp(argv[0], argv, os.environ)
    _, status, usage = os.wait4(pid, 0)  # includes the compiler proper and the assembler, for which the driver waited
    code = os.waitstatus_to_exitcode(status)
    log = os.environ.get("MOTIONRACK_COMPILATIONS")
    if log and code == 0 and "-c" in argv:
        with open(log, "a", encoding="utf-8", errors="surrogateescape") as file:
            cpu_s = usage.ru_utime + usage.ru_stime
            file.write(f"{cpu_s:.6f}\t{1024 * usage.ru_maxrss}\t{argv[argv.index('-c') + 1]}\n")
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
