"""Test that the program and the libraries are built with protection against the exploitation of memory errors:
hardened.py PROGRAM LIBRARY...

    readelf ─► position-independent code, RELRO, BIND_NOW, no executable stack, stack protector
            └► of the PROGRAM also: PIE, FORTIFY, assertions of the C++ library
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys


def read(options: str, file: str) -> str:
    return subprocess.run(["readelf", "--wide", *options.split(), file], capture_output=True, text=True).stdout


def problems_of(file: str, is_program: bool) -> list[str]:
    head, segments, dynamic, symbols = (read(options, file) for options in ("-h", "-l", "-d", "--dyn-syms"))
    stack = re.search(r"GNU_STACK.*", segments)
    checks = {
        "is not position-independent": re.search(r"Type:\s+DYN", head) is not None,
        "has no RELRO segment": "GNU_RELRO" in segments,
        "is not bound at its start (BIND_NOW)": re.search(r"BIND_NOW|FLAGS_1.*\bNOW\b", dynamic) is not None,
        "has a stack that can be executed": stack is not None and "E" not in stack.group(0).split()[-2],
        "has no stack protector": "__stack_chk_fail" in symbols,
    }
    if is_program:
        checks["is not a position-independent executable"] = re.search(r"FLAGS_1.*\bPIE\b", dynamic) is not None
        checks["has no function of FORTIFY"] = (
            re.search(r"__(memcpy|read|recv|snprintf|vsnprintf|memmove)_chk", symbols) is not None
        )
        checks["has no assertions of the C++ library"] = "__glibcxx_assert_fail" in symbols
    return [f"{file}: {problem}" for problem, good in checks.items() if not good]


def main() -> int:
    if shutil.which("readelf") is None:
        print("readelf is missing (Debian package binutils); nothing was tested")
        return 77
    problems = [one for at, file in enumerate(sys.argv[1:]) for one in problems_of(file, at == 0)]
    print("\n".join(problems) or f"{len(sys.argv) - 1} files are hardened")
    return 1 if problems else 0


sys.exit(main())
