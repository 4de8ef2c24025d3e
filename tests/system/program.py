# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Calls the program as a user does, and makes recordings that are wrong in one way each."""

import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("REGOLITH_PROGRAM", str(ROOT / "build/release/regolith"))
RECORDING = pathlib.Path(os.environ.get("REGOLITH_TEST_RECORDING", ROOT / "build/release/test_data/lunar_short"))
DATA = pathlib.Path(os.environ.get("REGOLITH_DATA", ROOT / "../shared/data"))
SKIPPED = 77


def call(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False,
                          timeout=options.pop("timeout", 600), **options)


def read_tum(path):
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    return [[float(word) for word in line.split()] for line in lines if not line.startswith("#")]


def evaluate(reference, estimate):
    with tempfile.TemporaryDirectory() as out:
        result = call("evaluate", "--reference", reference, "--estimate", estimate, "--out", out)
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        return json.loads(pathlib.Path(out, "metrics.json").read_text(encoding="utf-8"))


def processor_seconds():
    """Of the ended child processes and theirs, whatever runs beside the test."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def skip_all(reason):
    """Ends the test program so that ctest lists it as skipped."""
    print(f"SKIPPED: {reason}", file=sys.stderr)
    sys.exit(SKIPPED)


class ProgramTest(unittest.TestCase):
    """Gives each test a folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="regolith_test_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def assert_refused(self, result, *words, code=2):
        """One clear line on standard error that holds the words, the exit code, no crash."""
        self.assertEqual(result.returncode, code, result.stderr + result.stdout)
        errors = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
        self.assertEqual(len(errors), 1, result.stderr)
        for word in words:
            self.assertIn(word, errors[0])
