#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""`regolith match`: its files, its scoring against known truth, images and models that are wrong in one way each."""

import csv
import hashlib
import json
import sys
import unittest

import numpy
from PIL import Image
from ruamel.yaml import YAML
from scipy.ndimage import gaussian_filter, map_coordinates

from geotiff import GeoTiff
from program import DATA, ROOT, ProgramTest, call

WIDTH, HEIGHT = 640, 480
MARGIN = 200  # pixels of texture around image 1
NETWORKS = {"ghost": "ghost", "ghost_paper": "ghost_paper", "ghost_lk": "ghost", "superpoint": "superpoint"}
TRAINED = [name for name, model in NETWORKS.items() if (ROOT / "models" / f"{model}.yaml").exists()]
FEATURES = ["orb", "st_lk", *TRAINED]
FILES = {"keypoints_1.csv", "keypoints_2.csv", "matches.csv", "match.png", "config.yaml", "summary.json"}
TABLES = ("keypoints_1.csv", "keypoints_2.csv", "matches.csv")
if len(TRAINED) < len(NETWORKS):
    print(f"NOT TESTED, no models: {sorted(set(NETWORKS) - set(TRAINED))}", file=sys.stderr)

# A camera that comes nearer, turns by 3° and tilts.
ANGLE = numpy.radians(3.0)
HOMOGRAPHY = numpy.array([[1.04 * numpy.cos(ANGLE), -1.04 * numpy.sin(ANGLE), 6.0],
                          [1.04 * numpy.sin(ANGLE), 1.04 * numpy.cos(ANGLE), -14.0], [1.5e-5, -1e-5, 1.0]])


def texture():
    """Grey ground with structure from two pixels to fifty."""
    random = numpy.random.default_rng(7)
    size = (HEIGHT + 2 * MARGIN, WIDTH + 2 * MARGIN)
    layers = [gaussian_filter(random.standard_normal(size), sigma) * sigma for sigma in (1.5, 3, 6, 12, 24)]
    ground = sum(layers)
    return 128 + 40 * ground / ground.std()


def transfer(homography, x, y):
    place = homography @ numpy.stack([x.ravel(), y.ravel(), numpy.ones(x.size)])
    return (place[:2] / place[2]).reshape(2, *x.shape)


def warped(ground, homography):
    """The image whose pixel H p shows what pixel p of image 1 shows."""
    y, x = numpy.mgrid[0:HEIGHT, 0:WIDTH].astype(float)
    source = transfer(numpy.linalg.inv(homography), x, y)
    grey = map_coordinates(ground, [source[1] + MARGIN, source[0] + MARGIN], order=1, mode="reflect")
    noise = numpy.random.default_rng(8).normal(0, 1.5, grey.shape)
    return numpy.clip(numpy.rint(grey + noise), 0, 255).astype(numpy.uint8)


def read_csv(path):
    with path.open(encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


class MatchTest(ProgramTest):
    @classmethod
    def setUpClass(cls):
        ground = texture()
        cls.images = [warped(ground, numpy.eye(3)), warped(ground, HOMOGRAPHY)]

    def setUp(self):
        super().setUp()
        self.first, self.second = self.folder / "first.png", self.folder / "second.png"
        for path, grey in zip((self.first, self.second), self.images):
            Image.fromarray(grey).save(path)
        self.homography = self.folder / "H.txt"
        self.homography.write_text("\n".join(" ".join(map(repr, row)) for row in HOMOGRAPHY.tolist()) + "\n")
        self.out = self.folder / "out"

    def match(self, *arguments, first=None, second=None, out=None):
        return call("match", first or self.first, second or self.second, *arguments, "--out", out or self.out)

    def summary(self, out=None):
        return json.loads(((out or self.out) / "summary.json").read_text(encoding="utf-8"))

    def assert_done(self, result):
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual({path.name for path in self.out.iterdir()}, FILES)
        with Image.open(self.out / "match.png") as picture:
            picture.load()
            return picture.size


class Results(MatchTest):
    def check_tables(self, summary, most):
        headers = [(self.out / name).read_text().splitlines()[0] for name in TABLES]
        self.assertEqual(headers, ["x,y,score", "x,y,score", "x1,y1,x2,y2,score,inlier"])
        sets = [read_csv(self.out / name) for name in TABLES]
        for keypoints, image in zip(sets, summary["images"]):
            self.assertEqual(len(keypoints), image["keypoints"])
            self.assertLessEqual(len(keypoints), most)
            for row in keypoints:
                self.assertTrue(0 <= row["x"] <= WIDTH - 1 and 0 <= row["y"] <= HEIGHT - 1, row)
        places = [{(row["x"], row["y"]) for row in keypoints} for keypoints in sets[:2]]
        matches = sets[2]
        self.assertEqual(len(matches), summary["matches"])
        self.assertEqual(sum(row["inlier"] for row in matches), summary["inliers"])
        for row in matches:
            self.assertIn((row["x1"], row["y1"]), places[0])
            self.assertIn((row["x2"], row["y2"]), places[1])
            self.assertIn(row["inlier"], (0, 1))
        return matches

    def check_score(self, summary, matches):
        """Scored here again, by the text of the table."""
        table = {key: numpy.array([row[key] for row in matches]) for key in matches[0]}
        errors = numpy.hypot(*(transfer(HOMOGRAPHY, table["x1"], table["y1"])
                               - numpy.stack([table["x2"], table["y2"]])))
        kept = table["inlier"] == 1
        self.assertEqual((summary["truth"], summary["tolerance_px"]), ("homography", 3.0))
        self.assertAlmostEqual(summary["correct_matches"], (errors <= 3).sum(), delta=1)
        self.assertAlmostEqual(summary["precision"], (errors <= 3).mean(), delta=0.01)
        self.assertAlmostEqual(summary["precision_inliers"], (errors[kept] <= 3).mean(), delta=0.01)

    def test_every_frontend_matches_a_known_warp(self):
        for name in FEATURES:
            with self.subTest(features=name):
                result = self.match("--features", name, "--homography", self.homography, "--max-keypoints", 300,
                                    "--overwrite")
                self.assert_done(result)
                summary = self.summary()
                self.assertEqual((summary["complete"], summary["features"]), (True, name))
                self.check_score(summary, self.check_tables(summary, 300))
                self.assertGreaterEqual(summary["precision_inliers"], 0.95)
                self.assertGreaterEqual(summary["inliers"], 50)
                self.assertGreaterEqual(summary["repeatability_3px"], summary["repeatability_1px"])
                self.assertGreaterEqual(summary["repeatability_3px"], 0.3)
                for word in (name, "keypoints", "kept", "correct", "ms"):
                    self.assertIn(word, result.stdout)

    def test_a_second_look_at_stretched_ground(self):
        """Ground that the way ahead stretches by 1.8 has several times as many right matches when it is looked at again."""
        ahead = numpy.array([[1.1, 0, -32.0], [0, 1.8, -190.0], [0, 0, 1]])
        second = self.folder / "ahead.png"
        Image.fromarray(warped(texture(), ahead)).save(second)
        self.homography.write_text("\n".join(" ".join(map(repr, row)) for row in ahead.tolist()) + "\n")
        correct = {}
        for name in {"orb", "ghost"} & set(FEATURES):
            for looks in ("false", "true"):
                self.assert_done(self.match("--features", name, "--homography", self.homography, "--overwrite", "--set",
                                            f"features.matcher.second_look={looks}", second=second))  # fmt: skip
                summary = self.summary()
                correct[looks] = summary["correct_inliers"]
                self.assertEqual("look_again" in summary["stages"], looks == "true")
                self.assertEqual(summary["looked_again"], 1 if looks == "true" else 0)
            self.assertGreater(correct["true"], 2 * correct["false"], name)
            self.assertGreaterEqual(summary["precision_inliers"], 0.95)

    def test_times_add_up(self):
        self.assert_done(self.match("--features", "orb"))
        summary = self.summary()
        self.assertTrue(summary["stages"])
        for stage in summary["stages"].values():
            self.assertLessEqual(0, stage["median_ms"])
            self.assertLessEqual(stage["median_ms"], stage["p99_ms"])
        total = sum(stage["median_ms"] for stage in summary["stages"].values())
        self.assertLess(abs(total - summary["total_ms"]), 0.3 * summary["total_ms"] + 1.0)
        self.assertLess(summary["frame_ms"], summary["total_ms"])
        self.assertNotIn("precision", summary)

    def test_true_correspondences_of_the_simulator(self):
        pairs = self.folder / "pairs"
        made = call("simulate", "--scenario", "lunar_short", "--pairs", 1, "--pairs-only", "--quality", "draft",
                    "--set", "mesh.reach=40", "--out", pairs)
        self.assertEqual(made.returncode, 0, made.stderr)
        pair = {end: pairs / "pairs" / f"000000_{end}" for end in ("1.png", "2.png", "flow.tif")}
        result = self.match("--features", "orb", "--correspondences", pair["flow.tif"], first=pair["1.png"],
                            second=pair["2.png"])
        self.assert_done(result)
        summary = self.summary()
        self.assertEqual(summary["truth"], "correspondences")
        self.assertLessEqual(summary["correct_inliers"], summary["known_inliers"])
        self.assertLessEqual(summary["known_inliers"], summary["inliers"])
        flow = GeoTiff(pair["flow.tif"]).values
        matches = read_csv(self.out / "matches.csv")
        places = numpy.array([flow[round(row["y1"]), round(row["x1"])] for row in matches])
        errors = numpy.hypot(*(places - [[row["x2"], row["y2"]] for row in matches]).T)
        # By the nearest pixel instead of between pixels.
        self.assertGreater((errors < 2).sum(), 5)
        self.assertLessEqual((errors < 2).sum(), summary["correct_matches"] + 2)
        self.assertGreaterEqual((errors < 5).sum(), summary["correct_matches"])
        self.assertLessEqual(summary["repeatability_1px"], summary["repeatability_3px"])
        # A flow of another size than image 1.
        self.assert_refused(self.match("--features", "orb", "--correspondences", pair["flow.tif"],
                                       first=self.small(), out=self.folder / "other"), "flow.tif", "64 x 48")

    def small(self):
        path = self.folder / "small.png"
        Image.fromarray(self.images[0][:48, :64]).save(path)
        return path

    def test_same_bytes_again_and_with_any_threads(self):
        for name in FEATURES:
            with self.subTest(features=name):
                outs = []
                for i, threads in enumerate((2, 2, 1)):
                    outs.append(self.folder / f"{name}_{i}")
                    result = self.match("--features", name, "--threads", threads, "--quiet", out=outs[-1])
                    self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
                for table in TABLES:
                    self.assertEqual(len({(out / table).read_bytes() for out in outs}), 1, table)

    def test_the_written_configuration_gives_the_same_result(self):
        self.assert_done(self.match("--features", "orb", "--set", "features.orb.levels=4"))
        again = self.folder / "again"
        result = self.match("--config", self.out / "config.yaml", out=again)
        self.assertEqual(result.returncode, 0, result.stderr)
        for table in TABLES:
            self.assertEqual((self.out / table).read_bytes(), (again / table).read_bytes())


class RealImages(MatchTest):
    def test_graf(self):
        """Oxford's wall of graffiti from 20° aside."""
        folder = DATA / "homography" / "oxford_graf"
        if not folder.exists():
            print(f"SKIPPED: no real data in {folder}", file=sys.stderr)
            self.skipTest(f"no {folder}")
        for name in ("orb", "ghost"):
            with self.subTest(features=name):
                self.assert_done(self.match("--features", name, "--homography", folder / "H1to2p", "--overwrite",
                                            first=folder / "img1.png", second=folder / "img2.png"))
                summary = self.summary()
                self.assertGreaterEqual(summary["inliers"], 50)
                self.assertGreaterEqual(summary["precision_inliers"], 0.9)


class OddImages(MatchTest):
    def matched(self, first, second=None, name="orb"):
        result = self.match("--features", name, "--overwrite", first=first, second=second)
        self.assert_done(result)
        return self.summary()

    def saved(self, name, pixels, mode=None):
        path = self.folder / name
        Image.fromarray(pixels, mode).save(path)
        return path

    def test_nothing_to_see(self):
        views = {
            "black": numpy.zeros((HEIGHT, WIDTH), numpy.uint8),
            "white": numpy.full((HEIGHT, WIDTH), 255, numpy.uint8),
            "pixel": numpy.full((1, 1), 90, numpy.uint8),
            "line": numpy.arange(50, dtype=numpy.uint8)[None]
        }
        for name in FEATURES:
            for view, pixels in views.items():
                with self.subTest(features=name, view=view):
                    path = self.saved(f"{view}.png", pixels)
                    summary = self.matched(path, path, name)
                    self.assertEqual((summary["matches"], summary["inliers"]), (0, 0))
                    self.assertEqual([image["keypoints"] for image in summary["images"]], [0, 0])
                    self.assertEqual([len((self.out / table).read_text().splitlines()) for table in TABLES], [1] * 3)

    def test_one_of_two_images_is_empty(self):
        black = self.saved("black.png", numpy.zeros((100, 100), numpy.uint8))
        for name in FEATURES:
            with self.subTest(features=name):
                self.assertEqual(self.matched(self.first, black, name)["matches"], 0)
                self.assertEqual(self.matched(black, self.first, name)["matches"], 0)

    def test_truth_without_matches_has_no_precision(self):
        black = self.saved("black.png", numpy.zeros((HEIGHT, WIDTH), numpy.uint8))
        result = self.match("--features", "orb", "--homography", self.homography, first=black, second=black)
        self.assert_done(result)
        summary = self.summary()
        self.assertIsNone(summary["precision"])
        self.assertIsNone(summary["repeatability_1px"])

    def test_colour_16_bits_and_jpeg_are_converted(self):
        grey = self.images[0]
        expected = self.matched(self.first)
        colour = self.saved("colour.png", numpy.repeat(grey[:, :, None], 3, axis=2))
        deep = self.saved("deep.png", grey.astype(numpy.uint16) * 257)
        for path in (colour, deep):
            summary = self.matched(path)
            for key in ("matches", "inliers"):
                self.assertEqual(summary[key], expected[key], path.name)
        jpeg = self.folder / "first.jpg"
        Image.fromarray(grey).save(jpeg, quality=90)
        self.assertGreater(self.matched(jpeg)["inliers"], 0.5 * expected["inliers"])

    def test_images_of_different_sizes(self):
        second = self.saved("cut.png", self.images[1][:400, :600])
        for name in FEATURES:
            if name.endswith("_lk"):
                continue  # tracks need one size
            with self.subTest(features=name):
                summary = self.matched(self.first, second, name)
                self.assertEqual([(image["width"], image["height"]) for image in summary["images"]],
                                 [(640, 480), (600, 400)])
                self.assertGreater(summary["inliers"], 20)


class BadInput(MatchTest):
    def refused(self, *arguments, words, **images):
        result = self.match(*arguments, **images)
        self.assert_refused(result, *words)
        self.assertFalse(self.out.exists() and list(self.out.iterdir()), "nothing is written")

    def written(self, name, text):
        path = self.folder / name
        path.write_bytes(text)
        return path

    def test_images(self):
        whole = self.first.read_bytes()
        orb = ("--features", "orb")
        self.refused(*orb, first=self.folder / "none.png", words=("none.png", ))
        self.refused(*orb, second=self.folder, words=("folder", ))
        self.refused(*orb, first=self.written("text.png", b"no image\n"), words=("text.png", "PNG"))
        self.refused(*orb, second=self.written("empty.png", b""), words=("empty.png", ))
        self.refused(*orb, second=self.written("head.png", whole[:30]), words=("head.png", ))

    def test_arguments(self):
        for count in ("0", "-3", "1000000"):
            self.refused("--features", "orb", "--max-keypoints", count, words=("--max-keypoints", count))
        self.refused("--features", "sift", words=("--features sift", "orb", "superpoint"))
        self.refused("--features", "orb", "--set", "features.orb.level=3", words=("features.orb.level", "levels"))
        self.refused("--features", "orb", "--set", "features.precision=f8", words=("precision=f8", "bf16"))
        self.refused("--features", "orb", "--set", "features.model=ghost", words=("features.model", "no network"))
        config = self.written("config.yaml", b"features: {border: wide}\n")
        self.refused("--features", "orb", "--config", config, words=("config.yaml:1", "features.border"))
        self.out.mkdir()
        (self.out / "mine.txt").write_text("precious")
        self.assert_refused(self.match("--features", "orb"), "--overwrite")

    def test_truths(self):
        orb = ("--features", "orb", "--homography")
        self.refused(*orb, self.folder / "none", words=("none", ))
        self.refused(*orb, self.written("short", b"1 0 0\n0 1 0\n"), words=("short", "three lines"))
        self.refused(*orb, self.written("flat", b"1 0 0\n2 0 0\n0 0 1\n"), words=("flat", "inverted"))
        self.refused(*orb, self.first, words=("first.png", ))
        flow = self.written("flow.tif", b"no raster")
        self.refused("--features", "orb", "--correspondences", flow, words=("flow.tif", ))
        self.refused("--features", "orb", "--correspondences", self.first, words=("first.png", "bands"))
        self.refused(*orb, self.homography, "--correspondences", flow, words=("two truths", ))


@unittest.skipUnless("ghost" in TRAINED, "NO MODEL: models/ghost.yaml is not there")
class BadModels(MatchTest):
    def setUp(self):
        super().setUp()
        yaml = YAML(typ="safe", pure=True)
        self.manifest = yaml.load(ROOT / "models/ghost.yaml")
        self.network = (ROOT / "models" / self.manifest["file"]).read_bytes()
        for key in ("parity", "training"):
            self.manifest.pop(key, None)

    def refused(self, network, *words, right_sum=True, **changes):
        """With the manifest of ghost, changed, beside a network."""
        manifest = {**self.manifest, "file": "net.onnx", **changes}
        if right_sum:
            manifest["sha256"] = hashlib.sha256(network).hexdigest()
        (self.folder / "net.onnx").write_bytes(network)
        path = self.folder / "net.yaml"
        with path.open("w") as file:
            yaml = YAML(typ="safe", pure=True)
            yaml.default_flow_style = False
            yaml.dump(manifest, file)
        self.assert_refused(self.match("--features", "ghost", "--set", f"features.model={path}"), *words)

    def test_a_manifest_that_is_not_there(self):
        self.assert_refused(self.match("--features", "ghost", "--set", "features.model=spirit"), "spirit", "ghost")

    def test_networks_that_are_not_what_the_manifest_says(self):
        self.refused(self.network[:-1], "net.onnx", "sha256", right_sum=False)
        self.refused(self.network[:len(self.network) // 2], "net.onnx")
        self.refused(b"", "net.onnx")
        self.refused(b"this is no network\n" * 100, "net.onnx")

    def test_names_and_shapes_that_the_network_does_not_have(self):
        outputs = self.manifest["outputs"]
        self.refused(self.network, "net.onnx", "picture",
                     input={"name": "picture", "shape": [1, 1, -1, -1]})
        self.refused(self.network, "net.onnx", "descriptors",
                     outputs={**outputs, "descriptors": {**outputs["descriptors"], "shape": [1, 7, -1, -1]}})
        self.refused(self.network, "net.yaml", "outputs.logits",
                     outputs={**outputs, "logits": {**outputs["logits"], "shape": [1, 64, -1, -1]}})


if __name__ == "__main__":
    unittest.main()
