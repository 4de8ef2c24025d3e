# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Training samples: two views of one scene, with keypoints and what of them is seen in both.

A view is cut from an image by a random homography and changed photometrically. Two kinds of scene: one labelled image seen twice
(the homography is the truth), and a pair of the simulator (`pairs/` of `regolith simulate`: the flow is the truth).
"""

import dataclasses
import os
import pathlib

import numpy
import torch
from scipy.spatial import cKDTree
from torch.utils.data import Dataset

from regolith_train.homography import HomographyRange, random_homography, transform, warp_image
from regolith_train.labels import label_path, load_grey
from regolith_train.networks import CELL
from regolith_train.photometry import augment

HEIGHT, WIDTH = 240, 320
POINTS = 192  # correspondences a sample
LABELS = 512  # keypoint labels a view, at most
SURE_SCORE = 0.9  # of the teacher


@dataclasses.dataclass
class View:
    image: torch.Tensor  # 1 × HEIGHT × WIDTH, 0 to 1
    inside: torch.Tensor  # 1 × HEIGHT × WIDTH, where it shows the picture
    labels: torch.Tensor  # LABELS × 3: x, y, weight; weight 0 where there is none


def sureness(scores):
    """How much of a keypoint a label is: what the teacher is not sure of counts less, so that the order of scores is learnt."""
    return numpy.clip(scores / SURE_SCORE, 0.0, 1.0) ** 1.5


def validation(path):
    """One image in twenty is kept out of training, by its name alone."""
    return sum(pathlib.Path(path).name.encode()) % 20 == 0


def cut(image, homography, pixels, weights, generator, photometric):
    warped, inside = warp_image(torch.from_numpy(image)[None], homography, WIDTH, HEIGHT)
    if photometric:
        warped = augment(warped, generator) * inside
    places = transform(homography, pixels)
    seen = numpy.flatnonzero(within(places))
    labels = numpy.zeros((LABELS, 3), dtype=numpy.float32)
    chosen = seen[:LABELS]
    labels[: len(chosen), :2] = places[chosen]
    labels[: len(chosen), 2] = weights[chosen]
    return View(warped, inside, torch.from_numpy(labels))


def within(places, margin=4):
    with numpy.errstate(invalid="ignore"):
        return ((places >= margin) & (places <= numpy.array([WIDTH, HEIGHT]) - 1 - margin)).all(axis=1)


def window(generator, width, height, zoom):
    """The homography that shows a random part of an image, `zoom` (range) pixels of the view a pixel of the image."""
    lowest = max(zoom[0], min(WIDTH / width, HEIGHT / height))
    factor = generator.uniform(lowest, max(zoom[1], lowest))
    left = generator.uniform(0, max(width - WIDTH / factor, 0))
    top = generator.uniform(0, max(height - HEIGHT / factor, 0))
    return numpy.array([[factor, 0, -factor * left], [0, factor, -factor * top], [0, 0, 1]])


def correspondences(first, second, chosen, generator):
    """Of the points seen in both views, POINTS at random: places in both, and the rows they came from; rows are -1 beyond them."""
    chosen = generator.permutation(chosen)[:POINTS]
    places = numpy.zeros((2, POINTS, 2), dtype=numpy.float32)
    places[0, : len(chosen)], places[1, : len(chosen)] = first[chosen], second[chosen]
    rows = numpy.full(POINTS, -1)
    rows[: len(chosen)] = chosen
    return torch.from_numpy(places), rows


def teacher_descriptors(descriptors, rows):
    result = numpy.zeros((POINTS, descriptors.shape[1]), dtype=numpy.float32)
    result[rows >= 0] = descriptors[rows[rows >= 0]]
    return torch.from_numpy(result)


def sample(first, second, places, rows, descriptors, homography):
    """A sample of two views. `homography` takes pixels of the first to the second; 0 where no homography does."""
    return {
        "images": torch.stack([first.image, second.image]),
        "inside": torch.stack([first.inside, second.inside]),
        "labels": torch.stack([first.labels, second.labels]),
        "places": places,
        "valid": torch.from_numpy(rows >= 0),
        "teacher": teacher_descriptors(descriptors, rows),
        "homography": torch.from_numpy(homography.astype(numpy.float32)),
    }


class SingleImages(Dataset):
    """One labelled image, seen twice; in `shift_share` of the samples the second view is the first one moved by whole pixels."""

    def __init__(self, images, labels, limits=None, photometric=True, shift_share=0.0):
        self.images = list(images)
        self.labels = labels
        self.limits = limits or HomographyRange(scale=1.6, rotation=0.4, full_rotation_share=0.45, perspective=0.2)
        self.photometric = photometric
        self.shift_share = shift_share

    def __len__(self):
        return len(self.images)

    def draw(self, index, generator):
        image = load_grey(self.images[index])
        label = numpy.load(label_path(self.labels, self.images[index]))
        if generator.uniform() < 0.5:
            image = numpy.ascontiguousarray(image[:, ::-1])
            pixels = label["pixels"] * [-1, 1] + [image.shape[1] - 1, 0]
        else:
            pixels = label["pixels"]
        weights = sureness(label["scores"])
        base = window(generator, image.shape[1], image.shape[0], (0.75, 1.25))
        between = random_homography(generator, WIDTH, HEIGHT, self.limits)
        if generator.uniform() < self.shift_share:
            between = numpy.eye(3)
            between[:2, 2] = generator.integers(-CELL, CELL + 1, 2)
        other = between @ base
        first = cut(image, base, pixels, weights, generator, self.photometric)
        second = cut(image, other, pixels, weights, generator, self.photometric)
        places = transform(base, pixels), transform(other, pixels)
        chosen = numpy.flatnonzero(within(places[0]) & within(places[1]))
        places, rows = correspondences(*places, chosen, generator)
        return sample(first, second, places, rows, label["descriptors"], between)


class SimulatedPairs(Dataset):
    """Pairs of `regolith simulate --pairs`: other places, suns and exposures, with true correspondences.

    A keypoint of one image whose true place in the other has none there is a bad label (a shadow's edge under another sun, an
    outline before far ground): it counts as a third of one.
    """

    DOUBTFUL = 0.3

    def __init__(self, folders, labels, photometric=True, kept_out=False):
        self.labels = labels
        self.photometric = photometric
        self.pairs = [path for folder in folders for path in sorted(pathlib.Path(folder).glob("*_1.png"))
                      if validation(path) == kept_out and label_path(labels, path).exists() and label_path(labels, self.other(path)).exists()]  # fmt: skip
        self.limits = HomographyRange(scale=1.3, rotation=0.3, full_rotation_share=0.3, perspective=0.1)

    @staticmethod
    def other(path):
        return path.with_name(path.name.replace("_1.png", "_2.png"))

    def __len__(self):
        return len(self.pairs)

    def draw(self, index, generator):
        paths = self.pairs[index], self.other(self.pairs[index])
        images = [load_grey(path) for path in paths]
        labels = [numpy.load(label_path(self.labels, path)) for path in paths]
        pixels = [label["pixels"] for label in labels]
        moved = flow_at(load_flow(paths[0]), pixels[0])
        confirmed, weights = self.weights(labels, moved)
        height, width = images[0].shape
        base = window(generator, width, height, (0.5, 1.0))
        target = self.follow(base, pixels[0], moved, generator)
        first = cut(images[0], base, pixels[0], weights[0], generator, self.photometric)
        second = cut(images[1], target, pixels[1], weights[1], generator, self.photometric)
        places = transform(base, pixels[0]), transform(target, moved)
        chosen = numpy.flatnonzero(within(places[0]) & within(places[1]) & confirmed)
        places, rows = correspondences(*places, chosen, generator)
        return sample(first, second, places, rows, labels[0]["descriptors"], numpy.zeros((3, 3)))

    def weights(self, labels, moved):
        """Which labels of the first image have a counterpart in the second (or an unknown place there), and both images' weights."""
        weights = [sureness(label["scores"]) for label in labels]
        known = numpy.isfinite(moved).all(axis=1)
        confirmed = ~known
        if known.any() and len(labels[1]["pixels"]) > 0:
            distance, _ = cKDTree(labels[1]["pixels"]).query(moved[known])
            confirmed[known] = distance < 2.0
        weights[0] = weights[0] * numpy.where(confirmed, 1.0, self.DOUBTFUL)
        return confirmed, weights

    def follow(self, base, pixels, moved, generator):
        """A window of the second image that shows what the first one's shows, turned and scaled at random."""
        shown = within(transform(base, pixels)) & numpy.isfinite(moved).all(axis=1)
        shift = numpy.median(moved[shown] - pixels[shown], axis=0) if shown.any() else numpy.zeros(2)
        offset = numpy.array([[1, 0, -shift[0]], [0, 1, -shift[1]], [0, 0, 1]])
        return random_homography(generator, WIDTH, HEIGHT, self.limits) @ base @ offset


def load_flow(path):
    """Where each pixel of the first image of a pair lies in the second: 2 × height × width, NaN where it is not seen."""
    cached = path.with_name(path.name.replace("_1.png", "_flow.npy"))
    if not cached.exists():
        bands = read_two_bands(path.with_name(path.name.replace("_1.png", "_flow.tif")))
        partial = cached.with_name(f"{cached.stem}.{os.getpid()}.npy")  # several processes may come here at once
        numpy.save(partial, bands)
        partial.replace(cached)
    return numpy.load(cached, mmap_mode="r")


def flow_at(flow, pixels):
    """The flow at pixels (n × 2) by the nearest one and the offset to it."""
    columns = numpy.clip(numpy.rint(pixels[:, 0]).astype(int), 0, flow.shape[2] - 1)
    rows = numpy.clip(numpy.rint(pixels[:, 1]).astype(int), 0, flow.shape[1] - 1)
    offset = pixels - numpy.stack([columns, rows], axis=1)
    return numpy.stack([flow[0, rows, columns], flow[1, rows, columns]], axis=1) + offset


def read_two_bands(path):
    """The flow's GeoTIFF: pillow reads one band alone, so tifffile does."""
    import tifffile

    bands = tifffile.imread(path)
    return numpy.ascontiguousarray(bands if bands.shape[0] == 2 else bands.transpose(2, 0, 1), dtype=numpy.float32)


class Mixture(Dataset):
    """`length` samples; each is drawn by its own number, so that a run that resumes goes on with the same ones."""

    def __init__(self, datasets, shares, length, seed):
        self.datasets = [dataset for dataset in datasets if len(dataset) > 0]
        shares = numpy.array([share for dataset, share in zip(datasets, shares) if len(dataset) > 0], dtype=float)
        self.shares = shares / max(shares.sum(), 1e-9)
        self.length, self.seed = length, seed
        self.share(start=0, batch=1, rank=0, processes=1)

    def share(self, start, batch, rank, processes):
        """Begins at `start`, counted in samples of one process, and leaves to each of `processes` every so many batches."""
        self.start, self.batch, self.rank, self.processes = start, batch, rank, processes

    def __len__(self):
        return self.length // self.processes - self.start

    def __getitem__(self, index):
        block, place = divmod(index + self.start, self.batch)
        number = (block * self.processes + self.rank) * self.batch + place
        generator = numpy.random.default_rng([self.seed, number])
        dataset = self.datasets[generator.choice(len(self.datasets), p=self.shares)]
        return dataset.draw(int(generator.integers(len(dataset))), generator)
