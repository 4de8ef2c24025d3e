#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""The short lunar traverse, from the recording to the error, with every file that DESIGN §3 names."""

import csv
import json
import unittest

from program import RECORDING, ProgramTest, call, evaluate, read_tum


class LunarShort(ProgramTest):
    def test_recording_holds_all_files(self):
        for name in ("recording.bag", "rig.yaml", "ground_truth.tum", "scenario.yaml", "terrain.tif", "preview.png"):
            self.assertGreater((RECORDING / name).stat().st_size, 100, name)

    def test_trajectory_is_within_a_tenth_of_a_metre_of_truth(self):
        out = self.folder / "run"
        result = call("run", RECORDING, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        for word in ("distance", "APE RMSE", "real-time factor", "report"):
            self.assertIn(word, result.stdout)
        metrics = evaluate(RECORDING / "ground_truth.tum", out / "trajectory.tum")
        self.assertGreater(metrics["length_m"], 14.0)
        self.assertLess(metrics["ape"]["rmse"], 0.10)

        summary = json.loads((out / "summary.json").read_text())
        self.assertTrue(summary["complete"])
        self.assertEqual(summary["scans"], 400)
        self.assertEqual(summary["coverage"], 1.0)
        self.assertLess(summary["peak_rss_mb"], 1000.0)
        for key in ("pipeline", "recording_seconds", "wall_seconds", "real_time_factor", "cpu_seconds", "frames",
                    "keyframes", "loops_accepted", "loops_rejected", "resets"):
            self.assertIn(key, summary)
        for stage in summary["stages"].values():
            self.assertLessEqual(stage["median_ms"], stage["p99_ms"])

        self.assertEqual(len(read_tum(out / "trajectory.tum")), 400)
        self.assertEqual(len(read_tum(out / "odometry.tum")), 400)
        with (out / "status.csv").open() as table:
            rows = list(csv.DictReader(table))
        images = [row for row in rows if row["leader"] == "camera"]
        rows = [row for row in rows if row["leader"] != "camera"]
        self.assertEqual(len(rows), 400)
        self.assertEqual(len(images), summary["frames"])
        self.assertGreater(len(images), 390)
        self.assertGreater(min(int(row["tracked_features"]) for row in images[1:]), 50)
        self.assertEqual(rows[-1]["leader"], "lidar+imu")
        self.assertEqual(rows[20]["at_rest"], "1")
        for name, least in (("map.ply", 100_000), ("timing.csv", 1000), ("config.yaml", 500), ("report.html", 100_000)):
            self.assertGreater((out / name).stat().st_size, least, name)
        self.assertEqual(list(out.glob("*.partial.*")), [])

    def test_frame_and_drop_do_what_they_say(self):
        out = self.folder / "run"
        result = call("run", RECORDING, "--frame", "lidar", "--drop", "/velodyne_points:20:22", "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        # Scans, and poses of the other sensors from half a second of silence on.
        self.assertEqual(json.loads((out / "summary.json").read_text())["scans"], 380)
        self.assertEqual(len(read_tum(out / "trajectory.tum")), 396)
        with (out / "status.csv").open() as table:
            self.assertEqual(sum(int(row["points"] or 0) > 0 for row in csv.DictReader(table)), 380)
        metrics = evaluate(RECORDING / "ground_truth.tum", out / "trajectory.tum")
        self.assertLess(metrics["ape"]["rmse"], 0.30)

    def test_an_existing_result_is_not_overwritten_by_chance(self):
        out = self.folder / "run"
        out.mkdir()
        (out / "mine.txt").write_text("keep")
        self.assert_refused(call("run", RECORDING, "--out", out), "--overwrite")
        self.assertEqual((out / "mine.txt").read_text(), "keep")

    def test_info_says_that_the_rig_fits(self):
        result = call("info", RECORDING)
        self.assertEqual(result.returncode, 0, result.stderr)
        for word in ("/velodyne_points", "/imu/data", "200", "the rig fits"):
            self.assertIn(word, result.stdout)


if __name__ == "__main__":
    unittest.main()
