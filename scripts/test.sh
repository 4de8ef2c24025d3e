#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs what is missing, builds the program and its tests, and runs them. `--long` runs the long tests too.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
case "${1:-}" in
"") ;;
--long) export REGOLITH_LONG_TESTS=1 ;;
*)
  echo "usage: scripts/test.sh [--long]" >&2
  exit 2
  ;;
esac

"$root/scripts/setup.sh" test
echo "test: building"
"$root/scripts/build.sh" test
# Real recordings lie outside the repository; tests that need them say that they were skipped.
export REGOLITH_DATA=${REGOLITH_DATA:-$root/../shared/data}
ctest --test-dir "$root/build/release" --output-on-failure -j "$(nproc)"
