#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
#
# From nothing to a trajectory: installs what is missing, builds, drives 20 s over the Moon, runs SLAM on the recording
# and prints the error and where the report is. Results: out/demo (or the folder that is named).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${1:-$root/out/demo}
regolith="$root/build/release/regolith"

"$root/scripts/setup.sh" run
echo "demo: building"
"$root/scripts/build.sh" release
echo "demo: driving 20 s over the Moon"
"$regolith" simulate --scenario lunar_short --duration 20 --out "$out/recording" --overwrite
echo "demo: estimating the trajectory"
"$regolith" run "$out/recording" --out "$out/run" --overwrite
