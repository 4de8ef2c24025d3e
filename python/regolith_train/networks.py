# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""The three feature networks: an encoder to 1/8 resolution, a detector head and a descriptor head.

Every network maps a grey image, batch × 1 × height × width with sides divisible by 8 and values `inputs(network, grey / 255)`, to

  logits       batch × 65 × height/8 × width/8: the 64 pixels of each 8 × 8 cell, row by row, then "no keypoint here"
  descriptors  batch × dimension × height/8 × width/8, unit length along the second axis; the one of cell (i, j) belongs
               to the cell's centre, pixel (8 j + 3.5, 8 i + 3.5)

Sources: SuperPoint (DeTone et al. 2018, the two heads); GhostNet (Han et al. 2020: the Ghost module, the bottleneck, its table
of layers); SqueezeNet-and-excitation (Hu et al. 2018).
"""

import torch
from torch import nn
from torch.nn import functional

CELL = 8


def divisible(channels, divisor=4):
    """Channels rounded to a multiple of `divisor`, never down by more than a tenth, as GhostNet scales its widths."""
    rounded = max(divisor, int(channels + divisor / 2) // divisor * divisor)
    return rounded + divisor if rounded < 0.9 * channels else rounded


def convolution(inputs, outputs, size=3, stride=1, groups=1, activate=True):
    layers = [
        nn.Conv2d(inputs, outputs, size, stride, size // 2, groups=groups, bias=False),
        nn.BatchNorm2d(outputs),
    ]
    if activate:
        layers.append(nn.ReLU(inplace=True))
    return nn.Sequential(*layers)


class GhostModule(nn.Module):
    """Half of the channels by a 1 × 1 convolution, the other half from those by a cheap depthwise one."""

    def __init__(self, inputs, outputs, activate=True):
        super().__init__()
        primary = (outputs + 1) // 2
        self.outputs = outputs
        self.primary = convolution(inputs, primary, size=1, activate=activate)
        self.cheap = convolution(primary, primary, size=3, groups=primary, activate=activate)

    def forward(self, features):
        primary = self.primary(features)
        return torch.cat([primary, self.cheap(primary)], dim=1)[:, : self.outputs]


class SqueezeExcitation(nn.Module):
    """Weights channels by what the whole image holds."""

    def __init__(self, channels):
        super().__init__()
        squeezed = divisible(channels / 4)
        self.reduce = nn.Conv2d(channels, squeezed, 1)
        self.expand = nn.Conv2d(squeezed, channels, 1)

    def forward(self, features):
        weights = functional.relu(self.reduce(features.mean((2, 3), keepdim=True)))
        return features * functional.relu6(self.expand(weights) + 3.0) / 6.0


class GhostBottleneck(nn.Module):
    """Expansion and compression by Ghost modules, with a depthwise convolution between them where it strides."""

    def __init__(self, inputs, expanded, outputs, stride=1, excite=False):
        super().__init__()
        layers = [GhostModule(inputs, expanded)]
        if stride > 1:
            layers.append(convolution(expanded, expanded, 3, stride, groups=expanded, activate=False))
        if excite:
            layers.append(SqueezeExcitation(expanded))
        layers.append(GhostModule(expanded, outputs, activate=False))
        self.main = nn.Sequential(*layers)
        self.shortcut = nn.Identity()
        if stride > 1 or inputs != outputs:
            self.shortcut = nn.Sequential(
                convolution(inputs, inputs, 3, stride, groups=inputs, activate=False),
                convolution(inputs, outputs, 1, activate=False),
            )

    def forward(self, features):
        return self.main(features) + self.shortcut(features)


class Heads(nn.Module):
    """SuperPoint's: a 3 × 3 and a 1 × 1 convolution each."""

    def __init__(self, inputs, dimension, width=256):
        super().__init__()
        self.detector = nn.Sequential(convolution(inputs, width), nn.Conv2d(width, CELL * CELL + 1, 1))
        self.descriptor = nn.Sequential(convolution(inputs, width), nn.Conv2d(width, dimension, 1))

    def forward(self, features):
        return self.detector(features), functional.normalize(self.descriptor(features), dim=1)


class SuperPoint(nn.Module):
    """SuperPoint's VGG encoder: 64-64-64-64-128-128-128-128 with three poolings."""

    dimension = 256
    per_image = False

    def __init__(self):
        super().__init__()
        widths = [64, 64, 64, 64, 128, 128, 128, 128]
        layers, inputs = [], 1
        for index, outputs in enumerate(widths):
            layers.append(convolution(inputs, outputs))
            if index in (1, 3, 5):
                layers.append(nn.MaxPool2d(2))
            inputs = outputs
        self.encoder = nn.Sequential(*layers)
        self.heads = Heads(inputs, self.dimension)

    def forward(self, image):
        return self.heads(self.encoder(image))


class GhostPaper(nn.Module):
    """The paper's encoder: GhostNet's first convolution and six bottlenecks, width × 1.2, the heads of SuperPoint."""

    dimension = 256
    per_image = False
    # expanded, outputs, stride, squeeze-and-excitation
    BOTTLENECKS = [(16, 16, 1, False), (48, 24, 2, False), (72, 24, 1, False),
                   (72, 40, 2, True), (120, 40, 1, True), (240, 80, 1, False)]  # fmt: skip

    def __init__(self, width=1.2):
        super().__init__()
        inputs = divisible(16 * width)
        layers = [convolution(1, inputs, stride=2)]
        for expanded, outputs, stride, excite in self.BOTTLENECKS:
            expanded, outputs = divisible(expanded * width), divisible(outputs * width)
            layers.append(GhostBottleneck(inputs, expanded, outputs, stride, excite))
            inputs = outputs
        self.encoder = nn.Sequential(*layers)
        self.heads = Heads(inputs, self.dimension)

    def forward(self, image):
        return self.heads(self.encoder(image))


class Blur(nn.Module):
    """Binomial 3 × 3 blur of each channel: without it, what a strided convolution sees depends on where its grid lies (Zhang 2019)."""

    def __init__(self, channels):
        super().__init__()
        taps = torch.tensor([0.25, 0.5, 0.25])
        self.register_buffer("kernel", torch.outer(taps, taps).repeat(channels, 1, 1, 1), persistent=False)

    def forward(self, features):
        return functional.conv2d(features, self.kernel, padding=1, groups=features.shape[1])


class Ghost(nn.Module):
    """Ours: the paper's idea made slim. Where the time of `GhostPaper` goes (its first layers at 1/2 resolution, heads 256 wide)
    plain strided convolutions of few channels stand instead; Ghost bottlenecks do the work at 1/8.

    The detector works at 1/2: each place says the scores of its 2 × 2 pixels, from the features there and, lifted, those at 1/4 and
    1/8. A head at 1/8 has to learn a corner once for each of the 64 places in a cell, and its keypoints come to depend on where the
    cells lie (docs/features.md has the figures).
    """

    per_image = True

    def __init__(self, half=16, quarter=24, eighth=64, depth=4, width=64, lifted=8, dimension=128):
        super().__init__()
        self.dimension = dimension
        self.stem = convolution(1, half, size=5, stride=2)
        self.middle = nn.Sequential(Blur(half), convolution(half, quarter, stride=2),
                                    GhostBottleneck(quarter, 2 * quarter, quarter))  # fmt: skip
        self.deep = nn.Sequential(Blur(quarter), convolution(quarter, eighth, stride=2),
                                  *[GhostBottleneck(eighth, 2 * eighth, eighth) for _ in range(depth)])  # fmt: skip
        self.context = nn.Conv2d(eighth, quarter, 1)
        self.lift = nn.Conv2d(quarter, lifted, 1)
        self.corner = nn.Sequential(convolution(half + lifted, half), nn.Conv2d(half, 4, 3, padding=1))
        self.none = nn.Conv2d(eighth, 1, 1)
        self.descriptor = nn.Sequential(convolution(eighth, width), nn.Conv2d(width, self.dimension, 1))

    def forward(self, image):
        half = self.stem(image)
        quarter = self.middle(half)
        eighth = self.deep(quarter)
        lifted = self.lift(functional.relu(quarter + twice(self.context(eighth))))
        corners = self.corner(torch.cat([half, twice(lifted)], dim=1))
        pixels = functional.pixel_unshuffle(functional.pixel_shuffle(corners, 2), CELL)
        logits = torch.cat([pixels, self.none(eighth)], dim=1)
        return logits, functional.normalize(self.descriptor(eighth), dim=1)


def normalise(image, floor=0.02):
    """Images by their own mean and deviation (the latter at least about `floor`, so that noise stays small), so that exposure does
    not matter."""
    centred = image - image.mean((2, 3), keepdim=True)
    return centred / ((centred * centred).mean((2, 3), keepdim=True) + floor**2).sqrt()


def inputs(network, images):
    """What a network takes for images of 0 to 1."""
    return normalise(images) if network.per_image else images


def twice(features):
    return functional.interpolate(features, scale_factor=2.0, mode="bilinear", align_corners=False)


NETWORKS = {"ghost": Ghost, "ghost_paper": GhostPaper, "superpoint": SuperPoint}


def build(name, shape=None):
    """The network of that name; `shape` are arguments of its class, where it is wider or deeper than the one that is shipped."""
    try:
        return NETWORKS[name](**(shape or {}))
    except TypeError as error:
        raise ValueError(f"network {name} has no such shape: {shape} ({error})") from error


def restored(name, checkpoint):
    """The network of a training run's checkpoint with the averaged weights, for inference."""
    network = build(name, checkpoint["options"].get("shape"))
    network.load_state_dict(checkpoint["average"])
    return network.eval()
