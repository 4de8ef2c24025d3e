#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Features tracked through a recording by `run`: what status.csv and summary.json say of them, and masks."""

import csv
import json
import shutil
import struct
import unittest
import zlib

from program import RECORDING, ProgramTest, call

NEW_COLUMNS = ["detected_features", "recovered_features", "rejected_features", "new_features", "mean_age", "cells",
               "cells_filled", "threshold_rounds", "threshold_min", "threshold_median", "threshold_max"]


def write_mask(path, width, height, first_masked_row):
    """A grey PNG: 255 above the row, 0 from it on."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes([255 if row < first_masked_row else 0]) * width for row in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) +
                     chunk(b"IEND", b""))


class Features(ProgramTest):
    def run_with(self, name, *arguments):
        out = self.folder / name
        result = call("run", RECORDING, "--out", out, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        with (out / "status.csv").open() as table:
            rows = list(csv.DictReader(table))
        images = [row for row in rows if row["leader"] == "camera"]
        return out, images, [row for row in rows if row["leader"] != "camera"]

    def test_status_and_summary_tell_of_every_image(self):
        out, images, scans = self.run_with("orb", "--features", "orb")
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["frames"], len(images))
        self.assertGreater(len(images), 390)
        self.assertEqual(len(scans), 400)
        for column in NEW_COLUMNS:
            self.assertEqual({scan[column] for scan in scans}, {""})
            for image in images:
                float(image[column])
        tracked = sorted(int(image["tracked_features"]) for image in images[1:])
        self.assertGreater(tracked[len(tracked) // 2], 120)
        self.assertGreater(max(int(image["recovered_features"]) for image in images), 10)
        for image in images[1:]:
            self.assertLessEqual(sum(int(image[key]) for key in
                                     ("tracked_features", "recovered_features", "new_features")), 500)
        stages = summary["stages"]
        for stage in ("features_extract_detect", "features_match", "features_reject", "image_total", "total"):
            self.assertIn(stage, stages)
        self.assertGreater(stages["image_total"]["median_ms"], stages["features_extract_detect"]["median_ms"])
        self.assertIn("Features", (out / "report.html").read_text())

    def test_without_visual_odometry_images_change_neither_trajectory_nor_map(self):
        without, images, _ = self.run_with("lio", "--pipeline", "lio", "--set", "lio.wheels=true")
        self.assertEqual(images, [])
        tracked, _, _ = self.run_with("st_lk", "--features", "st_lk", "--set", "visual=false")
        for name in ("trajectory.tum", "map.ply"):
            self.assertEqual((tracked / name).read_bytes(), (without / name).read_bytes(), name)

    def test_status_is_the_same_for_any_number_of_threads(self):
        for features in ("orb", "ghost"):
            with self.subTest(features=features):
                one, _, _ = self.run_with(f"one_{features}", "--features", features, "--threads", 1)
                two, _, _ = self.run_with(f"two_{features}", "--features", features, "--threads", 2)
                self.assertEqual((one / "status.csv").read_bytes(), (two / "status.csv").read_bytes())

    def test_a_mask_hides_the_rovers_parts(self):
        rig = self.folder / "rig.yaml"
        text = (RECORDING / "rig.yaml").read_text()
        self.assertEqual(text.count("  mono:\n"), 1)
        rig.write_text(text.replace("  mono:\n", "  mono:\n    mask: mono.png\n"))
        write_mask(self.folder / "mono.png", 640, 480, 100)
        _, images, _ = self.run_with("masked", "--features", "st_lk", "--rig", rig)
        # Of six rows of cells two reach above row 100.
        self.assertLessEqual(max(int(image["cells_filled"]) for image in images), 16)
        write_mask(self.folder / "mono.png", 320, 240, 100)
        command = ["run", RECORDING, "--features", "st_lk", "--rig", rig, "--out", self.folder / "refused"]
        self.assert_refused(call(*command), "mono.png", "320 × 240", "640 × 480")
        (self.folder / "mono.png").unlink()
        self.assert_refused(call(*command), "mono.png")

    def test_names_that_cannot_be(self):
        out = ["--out", self.folder / "refused"]
        self.assert_refused(call("run", RECORDING, "--features", "sift", *out), "sift", "ghost_lk")
        self.assert_refused(call("run", RECORDING, "--pipeline", "lio", "--features", "orb", *out), "tracked_camera")
        self.assert_refused(call("run", RECORDING, "--set", "tracked_camera=top", "--features", "orb", *out), "top")

    def test_a_recording_without_the_camera_runs_all_the_same(self):
        rig = self.folder / "rig.yaml"
        shutil.copyfile(RECORDING / "rig.yaml", rig)
        rig.write_text(rig.read_text().replace("/camera/mono/", "/camera/none/"))
        out, images, scans = self.run_with("blind", "--features", "orb", "--rig", rig)
        self.assertEqual(images, [])
        self.assertEqual(len(scans), 400)
        notices = json.loads((out / "summary.json").read_text())["notices"]
        self.assertTrue(any("/camera/none/" in notice for notice in notices), notices)


if __name__ == "__main__":
    unittest.main()
