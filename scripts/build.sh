#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Configures and builds build/release: the program, or with `test` the tests too. Prints the compiler's output only
# where the build fails.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
preset=${1:-release}
# Sources that move with a checkout would miss the compiler cache by their absolute paths.
export CCACHE_BASEDIR="$root" CCACHE_NOHASHDIR=1
log="$root/build/build.log"
mkdir -p "$root/build"
cd "$root"
target=(--target regolith)
[ "$preset" = release ] || target=()
if ! { cmake --preset "$preset" && cmake --build "$root/build/release" "${target[@]}"; } >"$log" 2>&1; then
  grep -E 'error|Error|undefined reference|FAILED' -A 5 "$log" | head -n 60 >&2
  echo "build: failed; the whole log is $log" >&2
  exit 1
fi
