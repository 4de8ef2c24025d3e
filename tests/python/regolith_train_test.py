#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""The training package: truths of its geometry and losses, and a training of a few steps that resumes. Runs on Debian's python3-torch
(/usr/bin/python3); without any torch it reports itself as skipped (exit code 77)."""

import json
import math
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))

try:
    import numpy
    import torch
    from PIL import Image
except ImportError as error:
    print(f"SKIPPED: {error}; apt-get install python3-torch python3-pil")
    sys.exit(77)

from regolith_train import evaluation, losses, networks  # noqa: E402
from regolith_train.data import Mixture, SingleImages, flow_at  # noqa: E402
from regolith_train.homography import HomographyRange, random_homography, transform, warp_image  # noqa: E402
from regolith_train.inference import detect_and_describe, mutual_matches, score_map, suppress  # noqa: E402
from regolith_train.labels import label_path  # noqa: E402
from regolith_train.report import simulated_groups  # noqa: E402
from regolith_train.training import (  # noqa: E402
    Run,
    TrainingOptions,
    WrongInput,
    has_bf16,
    mixture,
    strided_depthwise_in_f32,
    train,
)
from regolith_train.vocabulary import spherical_kmeans  # noqa: E402


TWO_PROCESSES = """\
import sys
sys.path.insert(0, {path!r})
import torch
from torch import distributed
from regolith_train.training import TrainingOptions, join_processes, train
options = TrainingOptions(network="ghost", steps=2, batch=2, workers=0, warm_up=1, bf16=False, threads=1, checkpoint_every=1)
rank, _ = join_processes()
run = train(options, {images!r}, [], {labels!r}, {out!r} + f"/run_{{rank}}", progress=lambda line: None)
assert run.samples == 8
torch.save(run.network.state_dict(), {out!r} + f"/weights_{{rank}}.pt")
distributed.destroy_process_group()
"""


torch.manual_seed(11)  # Debian's torch begins with another seed each time


def texture(height, width, seed=1):
    """Smoothed noise with corners in it, 0 to 1."""
    generator = torch.Generator().manual_seed(seed)
    coarse = torch.rand(1, 1, height // 8, width // 8, generator=generator)
    image = torch.nn.functional.interpolate(coarse, (height, width), mode="nearest")[0, 0]
    return (0.8 * image + 0.1 * torch.rand(height, width, generator=generator)).numpy()


class Networks(unittest.TestCase):
    def test_outputs_have_the_shapes_of_the_contract(self):
        for name, network in networks.NETWORKS.items():
            made = network().eval()
            with torch.no_grad():
                logits, descriptors = made(torch.rand(1, 1, 64, 96))
            self.assertEqual(tuple(logits.shape), (1, 65, 8, 12), name)
            self.assertEqual(tuple(descriptors.shape), (1, made.dimension, 8, 12), name)
            torch.testing.assert_close(descriptors.norm(dim=1), torch.ones(1, 8, 12))

    def test_a_shape_is_an_argument_of_the_class(self):
        small = networks.build("ghost", {"depth": 1, "dimension": 64})
        self.assertEqual(small.dimension, 64)
        self.assertLess(sum(p.numel() for p in small.parameters()), sum(p.numel() for p in networks.build("ghost").parameters()))
        with self.assertRaisesRegex(ValueError, "ghost has no such shape"):
            networks.build("ghost", {"depht": 1})

    def test_the_papers_encoder_is_1_2_wide_and_ends_with_96_channels(self):
        network = networks.GhostPaper()
        widths = [block.main[-1].outputs for block in network.encoder[1:]]
        self.assertEqual(widths, [20, 28, 28, 48, 48, 96])


class Geometry(unittest.TestCase):
    def test_a_warped_point_shows_what_the_image_shows(self):
        image = torch.zeros(1, 120, 160)
        image[0, 60, 80] = 1.0
        generator = numpy.random.default_rng(3)
        for _ in range(10):
            homography = random_homography(generator, 160, 120, HomographyRange(scale=1.2, rotation=0.5, translation=0.05))
            warped, _ = warp_image(image, homography, 160, 120)
            expected = transform(homography, numpy.array([[80.0, 60.0]]))[0]
            weights = warped[0].numpy()
            rows, columns = numpy.mgrid[0:120, 0:160]
            found = numpy.array([(weights * columns).sum(), (weights * rows).sum()]) / weights.sum()
            self.assertLess(numpy.abs(found - expected).max(), 0.3)

    def test_flow_is_read_at_the_nearest_pixel_with_the_offset(self):
        rows, columns = numpy.mgrid[0:10, 0:20].astype(numpy.float32)
        flow = numpy.stack([columns + 2, rows - 1])
        numpy.testing.assert_allclose(flow_at(flow, numpy.array([[3.25, 4.75]])), [[5.25, 3.75]], atol=1e-5)


class Report(unittest.TestCase):
    def test_pairs_are_grouped_by_planet_sun_and_baseline_evenly_from_all_folders(self):
        with tempfile.TemporaryDirectory() as root:
            folders = [pathlib.Path(root) / "Moon" / seed / "pairs" for seed in ("1", "2")]
            for folder in folders:
                folder.mkdir(parents=True)
                rows = ["id,baseline_m,rotation_deg,same_sun", *(f"{index:06},0.3,4,1" for index in range(5)), "000005,0.7,4,0", "000006,0.05,4,1"]
                (folder / "index.csv").write_text("\n".join(rows) + "\n")
            groups = simulated_groups(folders, most=3)
            self.assertEqual(list(groups), ["Moon, other sun, 0.5–1 m", "Moon, same sun, 0.1–0.5 m"])
            near = groups["Moon, same sun, 0.1–0.5 m"]
            self.assertEqual(near, [folders[0] / "000000_1.png", folders[1] / "000000_1.png", folders[0] / "000001_1.png"])


class Detector(unittest.TestCase):
    def test_soft_targets_are_distributions_whose_mean_is_the_label(self):
        labels = torch.tensor([[[13.25, 9.5, 1.0], [0.0, 0.0, 0.0]]])
        targets = losses.detector_targets(labels, 32, 40, soft=True)
        torch.testing.assert_close(targets.sum(1), torch.ones(1, 4, 5))
        pixels = torch.nn.functional.pixel_shuffle(targets[:, :64], 8)[0, 0]
        rows, columns = torch.meshgrid(torch.arange(32.0), torch.arange(40.0), indexing="ij")
        self.assertAlmostEqual(float((pixels * columns).sum() / pixels.sum()), 13.25, places=5)
        self.assertAlmostEqual(float((pixels * rows).sum() / pixels.sum()), 9.5, places=5)

    def test_hard_targets_name_one_pixel_a_cell(self):
        labels = torch.tensor([[[2.0, 3.0, 1.0], [5.0, 6.0, 1.0]]])
        targets = losses.detector_targets(labels, 16, 16, soft=False)
        self.assertEqual(targets[0, :, 0, 0].argmax(), 3 * 8 + 2)
        self.assertEqual(float(targets[0, 64].sum()), 3.0)

    def test_a_network_that_says_the_labels_gives_them_back(self):
        labels = torch.tensor([[[13.0, 9.0, 1.0], [30.0, 21.0, 1.0]]])
        logits = 20 * losses.detector_targets(labels, 32, 40, soft=True)
        kept = suppress(score_map(logits), 4) & (score_map(logits) > 0.5)
        self.assertEqual({(int(x), int(y)) for _, _, y, x in torch.nonzero(kept)}, {(13, 9), (30, 21)})


class Repeatability(unittest.TestCase):
    def test_scores_that_move_with_the_homography_cost_nothing(self):
        labels = torch.tensor([[[13.0, 9.0, 1.0], [30.0, 21.0, 1.0]], [[18.0, 12.0, 1.0], [35.0, 24.0, 1.0]]])
        logits = 20 * losses.detector_targets(labels, 40, 48, soft=True)
        inside = torch.ones(2, 1, 40, 48, dtype=torch.bool)
        moved = torch.tensor([[[1.0, 0, 5], [0, 1, 3], [0, 0, 1]]])
        self.assertLess(float(losses.repeatability_loss(logits, inside, moved)), 1e-3)
        self.assertGreater(float(losses.repeatability_loss(logits, inside, torch.eye(3)[None])), 1.0)
        self.assertEqual(float(losses.repeatability_loss(logits, inside, torch.zeros(1, 3, 3))), 0.0)

    def test_exposure_does_not_change_what_ghost_sees(self):
        image = torch.from_numpy(texture(64, 96))[None, None]
        torch.testing.assert_close(networks.normalise(0.4 * image + 0.1), networks.normalise(image), atol=0.02, rtol=0.02)


class Descriptors(unittest.TestCase):
    def test_sampling_at_a_cells_centre_is_the_cell(self):
        field = torch.nn.functional.normalize(torch.randn(1, 16, 4, 5), dim=1)
        sampled = losses.sample_descriptors(field, torch.tensor([[[3.5 + 8 * 2, 3.5 + 8 * 1]]]))
        torch.testing.assert_close(sampled[0, 0], field[0, :, 1, 2])

    def test_descriptors_that_are_nearly_alike_are_told_apart_under_autocast(self):
        generator = torch.Generator().manual_seed(3)
        alike = torch.nn.functional.normalize(torch.ones(20, 64) + 0.05 * torch.randn(20, 64, generator=generator), dim=1)
        with torch.autocast("cpu", torch.bfloat16):
            products = losses.products(alike, alike)
        torch.testing.assert_close(products.double(), alike.double() @ alike.double().T, atol=1e-5, rtol=0)

    def test_losses_prefer_what_matches(self):
        first = torch.nn.functional.normalize(torch.randn(2, 40, 32), dim=2)
        other = torch.nn.functional.normalize(torch.randn(2, 40, 32), dim=2)
        places = 300 * torch.rand(2, 40, 2)
        valid = torch.ones(2, 40, dtype=torch.bool)
        for loss in (lambda b: losses.triplet_loss(first, b, places, valid),
                     lambda b: losses.contrastive_loss(first, b, first, places, valid, 0.07)):  # fmt: skip
            self.assertLess(float(loss(first)), 0.5 * float(loss(other)))

    def test_triplets_part_descriptors_that_an_untrained_network_has_alike(self):
        generator = torch.Generator().manual_seed(5)
        places = 250 * torch.rand(1, 60, 2, generator=generator)
        common = torch.randn(32, generator=generator)
        raw = [(common + 0.3 * torch.randn(1, 60, 32, generator=generator)).requires_grad_() for _ in range(2)]
        valid = torch.ones(1, 60, dtype=torch.bool)
        optimiser = torch.optim.Adam(raw, lr=0.02)

        def loss():
            return losses.triplet_loss(*(torch.nn.functional.normalize(each, dim=2) for each in raw), places, valid)

        self.assertGreater(loss().item(), 0.9)
        for _ in range(100):
            optimiser.zero_grad()
            loss().backward()
            optimiser.step()
        self.assertLess(loss().item(), 0.2)

    def test_triplets_take_their_negatives_from_the_surrounding_area(self):
        places = torch.tensor([[[0.0, 0.0], [5.0, 0.0], [20.0, 0.0], [200.0, 0.0]]])
        first = torch.eye(4)[None].requires_grad_()
        second = 0.8 * torch.eye(4)[None]
        losses.triplet_loss(first, second, places, torch.ones(1, 4, dtype=torch.bool), margin=3.0, negatives=1).backward()
        # Towards its own and away from the nearest one that is 16 px away: neither the one at 5 px nor the far one.
        torch.testing.assert_close(first.grad[0, 0], torch.tensor([-0.4, 0.0, 0.4, 0.0]))

    def test_triplets_apart_from_their_surroundings_take_the_nearest_descriptors(self):
        places = torch.tensor([[[0.0, 0.0], [5.0, 0.0], [20.0, 0.0], [200.0, 0.0]]])
        first = torch.eye(4)[None].requires_grad_()
        second = 0.8 * torch.eye(4)[None]
        second[0, 3, 0] = 0.5  # the far one looks a little like the first
        losses.triplet_loss(first, second, places, torch.ones(1, 4, dtype=torch.bool), margin=1.0, negatives=1).backward()
        torch.testing.assert_close(first.grad[0, 0], 0.5 * (second[0, 3] - second[0, 0]))

    def test_mutual_matches_of_a_permutation_are_the_permutation(self):
        rows = torch.nn.functional.normalize(torch.randn(30, 16), dim=1)
        order = torch.randperm(30)
        first, second = mutual_matches(rows, rows[order])
        self.assertTrue(bool((order[second] == first).all()) and len(first) == 30)

    def test_words_are_unit_and_near_their_clusters(self):
        centres = torch.eye(8)[:4]
        rows = torch.nn.functional.normalize(centres.repeat(50, 1) + 0.05 * torch.randn(200, 8), dim=1)
        words = spherical_kmeans(rows, 4, seed=3)
        torch.testing.assert_close(words.norm(dim=1), torch.ones(4))
        self.assertGreater(float((words @ centres.T).max(1).values.min()), 0.95)


class SecondLook(unittest.TestCase):
    """Images whose grey is the place on the ground; a method that knows ground by its grey where it is as large as in the nearer one."""

    TO_NEAR = numpy.array([[1.0, 0, 0], [0, 2.0, -40.0], [0, 0, 1]])

    @staticmethod
    def extract(image):
        rows, columns = torch.meshgrid(torch.arange(6, 90, 7), torch.arange(6, 120, 7), indexing="ij")
        pixels = torch.stack([columns.flatten(), rows.flatten()], dim=1).float()
        grey = image[rows.flatten(), columns.flatten()]
        below = image[rows.flatten() + 1, columns.flatten()]
        # Those of the first column always.
        known = ((below - grey - 0.005).abs() < 0.002) | (columns.flatten() == 6)
        angles = torch.where(known, 3 * grey + columns.flatten() / 40, torch.zeros(len(grey)))
        return pixels, grey, torch.stack([angles.cos(), angles.sin()], dim=1)

    def match(self, first, second, to_second):
        def keep(one, other):
            return numpy.linalg.norm(transform(to_second, one) - other, axis=1) < 3.0

        with mock.patch.object(evaluation, "plane_homography", lambda *_: to_second):
            looks = [evaluation.match_pair(self.extract, first, second, keep, second_look=again) for again in (False, True)]
        return [int(inliers.sum()) for _, _, inliers in looks], looks[1]

    def test_the_farther_image_is_seen_from_where_the_nearer_one_was_taken(self):
        rows = torch.arange(96.0)[:, None].expand(96, 128)
        far, near = 0.01 * rows, 0.01 * (rows + 40) / 2  # the nearer one's rows are twice as many a length of ground
        (once, again), (first, second, inliers) = self.match(far, near, self.TO_NEAR)
        self.assertGreater(again, max(60, 5 * once))
        # Places of the far image itself, not of its view.
        self.assertTrue(bool((first[inliers][:, 1] < 68).all()))
        numpy.testing.assert_allclose(transform(self.TO_NEAR, first[inliers]), second[inliers], atol=3.0)
        (once, again), _ = self.match(near, far, numpy.linalg.inv(self.TO_NEAR))
        self.assertGreater(again, max(60, 5 * once))

    def test_what_does_not_agree_better_is_not_taken(self):
        near = 0.01 * (torch.arange(96.0)[:, None].expand(96, 128) + 40) / 2
        (once, again), _ = self.match(near, near, numpy.eye(3))
        self.assertEqual(once, again)
        self.assertGreater(once, 60)


class Training(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(self.folder.name)
        self.images, self.labels = [], root / "labels"
        self.labels.mkdir()
        for index in range(3):
            path = root / "set" / f"picture_{index}.png"
            path.parent.mkdir(exist_ok=True)
            Image.fromarray((255 * texture(260, 340, index)).astype(numpy.uint8)).save(path)
            corners = numpy.array([[x, y] for y in range(8, 250, 16) for x in range(8, 330, 16)], dtype=float)
            descriptors = numpy.random.default_rng(index).standard_normal((len(corners), 128))
            descriptors /= numpy.linalg.norm(descriptors, axis=1, keepdims=True)
            numpy.savez(label_path(self.labels, path), pixels=corners, scores=numpy.ones(len(corners)),
                        descriptors=descriptors.astype(numpy.float16))  # fmt: skip
            self.images.append(path)

    def tearDown(self):
        self.folder.cleanup()

    def test_the_two_views_of_a_sample_correspond(self):
        dataset = SingleImages(self.images, self.labels, photometric=False)
        sample = dataset.draw(0, numpy.random.default_rng(4))
        places, valid = sample["places"].round().long(), sample["valid"]
        self.assertGreater(int(valid.sum()), 10)
        views = sample["images"][:, 0]
        # A corner of four blocks looks the same up to the warp: their mean grey does.
        means = [torch.nn.functional.avg_pool2d(view[None, None], 5, 1, 2)[0, 0] for view in views]
        greys = torch.stack([mean[places[k, valid, 1], places[k, valid, 0]] for k, mean in enumerate(means)])
        self.assertGreater(float(torch.corrcoef(greys)[0, 1]), 0.8)

    def test_a_run_that_resumes_ends_where_one_without_a_break_does(self):
        options = TrainingOptions(network="ghost", steps=4, batch=2, workers=0, warm_up=2, bf16=False, threads=1,
                                  schedule="constant", checkpoint_every=1)  # fmt: skip
        root = pathlib.Path(self.folder.name)
        half = TrainingOptions(**{**vars(options), "steps": 2})
        whole = train(options, self.images, [], self.labels, root / "whole", progress=lambda line: None)
        train(half, self.images, [], self.labels, root / "parts", progress=lambda line: None)
        parts = train(options, self.images, [], self.labels, root / "parts", progress=lambda line: None)
        self.assertEqual((whole.step, parts.step, parts.samples), (4, 4, 8))
        for name, value in whole.network.state_dict().items():
            torch.testing.assert_close(parts.network.state_dict()[name], value, msg=name)

    def test_bf16_is_taken_where_the_processor_has_it(self):
        cpu, root = torch.device("cpu"), pathlib.Path(self.folder.name)
        for flags, expected in (("fpu avx512f avx512_bf16", True), ("fpu amx_bf16 amx_tile", True), ("fpu avx2 avx512f", False)):
            information = root / "cpuinfo"
            information.write_text(f"processor\t: 0\nflags\t\t: {flags}\n", encoding="utf-8")
            self.assertEqual(has_bf16(cpu, information), expected, flags)
        self.assertFalse(has_bf16(cpu, root / "missing"))
        asked = TrainingOptions(network="ghost", bf16=True)
        with mock.patch("regolith_train.training.has_bf16", return_value=False):
            self.assertFalse(Run(asked, root / "without").options.bf16)
            lines = []
            train(TrainingOptions(network="ghost", steps=1, batch=2, workers=0, threads=1, bf16=True), self.images, [], self.labels,
                  root / "run", progress=lines.append)  # fmt: skip
        self.assertEqual(lines, ["this processor has no bf16: training in f32"])
        self.assertFalse(json.loads((root / "run" / "options.json").read_text(encoding="utf-8"))["bf16"])
        with mock.patch("regolith_train.training.has_bf16", return_value=True):
            self.assertTrue(Run(asked, root / "with").options.bf16)

    def test_processes_share_the_samples_of_one(self):
        alone = Mixture([SingleImages(self.images, self.labels)], [1.0], 24, seed=3)
        alone.share(start=0, batch=4, rank=0, processes=1)
        numbers = []
        for rank in (0, 1):
            part = Mixture([SingleImages(self.images, self.labels)], [1.0], 24, seed=3)
            part.share(start=4, batch=2, rank=rank, processes=2)  # of two steps each has seen 4
            self.assertEqual(len(part), 8)
            numbers.append(part[0]["places"])
        torch.testing.assert_close(numbers[0], alone[8]["places"])
        torch.testing.assert_close(numbers[1], alone[10]["places"])

    def test_two_processes_train_one_network(self):
        script = pathlib.Path(self.folder.name) / "train.py"
        script.write_text(TWO_PROCESSES.format(path=sys.path[0], images=[str(path) for path in self.images],
                                               labels=str(self.labels), out=self.folder.name), encoding="utf-8")  # fmt: skip
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        started = [subprocess.Popen([sys.executable, script], env={**os.environ, "WORLD_SIZE": "2", "RANK": str(rank), "LOCAL_RANK": "0",
                                    "MASTER_ADDR": "127.0.0.1", "MASTER_PORT": str(port)}) for rank in (0, 1)]  # fmt: skip
        self.assertEqual([process.wait(timeout=120) for process in started], [0, 0])
        states = [torch.load(pathlib.Path(self.folder.name) / f"weights_{rank}.pt") for rank in (0, 1)]
        for name, value in states[0].items():
            if "running" not in name:  # each process normalises by its own samples
                torch.testing.assert_close(states[1][name], value, msg=name)

    def test_weights_of_another_shape_are_refused_by_name(self):
        options = TrainingOptions(network="ghost", steps=1, batch=2, workers=0, bf16=False, threads=1)
        narrow = networks.build("ghost", {"width": 32}).state_dict()
        with self.assertRaisesRegex(WrongInput, "descriptor.0.0.weight"):
            train(options, self.images, [], self.labels, pathlib.Path(self.folder.name) / "run", start=narrow)

    def test_pairs_that_a_recipe_does_not_draw_from_are_refused(self):
        package = pathlib.Path(__file__).resolve().parents[2] / "python"
        told = subprocess.run([sys.executable, "-m", "regolith_train", "train", "--network", "superpoint", "--images", self.folder.name,
                               "--pairs", self.folder.name], cwd=package, capture_output=True, text=True)  # fmt: skip
        self.assertEqual(told.returncode, 2)
        self.assertRegex(told.stderr, "^regolith_train: --pairs: .*superpoint.yaml draws no simulated pairs .*\n$")

    def test_strided_depthwise_convolutions_in_f32_say_the_same(self):
        network = networks.GhostPaper().eval()
        image = torch.from_numpy(texture(64, 96))[None, None].float()
        with torch.no_grad():
            expected = network(image)
            strided_depthwise_in_f32(network)
            actual = network(image)
        for one, other in zip(expected, actual):
            torch.testing.assert_close(one, other)

    def test_strided_depthwise_convolutions_stay_in_f32_under_autocast(self):
        strided, plain = torch.nn.Conv2d(4, 4, 3, 2, groups=4), torch.nn.Conv2d(4, 4, 3, groups=4)
        strided_depthwise_in_f32(torch.nn.ModuleList([strided, plain]))
        with torch.autocast("cpu", torch.bfloat16):
            self.assertEqual([layer(torch.rand(1, 4, 9, 9)).dtype for layer in (strided, plain)], [torch.float32, torch.bfloat16])

    def test_what_is_kept_out_is_not_trained_on(self):
        options = TrainingOptions(pairs_share=0.0)
        paths = [pathlib.Path(f"set/picture_{index}.png") for index in range(200)]
        trained, kept_out = (mixture(options, paths, [], self.labels, 8, kept_out).datasets[0].images for kept_out in (False, True))
        self.assertFalse(set(trained) & set(kept_out))
        self.assertEqual(len(trained) + len(kept_out), 200)
        self.assertGreater(len(kept_out), 2)

    def test_detection_and_description_agree_in_length(self):
        pixels, scores, descriptors = detect_and_describe(networks.Ghost().eval(), torch.from_numpy(texture(61, 83)), 20)
        self.assertEqual(len(pixels), len(scores))
        self.assertEqual(tuple(descriptors.shape), (len(pixels), 128))
        self.assertTrue(math.isfinite(float(descriptors.sum())))


if __name__ == "__main__":
    unittest.main()
