"""Tests of tests/unchanged, which leaves out unchanged tests: python3 -m unittest -v unchanged_test

The build has four handmade tests, each of which writes its name into a file when it runs.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

UNCHANGED = Path(__file__).with_name("unchanged")


class Unchanged(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "data").mkdir()
        (self.root / "data" / "golden.txt").write_text("1\n")
        (self.root / "data" / "source.cpp").write_text("int a;\n")
        lines = []
        for name, reads in {"reader": "data", "other": "more", "bad": "data", "silent": ""}.items():
            ended = f"test ! -e {self.root}/broken" if name == "bad" else "true"
            program = self.root / name
            program.write_text(f"#!/bin/sh\necho {name} >>{self.root}/ran\n{ended}\n")
            program.chmod(0o755)
            lines.append(f'add_test({name} "{program}")')
            if reads:
                (self.root / reads).mkdir(exist_ok=True)
                lines.append(f'set_tests_properties({name} PROPERTIES REQUIRED_FILES "{self.root / reads}")')
        (self.root / "CTestTestfile.cmake").write_text("\n".join(lines) + "\n")

    def ran(self, *options: str, code: int = 0, **variables: str) -> set[str]:
        """Runs the tests; returns the names of those that ran."""
        log = self.root / "ran"
        log.unlink(missing_ok=True)
        environment = {**os.environ, "RC_PARAMS": "seed=1", **variables}
        done = subprocess.run([UNCHANGED, self.root, *options], env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.said = done.stderr
        return set(log.read_text().split()) if log.exists() else set()

    def test_only_a_test_that_does_not_say_what_it_reads_runs_again(self) -> None:
        self.assertEqual(self.ran(), {"reader", "other", "bad", "silent"})
        self.assertEqual(self.ran(), {"silent"})
        self.assertIn("3 of 4 tests were not run again", self.said)

    def test_a_changed_file_brings_its_readers_back(self) -> None:
        self.ran()
        (self.root / "data" / "golden.txt").write_text("2\n")
        self.assertEqual(self.ran(), {"reader", "bad", "silent"})
        (self.root / "data" / "new.txt").write_text("")
        self.assertEqual(self.ran(), {"reader", "bad", "silent"})
        (self.root / "data" / "new.txt").unlink()
        self.assertEqual(self.ran(), {"reader", "bad", "silent"}, "the last run had other files")

    def test_a_changed_source_counts_by_the_program_it_is_compiled_into(self) -> None:
        self.ran()
        (self.root / "data" / "source.cpp").write_text("int b;\n")
        self.assertEqual(self.ran(), {"silent"})
        program = self.root / "other"
        program.write_text(program.read_text() + "# new\n")
        self.assertEqual(self.ran(), {"other", "silent"})

    def test_a_test_that_failed_runs_until_it_passes(self) -> None:
        (self.root / "broken").touch()
        self.assertIn("bad", self.ran(code=8))
        self.assertEqual(self.ran(code=8), {"bad", "silent"})
        (self.root / "broken").unlink()
        self.assertEqual(self.ran(), {"bad", "silent"})
        self.assertEqual(self.ran(), {"silent"})

    def test_another_seed_or_command_is_another_test(self) -> None:
        self.ran()
        self.assertEqual(self.ran(RC_PARAMS="seed=2"), {"reader", "other", "bad", "silent"})
        self.assertEqual(self.ran(RC_PARAMS="seed=2", MOTIONRACK_SEED="3"), {"reader", "other", "bad", "silent"})

    def test_a_damaged_memory_is_none(self) -> None:
        self.ran()
        for damaged in ("", "[]", "{"):
            (self.root / "passed.json").write_text(damaged)
            self.assertEqual(self.ran(), {"reader", "other", "bad", "silent"})

    def test_options_choose_as_with_ctest(self) -> None:
        self.assertEqual(self.ran("-R", "^(reader|silent)$"), {"reader", "silent"})
        self.assertEqual(self.ran(), {"other", "bad", "silent"})


if __name__ == "__main__":
    unittest.main()
