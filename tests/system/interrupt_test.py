#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C, a full disk, an output that cannot be written: what is there stays valid, and is marked."""

import json
import resource
import signal
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest, RECORDING, call, processor_seconds, read_tum


def interrupt(arguments, ready, seconds=60.0):
    """Starts the program, sends Ctrl-C once ready() holds, and gives its exit code."""
    with subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        deadline = time.monotonic() + seconds
        while not ready() and time.monotonic() < deadline and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=120)
        return process.returncode


class Interrupt(ProgramTest):
    def test_run_keeps_what_it_has(self):
        out = self.folder / "run"
        start = time.monotonic()
        code = interrupt(["run", RECORDING, "--rate", 1, "--out", out], lambda: time.monotonic() - start > 6.0)
        self.assertEqual(code, 130)
        summary = json.loads((out / "summary.json").read_text())
        self.assertFalse(summary["complete"])
        self.assertFalse((out / "trajectory.tum").exists())
        poses = read_tum(out / "trajectory.partial.tum")
        self.assertGreater(len(poses), 10)
        self.assertLess(len(poses), 100)
        for name in ("odometry.partial.tum", "map.partial.ply", "status.partial.csv", "timing.partial.csv"):
            self.assertGreater((out / name).stat().st_size, 50, name)

    def test_simulate_keeps_what_it_has(self):
        out = self.folder / "recording"
        code = interrupt(["simulate", "--scenario", "lunar_short", "--out", out],
                         lambda: any(file.stat().st_size > 5_000_000 for file in out.glob("*bag*")), 120.0)
        self.assertEqual(code, 130)
        self.assertFalse((out / "recording.bag").exists())
        result = call("info", out / "recording.partial.bag")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("/velodyne_points", result.stdout)
        self.assertGreater(len(read_tum(out / "ground_truth.partial.tum")), 10)

    def test_a_full_disk_is_said_and_nothing_looks_complete(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

        for arguments in (["run", RECORDING], ["simulate", "--scenario", "lunar_short", "--duration", 5]):
            out = self.folder / arguments[0]
            result = call(*arguments, "--out", out, preexec_fn=limit)
            self.assert_refused(result, str(out), code=1)
            self.assertFalse((out / "map.ply").exists())
            self.assertFalse((out / "recording.bag").exists())
            self.assertFalse((out / "summary.json").exists())

    def test_an_output_that_cannot_be_written_is_refused_before_any_work(self):
        start = processor_seconds()
        for arguments, out in ((["run", RECORDING], "/proc/regolith"),
                               (["simulate", "--scenario", "lunar_short"], "/dev/null/x")):
            result = call(*arguments, "--out", out)
            self.assert_refused(result, f"--out {out}")
            self.assertEqual(len(result.stderr.splitlines()), 1, "work is announced: " + result.stderr)
        self.assertLess(processor_seconds() - start, 10.0)


if __name__ == "__main__":
    unittest.main()
