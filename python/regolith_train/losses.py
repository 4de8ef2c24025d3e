# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""What is minimised. `paper_loss` is the paper's, section 2.2.3; `ghost_loss` is what our own network learns by."""

import torch
from torch.nn import functional

from regolith_train.networks import CELL


def detector_targets(labels, height, width, soft):
    """Keypoint labels (batch × n × 3: x, y, weight) as distributions over the 65 channels: batch × 65 × height/8 × width/8.

    Soft: a keypoint between pixels is shared among its four, so the scores say where in the pixel it lies. Hard: the whole of a
    cell is its strongest label (the first), as SuperPoint does.
    """
    batch, rows, columns = labels.shape[0], height // CELL, width // CELL
    density = labels.new_zeros(batch, height, width)
    x, y, weight = labels[..., 0], labels[..., 1], labels[..., 2]
    index = torch.arange(batch, device=labels.device)[:, None].expand_as(x)
    if soft:
        left, top = x.floor(), y.floor()
        for dy in (0, 1):
            for dx in (0, 1):
                share = (1 - (x - left - dx).abs()) * (1 - (y - top - dy).abs()) * weight
                column, row = (left + dx).long().clamp(0, width - 1), (top + dy).long().clamp(0, height - 1)
                density.index_put_((index, row, column), share, accumulate=True)
    else:
        column, row = x.round().long().clamp(0, width - 1), y.round().long().clamp(0, height - 1)
        order = torch.arange(x.shape[1], 0, -1, device=x.device, dtype=density.dtype)
        density.index_put_((index, row, column), weight * (1 + order), accumulate=True)
    cells = functional.pixel_unshuffle(density[:, None], CELL)
    if not soft:
        best = cells.argmax(1, keepdim=True)
        cells = torch.zeros_like(cells).scatter_(1, best, (cells.amax(1, keepdim=True) > 0).to(cells.dtype))
    total = cells.sum(1, keepdim=True)
    empty = (1 - total).clamp(min=0)
    assert cells.shape[2:] == (rows, columns)
    return torch.cat([cells, empty], dim=1) / (total + empty)


def detector_loss(logits, labels, inside, soft):
    """Cross-entropy a cell, over the cells that lie inside the picture."""
    height, width = inside.shape[-2:]
    targets = detector_targets(labels, height, width, soft)
    seen = functional.avg_pool2d(inside.to(logits.dtype), CELL)[:, 0] > 0.99
    entropy = -(targets * functional.log_softmax(logits.float(), dim=1)).sum(1)
    return (entropy * seen).sum() / seen.sum().clamp(min=1)


def sample_descriptors(descriptors, places):
    """Descriptors (batch × dimension × h/8 × w/8) at pixels (batch × n × 2): batch × n × dimension, unit length."""
    rows, columns = descriptors.shape[-2:]
    size = places.new_tensor([columns * CELL, rows * CELL])
    grid = (2 * places + 1) / size - 1
    sampled = functional.grid_sample(descriptors.float(), grid[:, :, None], align_corners=False, padding_mode="border")
    return functional.normalize(sampled[..., 0].transpose(1, 2), dim=-1)


def products(first, second):
    """Inner products of all pairs of rows, in f32: autocast's bf16 would not tell cosines apart that differ by less than 1/128, which
    at the start of a training are all of them."""
    with torch.autocast(first.device.type, enabled=False):
        return first.float() @ second.float().transpose(-1, -2)


def triplet_loss(first, second, places, valid, margin=1.0, negatives=8, radius=16.0):
    """The paper's sparse descriptor loss: a correspondence shall be nearer than M others by `margin` in the mean. They are the M next
    ones in the second view, at least `radius` pixels away ("the surrounding area"), and for those apart from these already, the M
    nearest as descriptors. Those alone draw an untrained network's descriptors together: the loss stays at its margin."""
    distance = (2 - 2 * products(first, second)).clamp(min=0)
    positive = distance.diagonal(dim1=1, dim2=2)
    away = torch.cdist(places, places)
    allowed = (away >= radius) & valid[:, None, :]
    anchors = valid & allowed.any(2)

    def hinge(order):
        chosen = order.masked_fill(~allowed, float("inf")).topk(negatives, dim=2, largest=False)
        usable = torch.isfinite(chosen.values)
        negative = (distance.gather(2, chosen.indices) * usable).sum(2) / usable.sum(2).clamp(min=1)
        return functional.relu(margin + positive - negative)

    around = hinge(away)
    loss = torch.where(around > 0, around, hinge(distance.detach())) * anchors
    return loss.sum() / anchors.sum().clamp(min=1)


def contrastive_loss(first, second, teacher, places, valid, temperature, teacher_share=0.4, radius=6.0):
    """InfoNCE over the whole batch (van den Oord et al. 2018), its targets softened by how alike the teacher says that the points
    are. Points nearer than `radius` to the true one are no negatives: bilinear descriptors cannot tell them apart."""
    batch, count, _ = first.shape
    similarity = products(first.reshape(batch * count, -1), second.reshape(batch * count, -1)) / temperature
    near = torch.zeros(batch, count, batch, count, dtype=torch.bool, device=first.device)
    index = torch.arange(batch)
    near[index, :, index] = torch.cdist(places, places) < radius
    near = near.reshape(batch * count, -1)
    near.fill_diagonal_(False)
    usable = valid.reshape(-1)
    excluded = near | ~usable[None, :]
    similarity = similarity.masked_fill(excluded, -1e4)
    likeness = products(teacher.reshape(batch * count, -1), teacher.reshape(batch * count, -1)) / 0.06
    alike = functional.softmax(likeness.masked_fill(excluded, -1e4), dim=1)
    target = (1 - teacher_share) * torch.eye(batch * count, device=first.device) + teacher_share * alike
    rows = -(target * functional.log_softmax(similarity, dim=1)).sum(1)
    columns = -(target.T * functional.log_softmax(similarity, dim=0)).sum(0)
    return ((rows + columns) * usable).sum() / (2 * usable.sum().clamp(min=1))


def paper_loss(network, sample, weight=1.2):
    """(L_p + L_wp) + λ L_d, with λ = 1.2."""
    logits, descriptors = network(sample["inputs"])
    detection = 2 * detector_loss(logits, flat(sample["labels"]), flat(sample["inside"]), soft=False)
    first, second = both(descriptors, sample["places"])
    description = triplet_loss(first, second, sample["places"][:, 1], sample["valid"])
    return {"detector": detection, "descriptor": description, "loss": detection + weight * description}


def smoothed_scores(logits):
    """Probability that a keypoint lies in the 3 × 3 pixels around each pixel, batch × 1 × height × width."""
    scores = functional.pixel_shuffle(functional.softmax(logits.float(), dim=1)[:, :-1], CELL)
    return 9 * functional.avg_pool2d(scores, 3, 1, 1)


def repeatability_loss(logits, inside, homographies, floor=0.003):
    """How far (in their logarithm) scores differ from those at the same place of the other view, over pixels weighted by their
    scores. `homographies` (batch × 3 × 3) take pixels of the first views to the second; all 0 where that is not known."""
    height, width = inside.shape[-2:]
    first, second = smoothed_scores(logits).unflatten(0, (-1, 2)).unbind(1)
    rows, columns = torch.meshgrid(torch.arange(height, dtype=torch.float32, device=logits.device),
                                   torch.arange(width, dtype=torch.float32, device=logits.device), indexing="ij")  # fmt: skip
    # Not a matrix product: autocast would take it in bf16, which has pixels to a few pixels.
    mapped = sum(homographies[:, None, None, :, axis] * values[None, :, :, None]
                 for axis, values in enumerate((columns, rows, torch.ones_like(rows))))  # fmt: skip
    grid = (2 * mapped[..., :2] / mapped[..., 2:].clamp(min=1e-6) + 1) / torch.tensor([width, height], device=logits.device) - 1
    both_inside = torch.cat([second, inside[1::2].float()], dim=1)
    warped, seen = functional.grid_sample(both_inside, grid, align_corners=False).unbind(1)
    known = (homographies[:, 2, 2] > 0)[:, None, None]
    weight = 0.5 * (first[:, 0] + warped).detach() * (seen > 0.99) * inside[0::2, 0] * known
    difference = ((first[:, 0] + floor).log() - (warped + floor).log()).abs()
    return (weight * difference).sum() / weight.sum().clamp(min=1)


def ghost_loss(network, sample, weight=0.7, temperature=0.07, repeatability_weight=1.5):
    logits, descriptors = network(sample["inputs"])
    detection = 2 * detector_loss(logits, flat(sample["labels"]), flat(sample["inside"]), soft=True)
    first, second = both(descriptors, sample["places"])
    description = contrastive_loss(first, second, sample["teacher"], sample["places"][:, 1], sample["valid"], temperature)
    repeatability = repeatability_loss(logits, flat(sample["inside"]), sample["homography"])
    loss = detection + weight * description + repeatability_weight * repeatability
    return {"detector": detection, "descriptor": description, "repeatability": repeatability, "loss": loss}


def flat(values):
    """Views of a batch (batch × 2 × ...) as a batch of views (2 batch × ...), both of a sample next to each other."""
    return values.flatten(0, 1)


def both(descriptors, places):
    sampled = sample_descriptors(descriptors, flat(places))
    return sampled[0::2], sampled[1::2]


LOSSES = {"paper": paper_loss, "ghost": ghost_loss}
