#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Rendered ground beside real ground: spectra, gradients and contrasts of image tiles.

Real: the Navcam pair of Curiosity's sol 1431 (0.82 mrad a pixel), three pixels averaged to one.
That makes 2.46 mrad a pixel; our cameras have 2.44 at their centre (focal length 410 pixels), so
that one tile of 42 pixels is 6 degrees wide in both. The frames' upper half is sky, their outermost
pixels are a frame; the lower half gives 8 × 4 tiles a frame, 64 in all. Two of them a frame, at the
upper left, hold sky and are left out.

What the two do not share. The real ground is 14 to 35 m away (parallax of the pair, base 0.42 m),
ours 1 to 13 m. The average is sharper than any lens: blurred by ours (0.35 pixel), the real spectra
would be steeper, so the test is the stricter for it. The public frames are 8 bit JPEGs; if
they were companded (square root), the true contrasts are up to twice as high.
"""

import functools
import pathlib
import shutil
import sys
import tempfile
import unittest

import numpy
from PIL import Image

from camera_frames import read_frames
from program import DATA, RECORDING, call, skip_all

REAL = sorted((DATA / "mars_images").glob("*.jpeg")) if (DATA / "mars_images").is_dir() else []
TILE = 42  # pixels
REDUCTION = 3  # Navcam pixels to one
LABELS = ("slope", "gradient", "contrast")
SKY_TILES = {(0, 0), (0, 1)}  # row, column
HORIZON = -5.0  # degrees; what looks lower is ground, on slopes too
# Five frames, some 6 m apart, with next to no other sensors between: 20 s.
SPARSE = ["--set", "camera.rate=0.1", "--set", "lidar.rate=1", "--set", "lidar.firings=36"]
# The Moon's range. No published spectrum of images of the Moon at a rover's scale was found, so
# two published figures frame it. Shallow end: the image of a self-affine surface under oblique
# light has a power ~ f^(-2H) (Kube & Pentland 1988, IEEE PAMI 10, 704: the surface's f^(-2H-2)
# times f^2), with H .5 of regolith below a centimetre (Helfenstein & Shepard 1999; .6-.85 up to
# decimetres, Guo et al. 2021): -1.0. Steep end: natural images, which have shadows and outlines
# too, have amplitudes of f^-0.8 to f^-1.5 (Tolhurst et al. 1992, Ophthal. Physiol. Opt. 12, 229):
# a power of -3.0.
MOON_SLOPES = (-3.0, -1.0)


def spectrum_slope(tile):
    """Slope of log power over log frequency, of radial means from 2.5 waves a tile to 0.45 a pixel;
    a plane is taken off and a Hann window laid over."""
    rows, columns = numpy.mgrid[0:TILE, 0:TILE]
    plane = numpy.column_stack([rows.ravel(), columns.ravel(), numpy.ones(TILE * TILE)])
    fitted = plane @ numpy.linalg.lstsq(plane, tile.ravel(), rcond=None)[0]
    window = numpy.hanning(TILE)
    rest = tile - fitted.reshape(tile.shape)
    power = numpy.abs(numpy.fft.fft2(rest * window[:, None] * window))**2
    axis = numpy.fft.fftfreq(TILE)
    frequency = numpy.hypot(axis[:, None], axis)
    edges = numpy.geomspace(2.5 / TILE, 0.45, 8)
    points = []
    for low, high in zip(edges, edges[1:]):
        ring = (frequency >= low) & (frequency < high)
        points.append((numpy.log(frequency[ring]).mean(), numpy.log(power[ring].mean() + 1e-12)))
    return numpy.polyfit(*zip(*points), 1)[0]


def statistics(tile):
    """Slope of the spectrum; mean gradient a pixel and contrast, as shares of the brightness."""
    down, right = numpy.gradient(tile)
    mean = tile.mean()
    return spectrum_slope(tile), numpy.hypot(down, right).mean() / mean, tile.std() / mean


def tiles(image):
    """Tiles side by side from the image's lower edge up, with their top left pixels."""
    rows, columns = image.shape
    for top in range(rows % TILE, rows - TILE + 1, TILE):
        for left in range((columns % TILE) // 2, columns - TILE + 1, TILE):
            yield (top, left), image[top:top + TILE, left:left + TILE].astype(float)


def real_statistics():
    rows = []
    for path in REAL:
        image = Image.open(path).convert("L")
        cropped = numpy.array(image.crop((2, 2, 1022, 1022)), dtype=float)
        small = cropped.reshape(340, REDUCTION, 340, REDUCTION).mean(axis=(1, 3))[-4 * TILE:]
        for (top, left), tile in tiles(small):
            if (top // TILE, left // TILE) not in SKY_TILES:
                rows.append(statistics(tile))
    return numpy.array(rows)


def ground_tiles(frames):
    for image, elevation in frames:
        for (top, left), tile in tiles(image):
            if elevation[top:top + TILE, left:left + TILE].max() < HORIZON:
                yield tile


def is_lit(tile):
    """Lies in the sun: hardly any pixels are black or burnt out."""
    dark, burnt = (tile < 0.15 * tile.mean()).mean(), (tile > 250).mean()
    return dark < 0.05 and burnt < 0.01 and tile.mean() > 20.0


@functools.lru_cache(maxsize=None)
def folder():
    return pathlib.Path(tempfile.mkdtemp(prefix="regolith_test_"))


def tearDownModule():
    shutil.rmtree(folder(), ignore_errors=True)


def render(scenario, *arguments):
    out = folder() / scenario
    result = call("simulate", "--scenario", scenario, *SPARSE, *arguments, "--quiet", "--overwrite", "--out", out)
    if result.returncode != 0:
        raise AssertionError(result.stderr)
    return read_frames(out)


def describe(name, rows):
    figures = numpy.percentile(rows, (5, 50, 95), axis=0).T
    text = "  ".join(f"{label} {low:.3f} {middle:.3f} {high:.3f}"
                     for label, (low, middle, high) in zip(LABELS, figures))
    print(f"{name}: {len(rows)} tiles, 5 %, median and 95 %: {text}", file=sys.stderr)


class Mars(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.real = real_statistics()
        cls.frames = render("mars_short")
        cls.rendered = numpy.array([statistics(tile) for tile in ground_tiles(cls.frames)])
        describe("Curiosity", cls.real)
        describe("mars_short", cls.rendered)

    def test_there_are_enough_tiles(self):
        self.assertEqual(len(self.real), 60)
        self.assertEqual(len(self.frames), 5)
        self.assertGreater(len(self.rendered), 300)

    def test_spectrum_falls_as_that_of_real_ground(self):
        self.assertAlmostEqual(numpy.median(self.rendered[:, 0]),
                               numpy.median(self.real[:, 0]),
                               delta=0.4)

    def assert_within_the_real_range(self, column):
        low, high = numpy.percentile(self.real[:, column], (5, 95))
        median = numpy.median(self.rendered[:, column])
        self.assertGreater(median, low)
        self.assertLess(median, high)

    def test_gradients_are_those_of_real_ground(self):
        self.assert_within_the_real_range(1)

    def test_contrasts_are_those_of_real_ground(self):
        self.assert_within_the_real_range(2)


class Moon(unittest.TestCase):
    def test_spectrum_of_lit_ground(self):
        """Of stills: a driving rover's motion blur steepens it by 0.5."""
        frames = render("lunar_short", "--set", "camera.rate=0.4", "--set", "camera.motion_blur=false")
        lit = [tile for tile in ground_tiles(frames) if is_lit(tile)]
        rows = numpy.array([statistics(tile) for tile in lit])
        self.assertGreater(len(rows), 64)
        describe("lunar_short, lit", rows)
        self.assertGreater(numpy.median(rows[:, 0]), MOON_SLOPES[0])
        self.assertLess(numpy.median(rows[:, 0]), MOON_SLOPES[1])

    def test_sky_is_exactly_black_before_noise(self):
        """Higher than 5 degrees there is nothing but sky above a mare."""
        frames = render("lunar_short", "--set", "camera.noise=false", "--quality", "draft")
        self.assertEqual(len(frames), 5)
        for image, elevation in frames:
            sky = image[elevation > 5.0]
            self.assertGreater(sky.size, 20_000)
            self.assertEqual(sky.max(), 0)
            self.assertGreater(image[elevation < HORIZON].mean(), 20.0)
        noisy, elevation = read_frames(RECORDING, every=200)[1]
        self.assertGreater(noisy[elevation > 5.0].max(), 0)


if __name__ == "__main__":
    if not REAL:
        skip_all(f"no real images of Mars at {DATA / 'mars_images'}; set REGOLITH_DATA")
    unittest.main()
