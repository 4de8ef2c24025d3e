#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""`regolith terrain`: ground, its exports checked by the formats' own tools, and input that is wrong."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import numpy

from program import DATA, ProgramTest, call

POSTS = 65
XACRO = pathlib.Path(sys.executable).parent / "xacro"


def needs(tool):
    return unittest.skipUnless(shutil.which(str(tool)), f"SKIPPED: {tool} is not installed; run scripts/setup.sh test")


def check(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)


def vertices(path):
    rows = [line.split()[1:4] for line in path.read_text().splitlines() if line.startswith("v ")]
    return numpy.array(rows, dtype=float)


def flat(element):
    """An XML tree as nested tuples, numbers as numbers."""
    def value(text):
        words = (text or "").split()
        try:
            return tuple(round(float(word), 8) for word in words)
        except ValueError:
            return tuple(words)
    attributes = tuple(sorted((key, value(text)) for key, text in element.attrib.items()))
    return element.tag, attributes, value(element.text), tuple(flat(child) for child in element)


class Exports(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "world"
        result = call("terrain", "--statistics", "moon", "--side", 64, "--mesh-posts", POSTS, "--export",
                      "heightmap,dae,obj,sdf,urdf", "--out", self.out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.summary = json.loads((self.out / "summary.json").read_text())

    def test_ground_is_what_was_asked_for(self):
        self.assertTrue(self.summary["complete"])
        self.assertAlmostEqual(self.summary["slopes"]["1_m"]["median_deg"], 4.0, delta=0.6)
        self.assertEqual(self.summary["raster"]["pixel_m"], 0.25)
        self.assertEqual(self.summary["relief"]["hurst"], 0.76)
        self.assertEqual(self.summary["relief"]["slope_at_1m_deg"], 4.0)
        self.assertEqual(self.summary["repaired"], [])
        for name in ("terrain.tif", "terrain.yaml", "preview.png", "heightmap.png", "terrain.mtl"):
            self.assertGreater((self.out / name).stat().st_size, 50, name)
        self.assertEqual(list(self.out.rglob("*.tmp")), [])

    @needs("assimp")
    def test_meshes_have_the_same_heights_in_another_program(self):
        written = vertices(self.out / "terrain.obj")
        self.assertEqual(len(written), POSTS * POSTS)
        for name in ("terrain.dae", "terrain.obj"):
            target = self.folder / (name + ".again.obj")
            result = check("assimp", "export", self.out / name, target)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            read = {(round(x, 3), round(y, 3)): z for x, y, z in self.z_up(vertices(target), written)}
            self.assertEqual(len(read), POSTS * POSTS)
            for x, y, z in written:
                self.assertAlmostEqual(read[round(x, 3), round(y, 3)], z, delta=1e-3)

    @staticmethod
    def z_up(read, written):
        """assimp turns COLLADA's z upwards into y."""
        if abs(numpy.ptp(read[:, 2]) - numpy.ptp(written[:, 2])) < 1e-3:
            return read
        return read[:, [0, 2, 1]] * [1, -1, 1]

    @needs("check_urdf")
    def test_rover_is_a_robot(self):
        result = check("check_urdf", self.out / "rover.urdf")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("root Link: base", result.stdout)

    @needs("ign")
    def test_worlds_are_valid(self):
        environment = dict(os.environ, SDF_PATH=str(self.out / "models"))
        for name in ("terrain.sdf", "world.sdf"):
            result = check("ign", "sdf", "-k", self.out / name, env=environment)
            self.assertIn("Valid.", result.stdout, name + result.stdout + result.stderr)
            self.assertNotIn("Error", result.stderr)

    @needs(XACRO)
    def test_xacro_expands_to_the_urdf(self):
        result = check(XACRO, self.out / "rover.urdf.xacro")
        self.assertEqual(result.returncode, 0, result.stderr)
        expanded = flat(ElementTree.fromstring(result.stdout))
        self.assertEqual(expanded, flat(ElementTree.parse(self.out / "rover.urdf").getroot()))


class FlawedModel(ProgramTest):
    """A model of which every flaw is known."""

    SIZE = 200
    PIXEL = 5.0
    SPIKES = 12
    HOLE = (60, 90, 20)  # row, column, side
    STRIPES = 0.3  # m

    def setUp(self):
        super().setUp()
        random = numpy.random.default_rng(4)
        wave = numpy.fft.fftfreq(2 * self.SIZE)
        radius = numpy.hypot(*numpy.meshgrid(wave, wave))
        radius[0, 0] = numpy.inf
        spectrum = numpy.fft.fft2(random.standard_normal(radius.shape)) * radius**-1.8
        heights = numpy.real(numpy.fft.ifft2(spectrum))[:self.SIZE, :self.SIZE]
        heights *= 0.5 / numpy.std(numpy.diff(heights))
        heights += random.normal(0.0, self.STRIPES, (self.SIZE, 1))
        for k in range(self.SPIKES):
            heights[15 + 14 * k, 10 + (37 * k) % 180] += 25.0 * (-1)**k
        row, column, side = self.HOLE
        heights[row:row + side, column:column + side] = -9999.0
        self.dem = self.folder / "flawed.asc"
        header = (f"ncols {self.SIZE}\nnrows {self.SIZE}\nxllcorner 0\nyllcorner 0\ncellsize {self.PIXEL}\n"
                  "NODATA_value -9999\n")
        self.dem.write_text(header + "\n".join(" ".join(f"{z:.4f}" for z in line) for line in heights) + "\n")

    def terrain(self, dem, name, *options):
        out = self.folder / name
        result = call("terrain", "--dem", dem, "--out", out, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads((out / "summary.json").read_text()), result.stdout + result.stderr

    def test_flaws_are_reported_and_left(self):
        summary, text = self.terrain(self.dem, "as_delivered")
        raster = summary["raster"]
        self.assertEqual(raster["no_data"], self.HOLE[2]**2)
        self.assertAlmostEqual(raster["no_data_percent"], 1.0, delta=1e-6)
        self.assertAlmostEqual(raster["spikes"], self.SPIKES, delta=1)
        self.assertAlmostEqual(raster["stripes_rms_m"]["rows"], self.STRIPES, delta=0.2 * self.STRIPES)
        self.assertLess(raster["stripes_rms_m"]["columns"], 0.2 * self.STRIPES)
        self.assertEqual(raster["quantisation_m"], 0)
        self.assertAlmostEqual(raster["effective_resolution_m"], 2.0 * self.PIXEL, delta=self.PIXEL)
        self.assertEqual(summary["repaired"], [])
        for word in ("without data", "spikes", "stripes along rows", "--repair"):
            self.assertIn(word, text)
        self.assertNotIn("stripes along columns", text)
        again, _ = self.terrain(self.folder / "as_delivered" / "terrain.tif", "again")
        self.assertEqual(again["raster"]["no_data"], raster["no_data"])
        self.assertEqual(again["raster"]["spikes"], raster["spikes"])

    def test_flaws_are_repaired_on_request(self):
        summary, _ = self.terrain(self.dem, "repaired", "--repair")
        self.assertEqual(summary["repaired"], ["no_data", "spikes", "stripes"])
        self.assertEqual(summary["raster"]["no_data"], self.HOLE[2]**2)
        after, _ = self.terrain(self.folder / "repaired" / "terrain.tif", "again")
        self.assertEqual(after["raster"]["no_data"], 0)
        self.assertLessEqual(after["raster"]["spikes"], 1)
        self.assertLess(after["raster"]["stripes_rms_m"]["rows"], 0.4 * self.STRIPES)

    def test_relief_below_the_pixels_is_reported(self):
        summary, text = self.terrain(self.dem, "relief", "--statistics", "mars")
        relief = summary["relief"]
        self.assertEqual(relief["pixel_m"], self.PIXEL)
        self.assertEqual(relief["statistic"], "rms")
        self.assertTrue(0.3 <= relief["hurst"] <= 0.98, relief)
        self.assertGreaterEqual(relief["effective_resolution_m"], 2.0 * self.PIXEL)
        self.assertIn("Hurst exponent", text)


class BadInput(ProgramTest):
    def terrain(self, *arguments):
        return call("terrain", *arguments, "--out", self.folder / "out")

    def test_one_line_and_nothing_written(self):
        text = self.folder / "dem.tif"
        text.write_text("not a raster")
        for arguments, word in ((["--dem", text], "dem.tif"),
                                ([], "--dem"),
                                (["--statistics", "venus"], "venus"),
                                (["--statistics", "moon", "--export", "stl"], "stl"),
                                (["--statistics", "moon", "--export", "heightmap", "--mesh-posts", 100], "2^n"),
                                (["--statistics", "moon", "--crop", 0, 0, 99], "--crop"),
                                (["--statistics", "moon", "--pixel", -1], "--side"),
                                (["--statistics", "moon", "--repair"], "--repair"),
                                (["--statistics", "moon", "--set", "terrain.nonsense=1"], "nonsense")):
            self.assert_refused(self.terrain(*arguments), word)
            self.assertFalse((self.folder / "out").exists(), arguments)


@unittest.skipUnless((DATA / "dem").is_dir(), f"SKIPPED: no elevation models at {DATA}; set REGOLITH_DATA")
class RealModels(ProgramTest):
    def test_each_is_read_and_exported(self):
        for path in sorted((DATA / "dem").glob("*.tif")):
            out = self.folder / path.stem
            result = call("terrain", "--dem", path, "--mesh-posts", POSTS, "--export", "heightmap", "--out", out)
            self.assertEqual(result.returncode, 0, result.stderr)
            summary = json.loads((out / "summary.json").read_text())
            if path.name.startswith("mars_"):
                self.assertEqual(summary["planet"], "mars")
                self.assertAlmostEqual(summary["raster"]["pixel_m"], 20.0, delta=0.1)
            if path.name.startswith("moon_"):
                self.assertEqual(summary["planet"], "moon")
                self.assertAlmostEqual(summary["raster"]["pixel_m"], 10.0, delta=0.1)
                self.assertAlmostEqual(summary["raster"]["spikes"], 20, delta=10)
                self.assertEqual(summary["raster"]["quantisation_m"], 0.5)
                self.assertIn("tracks along rows", result.stderr)
            self.assertGreaterEqual(summary["relief"]["effective_resolution_m"], 2 * summary["raster"]["pixel_m"])

    def test_a_crop_beyond_the_raster_is_refused(self):
        result = call("terrain", "--dem", DATA / "dem" / "moon_lola_88S_10m.tif", "--crop", 10, 10, 400, "--out",
                      self.folder / "out")
        self.assert_refused(result, "crop")


if __name__ == "__main__":
    unittest.main()
