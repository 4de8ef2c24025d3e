#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs what Regolith needs on Debian 12: packages from packages_*.txt, Python tools into .venv.
# Safe to repeat: what is there already is neither downloaded nor touched, and needs no root.
set -euo pipefail

usage() {
  echo "usage: scripts/setup.sh run|test|ros"
  echo "  run   what building and running the program needs"
  echo "  test  the same, and what the tests and checks need"
  echo "  ros   what \`run\` does, and ROS 1 for the live nodes (docs/ros.md)"
}

fail() {
  echo "setup: $*" >&2
  exit 1
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

missing_packages() {
  local name
  sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$@" | while read -r name; do
    dpkg-query -W -f='${Status}' "$name" 2>/dev/null | grep -q 'ok installed' || echo "$name"
  done
}

install_packages() {
  command -v dpkg-query >/dev/null || fail "needs Debian 12 (dpkg was not found); the packages are listed in scripts/packages_*.txt"
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "missing packages, and neither root nor sudo is here; ask an administrator to run: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  echo "setup: installing ${#missing[@]} Debian packages: ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    fail "apt-get could not install: ${missing[*]} (whole log: $log)"
  fi
  rm -f "$log"
}

# A stamp in .venv holds the requirements it was filled from, so that an unchanged list asks no registry.
install_python_tools() {
  local stamp="$root/.venv/.requirements" wanted log
  wanted=$(cat "$@")
  if [ -x "$root/.venv/bin/python" ] && [ -f "$stamp" ]; then
    # A virtual environment for tests holds all that running needs.
    if [ "$(cat "$stamp")" = "$wanted" ] || [[ "$(cat "$stamp")" == "$wanted"* ]]; then return 0; fi
  fi
  echo "setup: installing Python tools into .venv"
  log=$(mktemp)
  if ! { { [ -x "$root/.venv/bin/python" ] || python3 -m venv "$root/.venv"; } &&
    "$root/.venv/bin/python" -m pip install --disable-pip-version-check --quiet $(printf -- '-r %q ' "$@"); } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    fail "pip could not install the pinned requirements of: $* (whole log: $log)"
  fi
  rm -f "$log"
  printf '%s\n' "$wanted" >"$stamp"
}

case "${1:-}" in
run)
  install_packages "$root/scripts/packages_run.txt"
  install_python_tools "$root/scripts/requirements_run.txt"
  ;;
test)
  install_packages "$root/scripts/packages_run.txt" "$root/scripts/packages_test.txt"
  install_python_tools "$root/scripts/requirements_run.txt" "$root/scripts/requirements_test.txt"
  ;;
ros)
  install_packages "$root/scripts/packages_run.txt" "$root/scripts/packages_ros.txt"
  install_python_tools "$root/scripts/requirements_run.txt"
  ;;
-h | --help)
  usage
  exit 0
  ;;
*)
  usage >&2
  exit 2
  ;;
esac
