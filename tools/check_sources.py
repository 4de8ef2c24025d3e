#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the form of every tracked source file: licence lines, clang-format.

usage: check_sources.py [--fix]
"""

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).parent.parent
FORMATTER = "clang-format-14"
LICENCE = "SPDX-License-Identifier: BSD-3-Clause"
WITH_LICENCE = (".h", ".cc", ".py", ".sh", ".cmake")


def source_files():
    listing = subprocess.run(
        ["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard"], check=True, capture_output=True, text=True)
    files = [ROOT / line for line in listing.stdout.splitlines()]
    return [path for path in files if path.is_file()]


def main():
    fix = "--fix" in sys.argv[1:]
    files = source_files()
    problems = []
    for path in files:
        if path.suffix in WITH_LICENCE or path.name == "CMakeLists.txt":
            head = path.read_text(encoding="utf-8").splitlines()[:4]
            if not any(LICENCE in line for line in head):
                problems.append(f"{path.relative_to(ROOT)}: the first lines lack `{LICENCE}`")
    code = [path for path in files if path.suffix in (".h", ".cc")]
    command = [FORMATTER, "-i"] if fix else [FORMATTER, "--dry-run", "--Werror", "--ferror-limit=1"]
    result = subprocess.run(command + code, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        problems += [line for line in result.stderr.splitlines() if "error:" in line]
        problems.append("run tools/check_sources.py --fix")
    for problem in problems:
        print(problem)
    print(f"{len(files)} files, {len(problems)} problems")
    return 1 if problems or not code else 0


if __name__ == "__main__":
    sys.exit(main())
