#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""One cell of a sweep: runs a pipeline on a recording, evaluates it, and writes cell.json, whether that worked or not.

usage: cell.py PROGRAM RECORDING --pipeline NAME [--set KEY=VALUE]... [--threads N] --out CELL.json
"""

import argparse
import json
import pathlib
import shutil
import subprocess
import sys

KEPT = ("trajectory.tum", "config.yaml")


class Failure(Exception):
    pass


def call(*command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        errors = [line[7:] for line in result.stderr.splitlines() if line.startswith("error: ")]
        raise Failure(errors[-1] if errors else f"exit code {result.returncode}")


def make(arguments, folder):
    working = folder / "run"
    settings = [f"--set={one}" for one in arguments.set]
    call(arguments.program, "run", arguments.recording, "--pipeline", arguments.pipeline, *settings, "--threads", arguments.threads,
         "--out", working, "--overwrite", "--quiet")  # fmt: skip
    call(arguments.program, "evaluate", "--reference", arguments.recording / "ground_truth.tum", "--estimate", working / "trajectory.tum",
         "--out", folder / "evaluation", "--overwrite", "--quiet")  # fmt: skip
    for name in KEPT:
        shutil.copy(working / name, folder / name)
    summary = json.loads((working / "summary.json").read_text(encoding="utf-8"))
    metrics = json.loads((folder / "evaluation" / "metrics.json").read_text(encoding="utf-8"))
    return {"summary": summary, "metrics": metrics}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("recording", type=pathlib.Path)
    parser.add_argument("--pipeline", required=True)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    folder = arguments.out.parent
    folder.mkdir(parents=True, exist_ok=True)
    try:
        cell = make(arguments, folder)
    except Failure as failure:
        cell = {"failure": str(failure)}
    for name in ("run", "evaluation"):
        shutil.rmtree(folder / name, ignore_errors=True)
    arguments.out.write_text(json.dumps(cell, indent=2) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
