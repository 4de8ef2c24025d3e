#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Same recording and settings, same bytes; same scenario and seed, same bag."""

import unittest

from program import RECORDING, ProgramTest, call


class Determinism(ProgramTest):
    def trajectory(self, name, threads):
        out = self.folder / name
        # So short a drive comes back nowhere: loops are looked for at what it has just left.
        young = ("--set", "backend.search.min_age=4", "--set", "backend.search.min_way=1")
        result = call("run", RECORDING, "--threads", threads, *young, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [(out / file).read_bytes() for file in ("trajectory.tum", "map.ply", "loops.csv")]

    def test_runs_agree_for_any_number_of_threads(self):
        first = self.trajectory("one", 1)
        self.assertGreater(len(first[0]), 20000)
        self.assertGreater(first[2].count(b"\n"), 5)
        self.assertEqual(first, self.trajectory("two", 2))
        self.assertEqual(first, self.trajectory("again", 2))

    def simulate(self, name, *arguments):
        out = self.folder / name
        result = call("simulate", "--scenario", "lunar_short", "--duration", 5, "--out", out, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [(out / file).read_bytes() for file in ("recording.bag", "ground_truth.tum", "rig.yaml", "terrain.tif")]

    def test_simulations_agree_for_any_number_of_threads_and_differ_by_seed(self):
        first = self.simulate("one", "--threads", 1)
        self.assertEqual(first, self.simulate("two", "--threads", 2))
        other = self.simulate("other", "--seed", 77)
        self.assertNotEqual(first[0], other[0])
        self.assertNotEqual(first[3], other[3])


if __name__ == "__main__":
    unittest.main()
