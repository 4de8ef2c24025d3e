#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""`regolith simulate`: input that cannot be is refused at once; image pairs; draft quality."""

import csv
import time
import unittest

import numpy
from PIL import Image
from ruamel.yaml import YAML
from scipy.ndimage import map_coordinates

from geotiff import GeoTiff
from program import DATA, ProgramTest, call

AT_ONCE = 10.0  # s, far below any simulation
# A rough ground within 40 m: seconds instead of a minute.
SMALL = ["--set", "mesh.reach=40"]


def read_yaml(path):
    return YAML(typ="safe", pure=True).load(path)


class BadInput(ProgramTest):
    """What bad_input_test.py does not hold already."""

    def refused(self, *arguments, words, scenario="lunar_short"):
        out = self.folder / "out"
        start = time.monotonic()
        result = call("simulate", "--scenario", scenario, *arguments, "--quiet", "--out", out,
                      timeout=120)
        self.assertLess(time.monotonic() - start, AT_ONCE, arguments)
        self.assert_refused(result, *words)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertFalse(out.exists() and list(out.iterdir()), "nothing is written")

    def test_unknown_quality(self):
        self.refused("--quality", "fine", words=("--quality", "fine", "full", "draft"))

    def test_pairs_only_without_pairs(self):
        self.refused("--pairs-only", words=("--pairs-only", "--pairs"))

    def test_sun_below_the_horizon_without_a_lamp(self):
        self.refused("--set",
                     "sun.elevation_deg=-4",
                     words=("sun.elevation_deg", "-4", "lamp.candela"))
        self.refused("--set",
                     "lamp.candela=0",
                     scenario="lunar_dark",
                     words=("lunar_dark.yaml", "sun.elevation_deg", "lamp.candela"))

    def test_a_rover_that_cannot_stand(self):
        """Wheels that hardly move up and down, on ground that is not level."""
        self.refused("--set", "rover.rocker_travel=0.01", words=("rover.rocker_travel", ))
        self.refused("--set", "rover.wheels=5", words=("rover.wheels", "4 or 6"))

    def test_ground_too_steep_for_any_route(self):
        self.refused("--set",
                     "terrain.relief.slope_deg=20",
                     "--set",
                     "drive.max_slope_deg=4",
                     "--set",
                     "drive.wanted_slope_deg=0",
                     words=("drive.max_slope_deg", "slope"))

    def dem(self, columns, rows):
        """A plane of one metre posts, in a format that needs no writer."""
        path = self.folder / "dem.asc"
        line = " ".join(["10"] * columns)
        path.write_text(f"ncols {columns}\nnrows {rows}\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                        "NODATA_value -9999\n" + "\n".join([line] * rows) + "\n")
        return path

    def test_a_path_off_the_terrain(self):
        dem = self.dem(80, 80)
        for frame, places in (("start", "[200,0]"), ("map", "[0,0,200,0]")):
            self.refused("--dem",
                         dem,
                         "--set",
                         "drive.route=waypoints",
                         "--set",
                         f"drive.waypoint_frame={frame}",
                         "--set",
                         f"drive.waypoints={places}",
                         words=("dem.asc", "drive.waypoints"))

    def test_a_model_smaller_than_the_drive(self):
        self.refused("--dem", self.dem(12, 12), words=("dem.asc", "drive.length"))

    def test_waypoints_that_are_no_places(self):
        self.refused("--set",
                     "drive.route=waypoints",
                     "--set",
                     "drive.waypoints=[3,4,5]",
                     words=("drive.waypoints", "3 numbers"))

    @unittest.skipUnless((DATA / "mars_images").is_dir(),
                         f"SKIPPED: no images at {DATA}; set REGOLITH_DATA")
    def test_a_picture_is_no_elevation_model(self):
        picture = sorted((DATA / "mars_images").glob("*.jpeg"))[0]
        self.refused("--dem", picture, words=(picture.name, "pixel"))


def correlation(first, second):
    return numpy.corrcoef(first.ravel(), second.ravel())[0, 1]


class Pairs(ProgramTest):
    def setUp(self):
        super().setUp()
        out = self.folder / "out"
        result = call("simulate", "--scenario", "lunar_short", "--pairs", 2, "--pairs-only", *SMALL,
                      "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.out, self.pairs = out, out / "pairs"

    def test_pairs_are_what_the_index_says_and_correspond(self):
        self.assertFalse((self.out / "recording.bag").exists())
        lines = (self.pairs / "index.csv").read_text().splitlines()
        self.assertEqual(lines[0], "id,baseline_m,rotation_deg,same_sun")
        rows = list(csv.DictReader(lines))
        self.assertEqual(sorted(row["same_sun"] for row in rows), ["0", "1"])
        self.assertEqual(len({row["id"] for row in rows}), 2)
        files = {f"{row['id']}_{end}" for row in rows for end in ("1.png", "2.png", "flow.tif")}
        self.assertEqual({path.name for path in self.pairs.iterdir()}, files | {"index.csv"})
        for row in rows:
            with self.subTest(row):
                self.check_pair(row)

    def check_pair(self, row):
        self.assertGreater(float(row["baseline_m"]), 0.0)
        self.assertLess(float(row["baseline_m"]), 4.0)
        self.assertGreater(float(row["rotation_deg"]), 0.0)
        self.assertLess(float(row["rotation_deg"]), 60.0)
        first, second = (numpy.array(Image.open(self.pairs / f"{row['id']}_{i}.png"))
                         for i in (1, 2))
        for image in (first, second):
            self.assertEqual((image.shape, image.dtype), ((480, 640), numpy.uint8))
        raster = GeoTiff(self.pairs / f"{row['id']}_flow.tif")
        self.assertEqual((raster.values.shape, raster.bits, raster.sample_format),
                         ((480, 640, 2), {32}, {3}))
        x, y = raster.values[:, :, 0], raster.values[:, :, 1]
        valid = numpy.isfinite(x)
        self.assertTrue((valid == numpy.isfinite(y)).all())
        self.assertGreater(valid.mean(), 0.15)
        self.assertGreater((~valid[:60]).mean(), 0.5, "the sky has no correspondence")
        self.assertTrue(((x[valid] >= -0.5) & (x[valid] <= 639.5) & (y[valid] >= -0.5) &
                         (y[valid] <= 479.5)).all())
        warped = map_coordinates(
            second.astype(float),
            [numpy.where(valid, y, 0), numpy.where(valid, x, 0)],
            order=1,
            mode="nearest")
        place = numpy.mgrid[0:480, 0:640]
        self.assertGreater(
            numpy.hypot(x - place[1], y - place[0])[valid].mean(), 3.0, "the camera has moved")
        matched = correlation(first[valid].astype(float), warped[valid])
        if row["same_sun"] == "1":
            self.assertGreater(matched, 0.9)
            # Half a pixel beside the truth matches less.
            beside = map_coordinates(second.astype(float),
                                     [numpy.where(valid, y + 1, 0),
                                      numpy.where(valid, x + 1, 0)],
                                     order=1,
                                     mode="nearest")
            self.assertLess(correlation(first[valid].astype(float), beside[valid]), matched)
        else:
            self.assertLess(matched, 0.9, "shadows fall elsewhere")


class Draft(ProgramTest):
    def test_it_says_so(self):
        out = self.folder / "out"
        result = call("simulate", "--scenario", "mars_short", "--quality", "draft", "--pairs", 1,
                      "--pairs-only", *SMALL, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        text = (out / "scenario.yaml").read_text()
        self.assertTrue(text.startswith("# Draft quality"), text[:80])
        mesh = read_yaml(out / "scenario.yaml")["mesh"]
        self.assertEqual((mesh["spacing"], mesh["interreflection"]), (0.04, False))

    def test_full_quality_says_nothing_of_a_draft(self):
        out = self.folder / "out"
        result = call("simulate", "--scenario", "mars_short", "--pairs", 1, "--pairs-only",
                      "--duration", 5, *SMALL, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("raft", (out / "scenario.yaml").read_text())
        mesh = read_yaml(out / "scenario.yaml")["mesh"]
        self.assertEqual((mesh["spacing"], mesh["interreflection"]), (0.005, True))


if __name__ == "__main__":
    unittest.main()
