#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Adaptive thresholds on simulated sequences of Moon and Mars: as many keypoints as asked for, in every frame, wherever ground is lit."""

import csv
import json
import unittest

import numpy
from PIL import Image

from camera_frames import read_frames
from program import RECORDING, ProgramTest, call

ASKED = 500
COLUMNS, ROWS = 8, 6  # of cells of 80 pixels
SECONDS = 8
FRAMES = 8  # looked at closely, of each sequence


def lit_cells(image, elevation, darkest):
    """Cells of which at least half shows ground (below the horizontal by 2 degrees) brighter than a grey level."""
    lit = (elevation < -2.0) & (image > darkest)
    height, width = lit.shape
    return lit.reshape(ROWS, height // ROWS, COLUMNS, width // COLUMNS).mean(axis=(1, 3)) >= 0.5


class Adaptive(ProgramTest):
    def test_moon(self):
        self.check(RECORDING, darkest=25)

    def test_mars(self):
        recording = self.folder / "mars"
        result = call("simulate", "--scenario", "mars_short", "--duration", SECONDS, "--quality", "draft", "--quiet",
                      "--out", recording)  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        self.check(recording, darkest=40)

    def check(self, recording, darkest):
        out = self.folder / "run"
        result = call("run", recording, "--features", "ghost", "--quiet", "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        with (out / "status.csv").open(encoding="utf-8") as table:
            images = [row for row in csv.DictReader(table) if row["leader"] == "camera"]
        self.assertGreater(len(images), 10 * SECONDS - 5)
        counts = numpy.array([int(row["detected_features"]) for row in images])
        self.assertGreaterEqual((numpy.abs(counts - ASKED) <= 0.1 * ASKED).mean(), 0.95, counts)
        for row in images:
            self.assertLess(float(row["threshold_min"]), float(row["threshold_max"]))
        self.check_cells(recording, darkest)

    def check_cells(self, recording, darkest):
        frames = read_frames(recording, every=10)
        frames = frames[:: max(1, len(frames) // FRAMES)]
        filled = lit = 0
        for index, (image, elevation) in enumerate(frames):
            picture, out = self.folder / f"{index}.png", self.folder / f"match_{index}"
            Image.fromarray(image).save(picture)
            result = call("match", picture, picture, "--features", "ghost", "--quiet", "--out", out)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(json.loads((out / "summary.json").read_text())["images"][0]["detection"]["cells"], ROWS * COLUMNS)
            with (out / "keypoints_1.csv").open(encoding="utf-8") as table:
                points = numpy.array([[float(row["x"]), float(row["y"])] for row in csv.DictReader(table)])
            held = numpy.zeros((ROWS, COLUMNS), dtype=bool)
            held[(points[:, 1] * ROWS / image.shape[0]).astype(int), (points[:, 0] * COLUMNS / image.shape[1]).astype(int)] = True
            wanted = lit_cells(image, elevation, darkest)
            filled, lit = filled + (held & wanted).sum(), lit + wanted.sum()
            black = (elevation > 5.0) & (image < 8)
            inside = black[numpy.rint(points[:, 1]).astype(int), numpy.rint(points[:, 0]).astype(int)]
            self.assertLessEqual(inside.mean(), 0.02, "keypoints in the black sky")
        self.assertGreater(lit, 10 * len(frames))
        self.assertGreaterEqual(filled / lit, 0.8)


if __name__ == "__main__":
    unittest.main()
