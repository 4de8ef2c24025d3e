#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Visual–inertial odometry: a real flight, the short lunar traverse, and a camera that goes dark."""

import csv
import json
import unittest

from program import DATA, RECORDING, ProgramTest, call, evaluate, read_tum

EUROC = DATA / "euroc_mh01"
EUROC_TRUTH = EUROC / "mav0/state_groundtruth_estimate0/groundtruth.tum"


class Vio(ProgramTest):
    def run_vio(self, recording, *arguments):
        out = self.folder / "run"
        result = call("run", recording, "--pipeline", "vio", "--out", out, "--overwrite", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return out, json.loads((out / "summary.json").read_text())

    def scale_of(self, reference, estimate):
        out = self.folder / "sim3"
        result = call("evaluate", "--reference", reference, "--estimate", estimate, "--align", "sim3", "--out", out,
                      "--overwrite")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads((out / "metrics.json").read_text())["scale"]

    @unittest.skipUnless(EUROC.exists(), f"SKIPPED: {EUROC} is absent (REGOLITH_DATA)")
    def test_a_flight_is_followed_from_its_folder_alone(self):
        for features in ("st_lk", "ghost"):
            out, summary = self.run_vio(EUROC, "--features", features)
            metrics = evaluate(EUROC_TRUTH, out / "trajectory.tum")
            self.assertLess(metrics["ape"]["rmse"], 0.03, features)
            self.assertGreaterEqual(summary["coverage"], 0.75, features)
            self.assertEqual(summary["resets"], 0, features)
            self.assertAlmostEqual(self.scale_of(EUROC_TRUTH, out / "trajectory.tum"), 1.0, delta=0.05)

    def test_a_camera_and_an_imu_follow_the_lunar_traverse(self):
        out, summary = self.run_vio(RECORDING)
        metrics = evaluate(RECORDING / "ground_truth.tum", out / "trajectory.tum")
        self.assertLess(metrics["percent_of_distance"], 1.0)
        self.assertEqual(summary["coverage"], 1.0)
        self.assertEqual(summary["resets"], 0)
        self.assertGreater(summary["keyframes"], 10)
        self.assertEqual(len(read_tum(out / "trajectory.tum")), 400)
        with (out / "status.csv").open() as table:
            rows = list(csv.DictReader(table))
        self.assertEqual(rows[20]["at_rest"], "1")
        # The camera's stamps are 4 ms late, which no file says.
        self.assertAlmostEqual(float(rows[-1]["time_offset_s"]), -0.004, delta=0.001)

    def test_wheels_and_a_second_eye_help(self):
        for option in ("vio.wheels=true", "vio.stereo=true"):
            out, _ = self.run_vio(RECORDING, "--set", option)
            metrics = evaluate(RECORDING / "ground_truth.tum", out / "trajectory.tum")
            self.assertLess(metrics["percent_of_distance"], 0.7, option)

    def test_five_seconds_without_images_are_bridged(self):
        out, summary = self.run_vio(RECORDING, "--set", "vio.wheels=true", "--drop", "mono:15:20")
        self.assertEqual(summary["coverage"], 1.0)
        self.assertEqual(summary["resets"], 0)
        with (out / "status.csv").open() as table:
            health = [row["health"] for row in csv.DictReader(table)]
        self.assertIn("few features", health)
        self.assertEqual(health[-1], "good")
        metrics = evaluate(RECORDING / "ground_truth.tum", out / "trajectory.tum")
        self.assertLess(metrics["percent_of_distance"], 2.0)

    def test_a_rig_that_lacks_a_sensor_is_refused(self):
        self.assert_refused(call("run", RECORDING, "--pipeline", "vio", "--set", "tracked_camera=tail", "--out",
                                 self.folder / "run"), "tracked_camera")
        rig = self.folder / "rig.yaml"
        text = (RECORDING / "rig.yaml").read_text()
        self.assertEqual(text.count("baseline"), 0)
        rig.write_text(text[:text.index("imu:")] + text[text.index("lidar:"):])
        self.assert_refused(call("run", RECORDING, "--rig", rig, "--pipeline", "vio", "--out", self.folder / "run"),
                            "imu")


if __name__ == "__main__":
    unittest.main()
