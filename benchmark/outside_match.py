#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Matches simulated image pairs with a public feature network, for the tables of `regolith reproduce`.

usage: outside_match.py PAIRS --method xfeat|aliked [--second-look] --out DIR

PAIRS is a folder `pairs/` that `regolith simulate --pairs N` wrote. Of each pair ID, DIR/ID/summary.json has the keys that those of
`regolith match` have: matches, inliers, known_inliers, correct_inliers, total_ms (median of three). 500 keypoints an image, mutual
nearest neighbours, outliers rejected by OpenCV's fundamental matrix (MAGSAC, 1 pixel); a match is correct within 3 pixels of the truth,
and unknown where the pixels around it have none or are torn apart. Needs benchmark/requirements_outside.txt.
"""

import argparse
import csv
import json
import pathlib
import statistics
import sys
import time

import cv2
import numpy
import torch

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
from regolith_train.data import read_two_bands
from regolith_train.evaluation import match_pair
from regolith_train.methods import OUTSIDE

METHODS = {"xfeat": "xfeat", "aliked": "aliked-n16"}
TOLERANCE, TEAR, ROUNDS, THREADS = 3.0, 4.0, 3, 2


def true_places(flow, pixels):
    """Bilinear between the four pixels around; (places n × 2, known n, absent n). As PixelTruth of the program: absent where
    all four have none, unknown where some have none or neighbours land more than TEAR apart."""
    height, width = flow.shape[1:]
    column = numpy.clip(numpy.floor(pixels[:, 0]).astype(int), 0, width - 2)
    row = numpy.clip(numpy.floor(pixels[:, 1]).astype(int), 0, height - 2)
    x, y = pixels[:, 0] - column, pixels[:, 1] - row
    corners = numpy.stack([flow[:, row + i, column + j] for i in (0, 1) for j in (0, 1)])  # 4 × 2 × n
    missing = numpy.isnan(corners[:, 0])
    apart = numpy.zeros(len(pixels))
    for a, b in ((0, 1), (2, 3), (0, 2), (1, 3)):
        apart = numpy.fmax(apart, numpy.linalg.norm(corners[a] - corners[b], axis=0))
    weights = numpy.stack([(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y])
    places = (weights[:, None] * corners).sum(0).T
    absent = missing.all(0)
    return places, ~missing.any(0) & (apart <= TEAR), absent


def keep_inliers(first, second):
    if len(first) < 8:
        return numpy.zeros(len(first), bool)
    _, mask = cv2.findFundamentalMat(first, second, cv2.USAC_MAGSAC, 1.0, 0.999, 10000)
    return numpy.zeros(len(first), bool) if mask is None else mask.ravel().astype(bool)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pairs", type=pathlib.Path)
    parser.add_argument("--method", choices=sorted(METHODS), required=True)
    parser.add_argument("--second-look", action="store_true", help="at the farther image, as `regolith match` does")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    torch.set_num_threads(THREADS)
    extract = OUTSIDE[METHODS[arguments.method]]()
    with open(arguments.pairs / "index.csv", encoding="utf-8") as file:
        names = [row["id"] for row in csv.DictReader(file)]
    for name in names:
        images = [torch.from_numpy(cv2.imread(str(arguments.pairs / f"{name}_{part}.png"), cv2.IMREAD_GRAYSCALE).astype(numpy.float32) / 255)
                  for part in (1, 2)]  # fmt: skip
        match_pair(extract, *images, keep_inliers, arguments.second_look)
        times = []
        for _ in range(ROUNDS):
            start = time.perf_counter()
            first, second, inliers = match_pair(extract, *images, keep_inliers, arguments.second_look)
            times.append(1000 * (time.perf_counter() - start))
        places, known, absent = true_places(read_two_bands(arguments.pairs / f"{name}_flow.tif"), first)
        with numpy.errstate(invalid="ignore"):
            correct = known & (numpy.linalg.norm(places - second, axis=1) <= TOLERANCE)
        folder = arguments.out / name
        folder.mkdir(parents=True, exist_ok=True)
        summary = {"features": arguments.method, "matches": len(first), "inliers": int(inliers.sum()),
                   "known_inliers": int((inliers & (known | absent)).sum()), "correct_inliers": int((inliers & correct).sum()),
                   "total_ms": statistics.median(times)}  # fmt: skip
        (folder / "summary.json").write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
