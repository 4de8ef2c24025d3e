#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scores frontends between frames of a simulated recording: matches found, and their distance from the true epipolar line.

usage: score_frames.py RECORDING [--gaps 1 5 10] [--count 12] [--features NAME...] [--set KEY=VALUE]...

The truth is the recording's own (ground_truth.tum, rig.yaml); distances are in pixels of the undistorted image, 0.5 % at its edge.
"""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy
from PIL import Image
from ruamel.yaml import YAML
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, Slerp

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "system"))
from camera_frames import CAMERA_DELAY, bearings, decode, stamped_images  # noqa: E402
from program import read_tum  # noqa: E402

PROGRAM = ROOT / "build/release/regolith"


class Truth:
    """Poses of the camera in the world."""

    def __init__(self, folder, camera):
        poses = numpy.array(read_tum(folder / "ground_truth.tum"))
        self.rotation = Slerp(poses[:, 0], Rotation.from_quat(poses[:, 4:8]))
        self.position = CubicSpline(poses[:, 0], poses[:, 1:4])
        self.camera = numpy.array(camera["T_imu_camera"], dtype=float)

    def pose(self, time):
        body = numpy.eye(4)
        body[:3, :3], body[:3, 3] = self.rotation(time).as_matrix(), self.position(time)
        return body @ self.camera


def epipolar_errors(matches, directions, T_second_first, focal):
    """Mean of both images' distances from the epipolar lines, pixels."""
    def looked_up(points):
        columns = numpy.clip(points[:, 0], 0, directions.shape[1] - 1.001)
        rows = numpy.clip(points[:, 1], 0, directions.shape[0] - 1.001)
        left, top = columns.astype(int), rows.astype(int)
        u, v = (columns - left)[:, None], (rows - top)[:, None]
        mixed = ((1 - v) * ((1 - u) * directions[top, left] + u * directions[top, left + 1])
                 + v * ((1 - u) * directions[top + 1, left] + u * directions[top + 1, left + 1]))
        return mixed / mixed[:, 2:]

    first, second = looked_up(matches[:, :2]), looked_up(matches[:, 2:])
    t = T_second_first[:3, 3]
    cross = numpy.array([[0, -t[2], t[1]], [t[2], 0, -t[0]], [-t[1], t[0], 0]])
    essential = cross @ T_second_first[:3, :3]
    lines_second, lines_first = first @ essential.T, second @ essential
    product = numpy.abs((lines_second * second).sum(1))
    return focal * 0.5 * (product / numpy.linalg.norm(lines_second[:, :2], axis=1)
                          + product / numpy.linalg.norm(lines_first[:, :2], axis=1))


def match(features, images, settings):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, image in zip(("1.png", "2.png"), images):
            Image.fromarray(image).save(folder / name)
        subprocess.run([PROGRAM, "match", folder / "1.png", folder / "2.png", "--features", features, "--quiet",
                        *(f"--set={setting}" for setting in settings), "--out", folder / "out"], check=True)
        with open(folder / "out" / "matches.csv", encoding="utf-8") as file:
            rows = [[float(row[key]) for key in ("x1", "y1", "x2", "y2")] for row in csv.DictReader(file)
                    if row["inlier"] == "1"]
        return numpy.array(rows).reshape(-1, 4)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording", type=pathlib.Path)
    parser.add_argument("--gaps", nargs="+", type=int, default=[1, 5, 10])
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--features", nargs="+", default=["ghost", "ghost_lk", "ghost_paper", "superpoint", "orb", "st_lk"])
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()
    camera = YAML(typ="safe", pure=True).load(arguments.recording / "rig.yaml")["cameras"]["mono"]
    directions, truth = bearings(camera), Truth(arguments.recording, camera)
    frames = list(stamped_images(arguments.recording, "mono"))
    moving = [index for index in range(len(frames) - max(arguments.gaps)) if index > 40]
    starts = moving[:: max(1, len(moving) // arguments.count)][: arguments.count]
    print(f"{'':12} gap  found  error median  error 90 %  within 2 px")
    for features in arguments.features:
        for gap in arguments.gaps:
            errors, counts = [], []
            for start in starts:
                (first_time, first), (second_time, second) = frames[start], frames[start + gap]
                matches = match(features, (decode(first), decode(second)), arguments.set)
                counts.append(len(matches))
                relative = numpy.linalg.inv(truth.pose(second_time - CAMERA_DELAY)) @ truth.pose(first_time - CAMERA_DELAY)
                if len(matches):
                    errors.append(epipolar_errors(matches, directions, relative, camera["intrinsics"][0]))
            everything = numpy.concatenate(errors) if errors else numpy.full(1, numpy.nan)
            print(f"{features:12} {gap:3d} {numpy.median(counts):6.0f} {numpy.median(everything):13.3f} "
                  f"{numpy.quantile(everything, 0.9):11.3f} {100 * (everything < 2).mean():11.1f}%", flush=True)


if __name__ == "__main__":
    main()
