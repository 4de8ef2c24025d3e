#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""`reproduce`: killed in the middle it goes on, a failed cell takes no other down, tables and figures are there.

With REGOLITH_LONG_TESTS also the whole of --scale short, within its 15 minutes.
"""

import csv
import json
import os
import signal
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest, call, processor_seconds

QUICK = ("--duration", "6", "--quality", "draft", "--pairs", "0", "--methods", "lio,wheels,kiss_icp",
         "--python", "/nowhere/python")  # fmt: skip


class Reproduce(ProgramTest):
    def test_wrong_arguments_are_refused(self):
        out = self.folder / "out"
        self.assert_refused(call("reproduce", "--scale", "tiny", "--out", out), "--scale", "short or full")
        self.assert_refused(call("reproduce", "--methods", "lio,magic", "--out", out), "magic", "lego_loam")
        self.assert_refused(call("reproduce", "--seeds", "0", "--out", out), "--seeds")
        out.mkdir()
        (out / "mine.txt").write_text("keep")
        self.assert_refused(call("reproduce", "--out", out), "not empty")
        (out / "plan.yaml").write_text("scale: full\n")
        self.assert_refused(call("reproduce", "--out", out), "plan.yaml", "another reproduction")

    def test_killed_in_the_middle_it_goes_on(self):
        out = self.folder / "out"
        command = [PROGRAM, "reproduce", *QUICK, "--out", out]
        first = out / "cells" / "lunar_short_1" / "lio" / "metrics.json"
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            while not first.exists() and process.poll() is None:
                time.sleep(0.1)
            process.send_signal(signal.SIGKILL)
        self.assertTrue(first.exists())
        self.assertFalse((out / "cells" / "mars_short_1" / "lio").exists())
        made = first.stat().st_mtime_ns

        result = call("reproduce", *QUICK, "--out", out, timeout=900)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(first.stat().st_mtime_ns, made)
        for scenario in ("lunar_short_1", "mars_short_1"):
            folder = out / "cells" / scenario
            self.assertFalse((folder / "recording").exists())
            for method in ("lio", "wheels"):
                metrics = json.loads((folder / method / "metrics.json").read_text())
                self.assertLess(metrics["ape"]["rmse"], 1.0)
                self.assertTrue(json.loads((folder / method / "summary.json").read_text())["complete"])
        tables = (out / "tables.md").read_text()
        for word in ("| lio |", "machine:", "command:", "KISS-ICP", "not installed for /nowhere/python"):
            self.assertIn(word, tables)
        page = (out / "report.html").read_text()
        for word in ("Table 2", "Figure 12", "Figure 13", "data:image/png;base64,"):
            self.assertIn(word, page)
        with open(out / "cells.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 6)
        for row in rows:
            self.assertEqual(row["method"] == "kiss_icp", row["failure"] != "", row)

        # What is finished is not made again, and takes no time.
        start = time.monotonic()
        self.assertEqual(call("reproduce", *QUICK, "--out", out).returncode, 0)
        self.assertLess(time.monotonic() - start, 60.0)
        self.assertEqual(first.stat().st_mtime_ns, made)

    @unittest.skipUnless(os.environ.get("REGOLITH_LONG_TESTS"), "15 minutes")
    def test_the_short_scale_ends_within_its_time(self):
        out = self.folder / "short"
        # 15 minutes of both cores.
        start = processor_seconds()
        result = call("reproduce", "--scale", "short", "--out", out, timeout=2400)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(processor_seconds() - start, 2 * 900.0)
        with open(out / "cells.csv", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                self.assertTrue(row["ape_rmse_m"] or row["failure"], row)


if __name__ == "__main__":
    unittest.main()
