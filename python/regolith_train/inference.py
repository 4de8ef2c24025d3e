# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Keypoints and descriptors from a network's outputs, as the C++ program takes them: the second opinion on it."""

import torch
from torch.nn import functional

from regolith_train.losses import sample_descriptors
from regolith_train.networks import CELL, inputs


def score_map(logits):
    """Probability that each pixel is a keypoint, batch × 1 × height × width."""
    return functional.pixel_shuffle(functional.softmax(logits.float(), dim=1)[:, :-1], CELL)


def suppress(scores, radius):
    """Greedy non-maximum suppression, exact: keeps a pixel unless a stronger kept one lies within `radius` (a square), by rounds of
    local maxima."""
    kept = torch.zeros_like(scores, dtype=torch.bool)
    left = scores.clone()
    for _ in range(16):
        highest = functional.max_pool2d(left, 2 * radius + 1, 1, radius)
        new = (left == highest) & (left > 0)
        if not new.any():
            break
        kept |= new
        covered = functional.max_pool2d(kept.float(), 2 * radius + 1, 1, radius) > 0
        left = torch.where(covered, torch.zeros_like(left), left)
    return kept


def corner_weight(image):
    """Weight of each pixel's score by the corner that the image (height × width, 0 to 1) has there: 1 × 1 × height × width. See
    corner_weight.h: sqrt((λ + 0.003) / 0.0625), λ the smaller eigenvalue of the gradients' matrix, in variances of the image."""
    padded = functional.pad(image[None, None], (1, 1, 1, 1), mode="reflect")
    sobel = torch.tensor([[-1.0, 0, 1], [-2, 0, 2], [-1, 0, 1]]) / 20
    x, y = functional.conv2d(padded, torch.stack([sobel, sobel.T])[:, None])[0]
    xx, xy, yy = 25 * functional.avg_pool2d(torch.stack([x * x, x * y, y * y])[None], 5, 1, 2)[0]
    smaller = 0.5 * ((xx + yy) - ((xx - yy) ** 2 + 4 * xy * xy).sqrt()).clamp(min=0)
    variance = (image.std(unbiased=False) + 0.02) ** 2
    return ((smaller / variance + 0.003) / 0.0625).sqrt()[None, None]


def refine(scores, rows, columns, radius=2):
    """Sub-pixel places: the centre of mass of the scores in the 5 × 5 pixels around."""
    total = shift_x = shift_y = 0.0
    for dy in range(-radius, radius + 1):
        for dx in range(-radius, radius + 1):
            value = scores[rows + dy, columns + dx]
            total, shift_x, shift_y = total + value, shift_x + dx * value, shift_y + dy * value
    return torch.stack([columns + shift_x / total, rows + shift_y / total], dim=1)


@torch.inference_mode()
def detect_and_describe(network, image, count=500, radius=4, border=4, floor=0.0, subpixel=True):
    """The `count` strongest keypoints (n × 2), their scores and descriptors (n × dimension) of a grey image (height × width, 0 to
    1)."""
    height, width = image.shape
    taken = inputs(network, image[None, None])
    logits, descriptors = network(functional.pad(taken, (0, -width % CELL, 0, -height % CELL), mode="replicate"))
    scores = score_map(logits)[:, :, :height, :width]
    smoothed = 9 * functional.avg_pool2d(scores, 3, 1, 1) * corner_weight(image)
    kept = suppress(smoothed, radius)[0, 0]
    kept[:border], kept[-border:], kept[:, :border], kept[:, -border:] = False, False, False, False
    rows, columns = torch.nonzero(kept & (smoothed[0, 0] > floor), as_tuple=True)
    strengths = smoothed[0, 0, rows, columns]
    order = torch.argsort(strengths, descending=True, stable=True)[:count]
    rows, columns = rows[order], columns[order]
    pixels = torch.stack([columns, rows], dim=1).float()
    if subpixel:
        pixels = refine(scores[0, 0], rows, columns)
    return pixels, strengths[order], sample_descriptors(descriptors, pixels[None])[0]


def mutual_matches(first, second):
    """Mutual nearest neighbours of descriptors: two index tensors."""
    if len(first) == 0 or len(second) == 0:
        return torch.zeros(0, dtype=torch.long), torch.zeros(0, dtype=torch.long)
    similarity = first @ second.T
    forward, backward = similarity.argmax(1), similarity.argmax(0)
    rows = torch.arange(len(first))
    keep = backward[forward] == rows
    return rows[keep], forward[keep]
