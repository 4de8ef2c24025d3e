#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""A real drive: KITTI raw 2011_09_26 drive 0005 with 16 rings, with neither rig nor flags beyond the folder."""

import lzma
import shutil
import unittest

from program import DATA, ProgramTest, call, evaluate, read_tum, skip_all

DATE = DATA / "kitti_raw" / "2011_09_26"
DRIVE = "2011_09_26_drive_0005_sync"


class Kitti(ProgramTest):
    def unpack(self):
        drive = self.folder / "2011_09_26" / DRIVE
        shutil.copytree(DATE, self.folder / "2011_09_26", copy_function=shutil.copyfile,
                        ignore=shutil.ignore_patterns("*.xz"))
        points = drive / "velodyne_points" / "data"
        points.mkdir(parents=True, exist_ok=True)
        for packed in sorted((DATE / DRIVE / "velodyne_points" / "data").glob("*.xz")):
            (points / packed.stem).write_bytes(lzma.decompress(packed.read_bytes()))
        return drive

    def test_the_whole_drive_is_within_a_metre_of_the_poor_truth(self):
        out = self.folder / "run"
        result = call("run", self.unpack(), "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("below 50 Hz", result.stderr)
        poses = read_tum(out / "trajectory.tum")
        self.assertEqual(len(poses), 154)
        self.assertEqual(poses[0][0], 0.0)
        metrics = evaluate(DATA / "kitti_raw" / "ground_truth_position.tum", out / "trajectory.tum")
        self.assertEqual(metrics["matched"], 154)
        self.assertLess(metrics["ape"]["rmse"], 1.0)
        # The public lidar odometries have 0.16 m against this truth, which is the better one.
        metrics = evaluate(DATA / "kitti_raw" / "ground_truth_velocity_sweep_end.tum", out / "trajectory.tum")
        self.assertLess(metrics["ape"]["rmse"], 0.20)

    def test_lego_loam_is_no_crippled_baseline(self):
        out = self.folder / "run_lego_loam"
        result = call("run", self.unpack(), "--pipeline", "lego_loam", "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(read_tum(out / "trajectory.tum")), 154)
        metrics = evaluate(DATA / "kitti_raw" / "ground_truth_velocity_sweep_end.tum", out / "trajectory.tum")
        self.assertLess(metrics["ape"]["rmse"], 0.25)


if __name__ == "__main__":
    if not DATE.is_dir():
        skip_all(f"no real recordings at {DATA}; set REGOLITH_DATA")
    unittest.main()
