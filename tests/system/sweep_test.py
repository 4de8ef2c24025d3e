#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""A sweep of two scenarios, two pipelines and two settings: all cells, one table, and nothing is made twice."""

import csv
import os
import shutil
import subprocess
import unittest

from program import PROGRAM, ROOT, ProgramTest, skip_all


def find_snakemake():
    for path in (os.environ.get("REGOLITH_SNAKEMAKE"), ROOT / ".venv_sweep/bin/snakemake", "snakemake"):
        if path and shutil.which(path):
            return shutil.which(path)
    return None


class Sweep(ProgramTest):
    def run_sweep(self, *options):
        command = [find_snakemake(), "--snakefile", ROOT / "workflow/Snakefile", "--cores", "2", "--configfile",
                   self.folder / "sweep.yaml", *options]  # fmt: skip
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.folder / "cache")}
        return subprocess.run([str(word) for word in command], cwd=self.folder, env=environment, capture_output=True, text=True,
                              check=False, timeout=800)  # fmt: skip

    def test_two_by_two_by_two(self):
        # One of the settings is wrong: its cells fail and the others do not.
        (self.folder / "sweep.yaml").write_text(f"""
program: {PROGRAM}
out: {self.folder / "sweep"}
scenarios: [lunar_short, mars_short]
pipelines: [lio, wheels]
seeds: [1]
settings:
  default: []
  wrong: ["lio.no_such_key=1"]
quality: draft
duration: 6
""")
        result = self.run_sweep()
        self.assertEqual(result.returncode, 0, result.stderr[-2000:])
        with open(self.folder / "sweep/results.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 8)
        for row in rows:
            if row["setting"] == "wrong":
                self.assertIn("no_such_key", row["failure"])
            else:
                self.assertEqual(row["failure"], "")
                self.assertLess(float(row["ape_rmse_m"]), 1.0)
        self.assertEqual(list((self.folder / "sweep/recordings").glob("*")), [])
        page = (self.folder / "sweep/leaderboard.html").read_text(encoding="utf-8")
        for word in ("lunar_short", "mars_short", "wheels", "no_such_key"):
            self.assertIn(word, page)
        self.assertGreater((self.folder / "sweep/results.parquet").stat().st_size, 1000)
        again = self.run_sweep("--dry-run")
        self.assertIn("Nothing to be done", again.stdout + again.stderr)


if __name__ == "__main__":
    if not os.environ.get("REGOLITH_LONG_TESTS"):
        skip_all("two minutes; scripts/test.sh --long runs it")
    if not find_snakemake():
        skip_all("no Snakemake (python3 -m venv .venv_sweep && .venv_sweep/bin/pip install -r workflow/requirements.txt)")
    unittest.main()
