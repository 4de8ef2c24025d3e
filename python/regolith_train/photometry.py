# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Photometric augmentation: what light, exposure and sensor do to a picture of the same ground."""

import numpy
import torch
from torch.nn import functional


def augment(image, generator, strength=1.0):
    """A changed copy of a grey torch image (1 × h × w, 0 to 1), quantised to 8 bits as a camera does."""
    height, width = image.shape[-2:]
    if generator.uniform() < 0.3:
        image = blur(image, generator)
    if generator.uniform() < 0.4:
        image = image * shading(generator, height, width, strength)
    gamma = numpy.exp(0.35 * strength * generator.uniform(-1, 1))
    image = image.clamp(min=0) ** gamma
    mean = float(image.mean())
    contrast = numpy.exp(0.4 * strength * generator.uniform(-1, 1))
    gain = numpy.exp(0.5 * strength * generator.uniform(-1, 1))
    image = ((image - mean) * contrast + mean) * gain
    if generator.uniform() < 0.15:
        image = image * generator.uniform(0.15, 0.5)
    noise = 0.025 * strength * generator.uniform() ** 2
    image = image + noise * torch.from_numpy(generator.standard_normal((1, height, width)).astype(numpy.float32))
    return (image.clamp(0, 1) * 255).round() / 255


def blur(image, generator):
    """Gaussian blur, sometimes along one line only, as motion blurs."""
    sigma = generator.uniform(0.4, 1.4)
    if generator.uniform() < 0.5:
        taps = torch.exp(-0.5 * (torch.arange(-3, 4) / sigma) ** 2)
        kernel = torch.outer(taps, taps)
    else:
        kernel = motion_kernel(generator.uniform(0, numpy.pi), sigma * 1.5)
    return functional.conv2d(image[None], (kernel / kernel.sum())[None, None], padding=3)[0]


def motion_kernel(angle, length):
    offsets = torch.arange(-3, 4, dtype=torch.float32)
    rows, columns = torch.meshgrid(offsets, offsets, indexing="ij")
    along = columns * numpy.cos(angle) + rows * numpy.sin(angle)
    across = -columns * numpy.sin(angle) + rows * numpy.cos(angle)
    return torch.exp(-0.5 * (across / 0.5) ** 2) * torch.exp(-0.5 * (along / length) ** 2)


def shading(generator, height, width, strength):
    """A smooth brightness field, or a soft-edged shadow."""
    coarse = torch.from_numpy(generator.uniform(1 - 0.6 * strength, 1.2, (1, 1, 4, 4)).astype(numpy.float32))
    field = functional.interpolate(coarse, (height, width), mode="bicubic", align_corners=False)[0]
    if generator.uniform() < 0.4:
        angle, place = generator.uniform(0, 2 * numpy.pi), generator.uniform(-0.3, 0.3)
        rows, columns = torch.meshgrid(torch.linspace(-0.5, 0.5, height), torch.linspace(-0.5, 0.5, width), indexing="ij")
        edge = columns * numpy.cos(angle) + rows * numpy.sin(angle) - place
        field = field * (1 - generator.uniform(0.3, 0.8) * torch.sigmoid(edge * generator.uniform(20, 200)))
    return field
