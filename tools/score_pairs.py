#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scores frontends on simulated image pairs by `regolith match`, and prints a table of medians.

usage: score_pairs.py PAIRS... [--features NAME...] [--set KEY=VALUE]... [--same-sun | --other-sun] [--baseline LOW HIGH]

PAIRS are folders `pairs/` that `regolith simulate --pairs N` wrote. "found" are the matches that outlier rejection keeps.
"""

import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build/release/regolith"


def pairs_of(folder, arguments):
    folder = pathlib.Path(folder)
    with open(folder / "index.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            same = row["same_sun"] == "1"
            if (arguments.same_sun and not same) or (arguments.other_sun and same):
                continue
            if arguments.baseline[0] <= float(row["baseline_m"]) <= arguments.baseline[1]:
                yield [folder / f"{row['id']}_{part}" for part in ("1.png", "2.png", "flow.tif")]


def score(features, pair, settings):
    with tempfile.TemporaryDirectory() as out:
        command = [PROGRAM, "match", pair[0], pair[1], "--correspondences", pair[2], "--features", features,
                   *(f"--set={setting}" for setting in settings), "--quiet", "--overwrite", "--out", out]  # fmt: skip
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            sys.exit(result.stderr)
        return json.loads((pathlib.Path(out) / "summary.json").read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pairs", nargs="+")
    parser.add_argument("--features", nargs="+", default=["ghost", "ghost_lk", "ghost_paper", "superpoint", "orb", "st_lk"])
    parser.add_argument("--set", action="append", default=[])
    suns = parser.add_mutually_exclusive_group()
    suns.add_argument("--same-sun", action="store_true")
    suns.add_argument("--other-sun", action="store_true")
    parser.add_argument("--baseline", nargs=2, type=float, default=[0.0, 1e9], metavar=("LOW", "HIGH"))
    arguments = parser.parse_args()
    pairs = [pair for folder in arguments.pairs for pair in pairs_of(folder, arguments)]
    if not pairs:
        sys.exit("score_pairs: no pair is like that")
    print(f"{len(pairs)} pairs; medians, precision over all kept matches of all pairs whose truth is known")
    print(f"{'':12} keypoints  matches  found  correct  precision  repeatable 1 px  3 px      ms")
    for features in arguments.features:
        rows = [score(features, pair, arguments.set) for pair in pairs]

        def median(value):
            return statistics.median(value(row) for row in rows)

        kept = sum(row["known_inliers"] for row in rows)
        correct = sum(row["correct_inliers"] for row in rows)
        print(f"{features:12} {median(lambda r: r['images'][0]['keypoints']):9.0f} {median(lambda r: r['matches']):8.0f} "
              f"{median(lambda r: r['inliers']):6.0f} {median(lambda r: r['correct_inliers']):8.0f} "
              f"{100 * correct / max(kept, 1):9.1f}% {median(lambda r: r['repeatability_1px'] or 0):15.3f} "
              f"{median(lambda r: r['repeatability_3px'] or 0):6.3f} {median(lambda r: r['total_ms']):7.1f}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
