#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Copies what a `regolith reproduce` folder has measured (metrics.json, summary.json of each finished cell) to docs/results/cells.

usage: keep_cells.py OUT [--to docs/results]

The plan is kept too, so that a copy of the folder is the --out of an unfinished reproduction: `cp -r docs/results out/full`, then `regolith reproduce`
with --pairs and --duration as in plan.yaml makes its tables of the cells that are there and runs the others.
"""

import argparse
import pathlib
import shutil
import sys

KEPT = ("metrics.json", "summary.json")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--to", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1] / "docs/results")
    arguments = parser.parse_args()
    cells = arguments.out / "cells"
    if not cells.is_dir():
        print(f"error: {cells}: no such folder; expected the --out of `regolith reproduce`", file=sys.stderr)
        return 2
    count = 0
    for metrics in sorted(cells.glob("*/*/metrics.json")):
        made = metrics.parent
        if made.suffix == ".making" or not (made / "summary.json").exists():
            continue
        place = arguments.to / made.relative_to(arguments.out)
        place.mkdir(parents=True, exist_ok=True)
        for name in KEPT:
            shutil.copyfile(made / name, place / name)
        count += 1
    shutil.copyfile(arguments.out / "plan.yaml", arguments.to / "plan.yaml")
    print(f"{count} cells are in {arguments.to}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
