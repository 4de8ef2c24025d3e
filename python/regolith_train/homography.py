# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Random homographies of scale, rotation and perspective, and warping by them. Pixel centres lie at integer coordinates."""

import dataclasses
import math

import numpy
import torch
from torch.nn import functional


@dataclasses.dataclass
class HomographyRange:
    """What random homographies are drawn from. Lengths are shares of the image's sides."""

    scale: float = 1.6  # largest factor; the smallest is its inverse
    rotation: float = 0.35  # rad, either way
    full_rotation_share: float = 0.0  # of the homographies that turn by up to 180 degrees
    perspective: float = 0.15
    translation: float = 0.1


def random_homography(generator, width, height, limits):
    """Maps pixels of an image to pixels of its warped view, both width × height: 3 × 3, float64."""
    centre = numpy.array([(width - 1) / 2, (height - 1) / 2])
    corners = numpy.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (centre + 0.5)
    moved = corners * (1 + limits.perspective * generator.uniform(-1, 1, (4, 2)))
    angle = limits.rotation * generator.uniform(-1, 1)
    if generator.uniform() < limits.full_rotation_share:
        angle = math.pi * generator.uniform(-1, 1)
    scale = limits.scale ** generator.uniform(-1, 1)
    rotation = scale * numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    shift = limits.translation * generator.uniform(-1, 1, 2) * (width, height)
    return homography_from_points(corners + centre, moved @ rotation.T + centre + shift)


def homography_from_points(first, second):
    """The homography that takes four points (4 × 2) to four others."""
    rows = []
    for (x, y), (u, v) in zip(first, second):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y])
    solution = numpy.linalg.solve(numpy.array(rows), numpy.asarray(second).reshape(-1))
    return numpy.append(solution, 1.0).reshape(3, 3)


def transform(homography, points):
    """Points (n × 2) under a homography; those behind the image plane become NaN."""
    mapped = numpy.concatenate([points, numpy.ones((len(points), 1))], axis=1) @ homography.T
    depth = numpy.where(mapped[:, 2:] > 1e-6, mapped[:, 2:], numpy.nan)
    return mapped[:, :2] / depth


def warp_image(image, homography, width, height, continued=False):
    """A torch image (1 × h × w) as seen through a homography; outside it is 0, or its last pixels go on where it is `continued`.
    Also where it is inside (1 × height × width)."""
    inverse = torch.from_numpy(numpy.linalg.inv(homography)).to(torch.float32)
    rows, columns = torch.meshgrid(torch.arange(height, dtype=torch.float32),
                                   torch.arange(width, dtype=torch.float32), indexing="ij")  # fmt: skip
    pixels = torch.stack([columns, rows, torch.ones_like(rows)], dim=-1) @ inverse.T
    source = pixels[..., :2] / pixels[..., 2:].clamp(min=1e-6)
    size = torch.tensor([image.shape[-1], image.shape[-2]], dtype=torch.float32)
    grid = (2 * source + 1) / size - 1
    inside = ((source >= 0) & (source <= size - 1)).all(-1) & (pixels[..., 2] > 1e-6)
    if continued:
        return functional.grid_sample(image[None], grid[None], align_corners=False, padding_mode="border")[0], inside[None]
    return functional.grid_sample(image[None], grid[None], align_corners=False)[0] * inside, inside[None]
