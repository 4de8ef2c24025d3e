#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every include points to a strictly lower level, and that third-party headers stay in .cc files.

usage: check_layers.py [SOURCE]   (default: the tree that this script lies in)
"""

import pathlib
import re
import sys

LEVELS = {
    "core": 0,
    "geometry": 1,
    "sensor": 2,
    "imu": 3, "cloud": 3, "terrain": 3,
    "registration": 4, "io": 4, "sim": 4, "features": 4, "factors": 4, "eval": 4,
    "vio": 5, "lio": 5, "stereo": 5, "backend": 5, "report": 5, "exports": 5,
    "system": 6,
    "config": 7,
    "apps": 8, "ros": 8,
}

# Lower levels that a folder may not include all the same.
ESTIMATOR_BLIND = {"io", "sim", "eval"}
FORBIDDEN = {
    "features": {"imu", "cloud", "terrain"},
    "eval": {"sensor", "imu", "cloud", "terrain"},
    "vio": ESTIMATOR_BLIND,
    "lio": ESTIMATOR_BLIND | {"features"},
    "stereo": ESTIMATOR_BLIND,
    "backend": ESTIMATOR_BLIND,
    "report": {"sensor", "imu", "cloud", "terrain", "registration", "io", "sim", "features", "factors"},
    "system": ESTIMATOR_BLIND | {"report", "exports"},
}

# `config` holds every folder's options and the networks' manifests, so it may include any folder's *_options.h and
# *_manifest.h, and what levels 0 to 2 offer.
CONFIG_ANY_LEVEL = re.compile(r"_(options|manifest)\.h$")

STANDARD_HEADER = re.compile(r"^[a-z0-9_]+$")
ALLOWED_IN_HEADERS = {"Eigen/Core", "Eigen/Geometry"}
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]')


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) == "<", match.group(2)


def check_own(folder, target, name):
    """Why `folder` may not include regolith/`name` of folder `target`, or None."""
    if target == folder:
        return None
    if target not in LEVELS:
        return f"folder {target} has no level"
    if folder == "config":
        if LEVELS[target] <= 2 or CONFIG_ANY_LEVEL.search(name):
            return None
        return f"config may include *_options.h, *_manifest.h and levels up to 2, not {name}"
    if LEVELS[target] >= LEVELS[folder]:
        return f"{folder} (level {LEVELS[folder]}) may not include {target} (level {LEVELS[target]})"
    if target in FORBIDDEN.get(folder, set()):
        return f"{folder} may not include {target}"
    return None


def check_file(path, folder):
    is_public_header = path.suffix == ".h" and not path.stem.endswith("_internal") and folder != "factors"
    for number, angled, name in includes(path):
        if name.startswith("regolith/"):
            problem = check_own(folder, name.split("/")[1], name)
        elif not is_public_header:
            problem = None
        elif STANDARD_HEADER.match(name) or name in ALLOWED_IN_HEADERS:
            problem = None
        else:
            problem = f"third-party header {name} belongs into a .cc file"
        if problem:
            yield f"{path}:{number}: {problem}"


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent
    source = root / "src" / "regolith"
    problems = []
    count = 0
    for path in sorted(source.rglob("*")):
        if path.suffix not in (".h", ".cc"):
            continue
        folder = path.relative_to(source).parts[0]
        if folder not in LEVELS:
            problems.append(f"{path}: folder {folder} is not in the table of levels (docs/architecture.md)")
            continue
        count += 1
        problems.extend(check_file(path, folder))
    for problem in problems:
        print(problem)
    if count == 0:
        print(f"{source}: no source files found")
        return 1
    print(f"{count} files, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
