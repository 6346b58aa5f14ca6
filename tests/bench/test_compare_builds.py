"""bench/compare_builds.py: two equal builds are equal, and the least change is told."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

NBVOPT = os.environ["NBVOPT_CLI"]
SCRIPT = Path(__file__).resolve().parent.parent.parent / "bench" / "compare_builds.py"
CHECKS = "^(query, all outputs|map convert o.ot|refuses nbvopt serve|map --help)$"


def compare(new: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, SCRIPT, NBVOPT, new, "--only", CHECKS], capture_output=True, text=True
    )


class CompareBuildsTest(unittest.TestCase):
    def spoilt(self, after: str) -> str:
        """A build whose program does as nbvopt does, then runs this shell code on what it wrote."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        program = folder / "nbvopt"
        program.write_text(f"#!/bin/sh\n'{NBVOPT}' \"$@\"\ncode=$?\n{after}\nexit $code\n")
        program.chmod(0o700)
        return str(program)

    def assert_differs(self, new: str, *checks: str):
        result = compare(new)
        told = [line for line in result.stdout.splitlines() if line.startswith("DIFFERS")]
        self.assertEqual([line.split()[1] for line in told], [c.split()[0] for c in checks])
        self.assertEqual(result.returncode, 1, result.stderr)

    def test_a_build_is_equal_to_itself(self):
        result = compare(NBVOPT)
        self.assertEqual(result.stdout.splitlines()[-1], "4 equal, 0 differ, 0 skipped")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_digit_is_told(self):
        digit = r"""sed -i '3s/"gain":\([0-9.]*\)[0-8],/"gain":\19,/' trace.jsonl"""
        self.assert_differs(self.spoilt(f"test -e trace.jsonl && {digit}"), "query,")

    def test_a_byte_of_a_map_is_told(self):
        byte = "test -e o.ot && printf x | dd of=o.ot bs=1 seek=5000 conv=notrunc 2> /dev/null"
        self.assert_differs(self.spoilt(byte), "map convert")

    def test_a_file_more_and_an_exit_code_are_told(self):
        self.assert_differs(self.spoilt("test -e view.png && : > more"), "query,")
        self.assert_differs(self.spoilt("test $code = 2 && code=3"), "refuses")

    def test_nothing_to_compare_is_no_success(self):
        result = subprocess.run(
            [sys.executable, SCRIPT, NBVOPT, NBVOPT, "--only", "^none$"], capture_output=True
        )
        self.assertEqual(result.returncode, 2)


if __name__ == "__main__":
    unittest.main()
