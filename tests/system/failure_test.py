#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sensors that die for ten seconds and come back, or were never there: the others carry on, and say so."""

import csv
import json
import unittest

from program import RECORDING, ProgramTest, call, evaluate

# Per cent of the distance, from before a gap to after it; asked of `lunar` and `mars` is 0.3.
BOUND = 0.3


class Failure(ProgramTest):
    def run_regolith(self, *arguments):
        out = self.folder / "run"
        result = call("run", RECORDING, "--features", "st_lk", "--out", out, "--overwrite", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = json.loads((out / "summary.json").read_text())
        with (out / "status.csv").open() as table:
            rows = list(csv.DictReader(table))
        metrics = evaluate(RECORDING / "ground_truth.tum", out / "trajectory.tum")
        self.assertEqual(summary["resets"], 0)
        self.assertEqual(summary["coverage"], 1.0)
        return metrics["percent_of_distance"], rows, summary

    def states_between(self, rows, sensor, begin, end):
        start = float(rows[0]["time_s"])
        return {row[sensor] for row in rows if begin < float(row["time_s"]) - start < end}

    def test_each_sensor_may_die_for_ten_seconds(self):
        for topic, sensor in (("/velodyne_points", "lidar"), ("mono", "camera"), ("/odom", "wheels"), ("/imu/data", "imu")):
            with self.subTest(sensor=sensor):
                percent, rows, _ = self.run_regolith("--drop", f"{topic}:15:25")
                self.assertLess(percent, BOUND)
                if sensor != "imu":
                    self.assertEqual(self.states_between(rows, sensor, 16.5, 24), {"silent"})
                self.assertEqual(rows[-1][sensor], "good")
                self.assertEqual(rows[-1]["led_by"], "lidar")

    def test_the_camera_leads_where_there_are_no_scans(self):
        _, rows, summary = self.run_regolith("--drop", "/velodyne_points:15:25")
        self.assertEqual(self.states_between(rows, "led_by", 16.5, 24), {"camera"})
        self.assertTrue(any(notice.startswith("led by: ") for notice in summary["notices"]), summary["notices"])
        without = [row for row in rows if row["leader"] == "camera+imu"]
        self.assertGreater(len(without), 80)

    def test_imu_and_wheels_bridge_camera_and_lidar_both(self):
        percent, rows, _ = self.run_regolith("--drop", "/velodyne_points:10:25", "--drop", "mono:10:25")
        self.assertLess(percent, 2.0)
        self.assertEqual(self.states_between(rows, "led_by", 11.5, 24), {"wheels"})

    def test_an_imu_that_comes_late_is_taken_up(self):
        _, rows, summary = self.run_regolith("--drop", "/imu/data:0:15")
        # Images wait for the IMU, so their rows tell of later.
        rows = [row for row in rows if row["leader"] != "camera"]
        self.assertEqual(self.states_between(rows, "imu", 4, 14), {"absent"})
        self.assertEqual(rows[-1]["imu"], "good")
        self.assertEqual({row["leader"] for row in rows[-200:]}, {"lidar+imu"})
        self.assertTrue(any("the first scans went without it" in notice for notice in summary["notices"]), summary["notices"])

    def test_a_rig_without_a_lidar_is_served_by_the_camera(self):
        text = (RECORDING / "rig.yaml").read_text()
        rig = self.folder / "rig.yaml"
        rig.write_text(text[:text.index("lidar:")] + text[text.index("cameras:"):])
        percent, rows, summary = self.run_regolith("--rig", rig)
        self.assertLess(percent, 1.0)
        self.assertEqual(rows[-1]["led_by"], "camera")
        self.assertTrue(any("no lidar" in notice for notice in summary["notices"]), summary["notices"])


if __name__ == "__main__":
    unittest.main()
