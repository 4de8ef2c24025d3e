# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""How good features are, scored on images that nothing was trained on: 640 wide, 500 keypoints, mutual nearest neighbours, 3 px."""

import pathlib

import numpy
import torch
from PIL import Image
from torch.nn import functional

from regolith_train.data import SimulatedPairs, flow_at, load_flow
from regolith_train.homography import transform, warp_image
from regolith_train.inference import mutual_matches
from regolith_train.labels import load_grey

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
    first = image[: image.shape[0] - 8, : image.shape[1] - 8]
    known = extract(first)
    for dx, dy in [(0, 0), (1, 0), (2, 1), (3, 3), (4, 4), (5, 2), (6, 6), (7, 7), (0, 4), (4, 0), (3, 0), (0, 3)]:
        shift = numpy.array([[1, 0, -dx], [0, 1, -dy], [0, 0, 1]], dtype=float)
        second = image[dy : dy + first.shape[0], dx : dx + first.shape[1]]
        lowest[f"{dx},{dy}"] = score_homography(lambda one: known if one is first else extract(one), first, second, shift)["repeatability_1"]
    return lowest


def score_turn(extract, image, angle=0.0, scale=1.0):
    """An image against itself, turned in its plane about its centre (degrees) and scaled."""
    height, width = image.shape
    cosine, sine = scale * numpy.cos(numpy.radians(angle)), scale * numpy.sin(numpy.radians(angle))
    x, y = (width - 1) / 2, (height - 1) / 2
    turn = numpy.array([[cosine, -sine, x - cosine * x + sine * y], [sine, cosine, y - sine * x - cosine * y], [0, 0, 1]])
    if scale < 1:
        # As a lens would: what is finer than the pixels of the smaller image is not in it.
        taps = numpy.exp(-0.5 * (numpy.arange(-4, 5) / (0.5 * numpy.sqrt(scale**-2 - 1))) ** 2)
        kernel = torch.from_numpy(numpy.outer(taps, taps) / taps.sum() ** 2).float()
        blurred = functional.conv2d(functional.pad(image[None, None], (4, 4, 4, 4), mode="replicate"), kernel[None, None])[0]
    else:
        blurred = image[None]
    turned, _ = warp_image(blurred, turn, width, height)
    return score_homography(extract, image, turned[0], turn)


def keep_inliers(first, second):
    """Which matches (n × 2 each) the fundamental matrix of most of them keeps: MAGSAC, within 2 px, as `regolith match` begins."""
    import cv2

    if len(first) < 12:
        return numpy.ones(len(first), dtype=bool)
    _, mask = cv2.findFundamentalMat(first, second, cv2.USAC_MAGSAC, 2.0, 0.999, 1000)
    return numpy.ones(len(first), dtype=bool) if mask is None else mask[:, 0] != 0


def plane_homography(first, second, inliers):
    """As PlaneHomography of view_warp.h: that of most of the inliers within 8 px; None where fewer than ten follow one."""
    import cv2

    if inliers.sum() < 10:
        return None
    homography, mask = cv2.findHomography(first[inliers], second[inliers], cv2.USAC_MAGSAC, 8.0, maxIters=1000, confidence=0.999)
    if homography is None or mask.sum() < 10:
        return None
    followers = first[inliers][mask[:, 0] != 0]
    homography = homography / (followers @ homography[2, :2] + homography[2, 2]).mean()
    return homography if numpy.linalg.det(homography) > 0 else None


def match_pair(extract, first, second, keep, second_look=False):
    """Mutual nearest neighbours of two images and which of them `keep` (places in both → mask) takes for inliers: n × 2, n × 2, n.

    With a second look, the farther image is seen again as from where the nearer one was taken, by the homography of the inliers, as
    `regolith match` does (MatchingFrontend::LookAgain), and the result with more inliers is taken.
    """
    looks = [extract(first), extract(second)]
    result = matched(looks, keep)
    homography = plane_homography(*result) if second_look else None
    if homography is None:
        return result
    # The derivative's determinant is det(H) / depth³.
    depth = numpy.median(result[0][result[2]] @ homography[2, :2] + homography[2, 2])
    farther = 0 if numpy.linalg.det(homography) / depth**3 >= 1 else 1
    to_near = homography if farther == 0 else numpy.linalg.inv(homography)
    image, near = ((first, second), (second, first))[farther]
    view, _ = warp_image(image[None], to_near, near.shape[1], near.shape[0], continued=True)
    pixels, scores, descriptors = extract(view[0])
    places = transform(numpy.linalg.inv(to_near), pixels.double().numpy())
    with numpy.errstate(invalid="ignore"):
        inside = torch.from_numpy(((places >= 4) & (places <= numpy.array(image.T.shape) - 5)).all(1))
    looks[farther] = torch.from_numpy(places)[inside], scores[inside], descriptors[inside]
    again = matched(looks, keep)
    return again if again[2].sum() > result[2].sum() else result


def matched(looks, keep):
    (pixels, _, descriptors), (others, _, other_descriptors) = looks
    rows, columns = (index.numpy() for index in mutual_matches(descriptors, other_descriptors))
    first, second = pixels.double().numpy()[rows], others.double().numpy()[columns]
    return first, second, keep(first, second)


def score_simulated(extract, pairs, second_look=False):
    """Simulated pairs (paths of their first images), mutual nearest neighbours, the same rejection for all methods: medians of the
    matches kept and of those of them that are right within 3 px, precision over all."""
    kept, correct, known = [], [], 0
    for path in pairs:
        images = [torch.from_numpy(load_grey(one)) for one in (path, SimulatedPairs.other(path))]
        first, second, inliers = match_pair(extract, *images, keep_inliers, second_look)
        error = numpy.linalg.norm(flow_at(load_flow(path), first[inliers]) - second[inliers], axis=1)
        kept.append(int(inliers.sum()))
        correct.append(int((error < TOLERANCE).sum()))
        known += int(numpy.isfinite(error).sum())
    return {"pairs": len(pairs), "kept": float(numpy.median(kept)), "correct": float(numpy.median(correct)),
            "precision": sum(correct) / max(known, 1)}  # fmt: skip
