# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""How good features are, scored on images that nothing was trained on: 640 wide, 500 keypoints, mutual nearest neighbours, 3 px."""

import pathlib

import numpy
import torch
from PIL import Image

from regolith_train.homography import transform
from regolith_train.inference import detect_and_describe, mutual_matches

WIDTH, COUNT, TOLERANCE = 640, 500, 3.0


def fitted(path):
    """An image 640 wide at most and 480 high, grey, 0 to 1, and the homography from its own pixels to the fitted ones."""
    picture = Image.open(path).convert("L")
    factor = min(WIDTH / picture.width, 480 / picture.height)
    width, height = round(picture.width * factor), round(picture.height * factor)
    image = numpy.asarray(picture.resize((width, height), Image.Resampling.BOX if factor < 0.5 else Image.Resampling.BILINEAR))
    x, y = width / picture.width, height / picture.height
    return torch.from_numpy(image.astype(numpy.float32) / 255), numpy.array([[x, 0, (x - 1) / 2], [0, y, (y - 1) / 2], [0, 0, 1]])


def oxford_pairs(folder):
    """The five pairs 1 → k of a folder of img1 … img6 and H1to2p …: (first, second, homography)."""
    folder = pathlib.Path(folder)
    images = {index: next(folder.glob(f"img{index}.*")) for index in range(1, 7)}
    first, first_fit = fitted(images[1])
    for index in range(2, 7):
        second, second_fit = fitted(images[index])
        truth = numpy.loadtxt(next(folder.glob(f"H1to{index}p*")))
        yield first, second, second_fit @ truth @ numpy.linalg.inv(first_fit)


def score_homography(extract, first, second, homography):
    """Matches, correct ones and repeatability at 1 and 3 px of one pair."""
    pixels, _, descriptors = extract(first)
    others, _, other_descriptors = extract(second)
    rows, columns = mutual_matches(descriptors, other_descriptors)
    mapped = transform(homography, pixels.double().numpy())
    error = numpy.linalg.norm(mapped[rows.numpy()] - others.double().numpy()[columns.numpy()], axis=1)
    result = {"matches": len(rows), "correct": int((error < TOLERANCE).sum())}
    inside = ((mapped > 4) & (mapped < numpy.array(second.T.shape) - 5)).all(1)
    nearest = numpy.full(len(mapped), numpy.inf)
    if inside.any() and len(others):
        nearest[inside] = numpy.linalg.norm(mapped[inside, None] - others.double().numpy()[None], axis=2).min(1)
    for radius in (1, 3):
        result[f"repeatability_{radius}"] = float((nearest[inside] <= radius).mean()) if inside.any() else 0.0
    return result


def mean_of(results):
    return {key: float(numpy.mean([result[key] for result in results])) for key in results[0]}


def score_oxford(extract, folder):
    return {name: mean_of([score_homography(extract, *pair) for pair in oxford_pairs(pathlib.Path(folder) / f"oxford_{name}")])
            for name in ("graf", "boat")}  # fmt: skip


def score_shifts(extract, image):
    """Repeatability at 1 px where the image moves by whole pixels: the lowest over shifts of 0 … 7 in both directions."""
    lowest = {}
    for dx, dy in [(0, 0), (1, 0), (2, 1), (3, 3), (4, 4), (5, 2), (6, 6), (7, 7), (0, 4), (4, 0), (3, 0), (0, 3)]:
        shift = numpy.array([[1, 0, -dx], [0, 1, -dy], [0, 0, 1]], dtype=float)
        first = image[: image.shape[0] - 8, : image.shape[1] - 8]
        second = image[dy : dy + first.shape[0], dx : dx + first.shape[1]]
        lowest[f"{dx},{dy}"] = score_homography(extract, first, second, shift)["repeatability_1"]
    return lowest


def extractor(network):
    network.eval()
    return lambda image: detect_and_describe(network, image, COUNT)
