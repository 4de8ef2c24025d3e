# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""The vocabulary of the global descriptor (VLAD, Jégou et al. 2010): centres of the descriptors that a network gives on training
images, by spherical k-means."""

import pathlib

import numpy
import torch

from regolith_train.inference import detect_and_describe
from regolith_train.labels import load_grey


def collect(network, images, count=200):
    network.eval()
    rows = [detect_and_describe(network, torch.from_numpy(load_grey(path)), count)[2] for path in images]
    return torch.cat(rows)


def spread_rows(rows, count, generator):
    """Rows to begin with, each drawn by its squared distance from those before it (k-means++, Arthur and Vassilvitskii 2007): of rows
    drawn evenly two may lie in one cluster, and no round brings them apart."""
    chosen = [int(torch.randint(len(rows), (1,), generator=generator))]
    distance = torch.full((len(rows),), float("inf"))
    while len(chosen) < count:
        distance = torch.minimum(distance, (2 - 2 * rows @ rows[chosen[-1]]).clamp(min=1e-9))
        chosen.append(int(torch.multinomial(distance, 1, generator=generator)))
    return rows[chosen].clone()


def spherical_kmeans(rows, words, rounds=40, seed=1):
    """`words` unit centres (words × dimension) of unit rows; a centre that loses all its rows takes the row furthest from its
    own."""
    centres = spread_rows(rows, words, torch.Generator().manual_seed(seed))
    for _ in range(rounds):
        similarity = rows @ centres.T
        nearest, owner = similarity.max(1)
        sums = torch.zeros_like(centres).index_add_(0, owner, rows)
        empty = torch.bincount(owner, minlength=words) == 0
        if empty.any():
            sums[empty] = rows[nearest.argsort()[: int(empty.sum())]]
        centres = torch.nn.functional.normalize(sums, dim=1)
    return centres


def write_vocabulary(network, images, path, words=32):
    """Writes dimension × words, float32 (.npy)."""
    centres = spherical_kmeans(collect(network, images), words)
    path = pathlib.Path(path)
    partial = path.with_suffix(".partial.npy")
    numpy.save(partial, numpy.ascontiguousarray(centres.T.numpy().astype(numpy.float32)))
    partial.replace(path)
