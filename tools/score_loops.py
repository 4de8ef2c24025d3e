#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scores the loops of runs on simulated recordings against the truth: errors of accepted ones, precision, and revisits found.

usage: score_loops.py RECORDING RUN [RECORDING RUN]...

A loop is wrong where its relative pose is off by more than 0.3 m or 3 degrees. Places lie 1 m of the drive apart. One is a revisit where the drive had been
within 2 m of it 30 s and 10 m before or longer; facing the old way within 30 degrees, or not. It is found where an accepted loop ends within 1 m of it.
"""

import csv
import pathlib
import sys

import numpy
from scipy.spatial.transform import Rotation, Slerp

WRONG_POSITION, WRONG_ANGLE = 0.3, 3.0  # m, degrees
PLACES_APART, REACH = 1.0, 2.0  # m
MIN_AGE, MIN_WAY = 30.0, 10.0  # s, m; of the back end's search
SAME_WAY = 30.0  # degrees


class Truth:
    """Poses of the body in the world, by time."""

    def __init__(self, path):
        poses = numpy.loadtxt(path)
        self.time, self.position = poses[:, 0], poses[:, 1:4]
        self.rotation = Slerp(self.time, Rotation.from_quat(poses[:, 4:8]))
        steps = numpy.linalg.norm(numpy.diff(self.position, axis=0), axis=1)
        self.way = numpy.concatenate([[0.0], numpy.cumsum(steps)])

    def position_at(self, time):
        return numpy.stack([numpy.interp(time, self.time, axis) for axis in self.position.T], axis=-1)

    def relative(self, old, new):
        turned = self.rotation(old).inv()
        return turned.apply(self.position_at(new) - self.position_at(old)), turned * self.rotation(new)

    def yaw(self, time):
        ahead = self.rotation(time).apply([1.0, 0.0, 0.0])
        return numpy.arctan2(ahead[:, 1], ahead[:, 0])


def errors_of(loops, truth):
    """Metres and degrees, one a loop."""
    errors = []
    for loop in loops:
        position, rotation = truth.relative(float(loop["old_time_s"]), float(loop["new_time_s"]))
        said = Rotation.from_quat([float(loop[key]) for key in ("qx", "qy", "qz", "qw")])
        off = numpy.array([float(loop[key]) for key in ("x_m", "y_m", "z_m")]) - position
        errors.append((numpy.linalg.norm(off), numpy.degrees((rotation.inv() * said).magnitude())))
    return numpy.array(errors).reshape(-1, 2)


def revisits(truth):
    """Ways (m) at which the drive comes back, and whether it faces the old way."""
    chosen = numpy.searchsorted(truth.way, numpy.arange(0.0, truth.way[-1], PLACES_APART))
    time, way, place, yaw = truth.time[chosen], truth.way[chosen], truth.position[chosen], truth.yaw(truth.time[chosen])
    near = numpy.linalg.norm(place[:, None] - place[None], axis=2) < REACH
    near &= (time[:, None] - time[None] >= MIN_AGE) & (way[:, None] - way[None] >= MIN_WAY)
    same = near & (numpy.cos(yaw[:, None] - yaw[None]) > numpy.cos(numpy.radians(SAME_WAY)))
    return way[same.any(axis=1)], way[near.any(axis=1) & ~same.any(axis=1)]


def score(recording, run):
    truth = Truth(pathlib.Path(recording) / "ground_truth.tum")
    with (pathlib.Path(run) / "loops.csv").open(encoding="utf-8") as file:
        loops = list(csv.DictReader(file))
    accepted = [loop for loop in loops if loop["outcome"] == "accepted"]
    errors = errors_of(accepted, truth)
    print(f"{run}: {len(accepted)} of {len(loops)} loops accepted")
    for name in sorted({loop["outcome"] for loop in loops} - {"accepted"}):
        refused = errors_of([loop for loop in loops if loop["outcome"] == name], truth)
        right = (refused[:, 0] <= WRONG_POSITION) & (refused[:, 1] <= WRONG_ANGLE)
        print(f"  {name}: {len(refused)}, of which {right.sum()} were right")
    if len(errors) > 0:
        wrong = (errors[:, 0] > WRONG_POSITION) | (errors[:, 1] > WRONG_ANGLE)
        print(f"  error, median and largest: {1e3 * numpy.median(errors[:, 0]):.0f} mm, {1e3 * errors[:, 0].max():.0f} mm; "
              f"{numpy.median(errors[:, 1]):.3f}, {errors[:, 1].max():.3f} degrees; wrong {wrong.sum()} of {len(errors)}")
    ends = numpy.interp([float(loop["new_time_s"]) for loop in accepted], truth.time, truth.way)
    for kind, ways in zip(("the old way", "another way"), revisits(truth)):
        found = sum(bool(numpy.any(numpy.abs(ends - way) <= PLACES_APART)) for way in ways)
        print(f"  revisits within {REACH:.0f} m facing {kind}: {found} of {len(ways)} found")


def main():
    arguments = sys.argv[1:]
    if not arguments or len(arguments) % 2 != 0:
        sys.exit(__doc__.strip())
    for recording, run in zip(arguments[::2], arguments[1::2]):
        score(recording, run)


if __name__ == "__main__":
    main()
