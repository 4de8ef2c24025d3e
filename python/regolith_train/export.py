# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a trained network as the C++ program reads it: ONNX, manifest and parity tensors."""

import hashlib
import pathlib
import warnings

import numpy
import torch
import yaml

from regolith_train.networks import CELL, build, inputs

OPSET = 17
PARITY_HEIGHT, PARITY_WIDTH = 64, 96
INPUT, LOGITS, DESCRIPTORS = "image", "logits", "descriptors"


def parity_input():
    """A picture of 8 bits with corners, flats and noise, made of the same numbers everywhere, 0 to 1."""
    rows, columns = numpy.mgrid[0:PARITY_HEIGHT, 0:PARITY_WIDTH]
    blocks = ((rows // 11 + columns // 13) % 3) * 0.3
    noise = numpy.random.default_rng(5).uniform(0, 0.1, (PARITY_HEIGHT, PARITY_WIDTH))
    return (numpy.rint(255 * (blocks + noise)) / 255).astype(numpy.float32)[None, None]


def write_onnx(network, path):
    """Weights keep their names (nothing is folded or fused; OpenVINO does that), so that training can start from the file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        extra = {"dynamo": False} if torch.__version__ >= "2.5" else {}
        torch.onnx.export(network, (torch.zeros(1, 1, 64, 96),), str(path), opset_version=OPSET, do_constant_folding=False,
                          input_names=[INPUT], output_names=[LOGITS, DESCRIPTORS],
                          dynamic_axes={name: {2: "height", 3: "width"} for name in (INPUT, LOGITS, DESCRIPTORS)},
                          training=torch.onnx.TrainingMode.PRESERVE, **extra)  # fmt: skip


def read_weights(path):
    """The state of a network from its ONNX file, by the weights' names."""
    import onnx
    from onnx import numpy_helper

    graph = onnx.load(str(path)).graph
    return {tensor.name: torch.from_numpy(numpy_helper.to_array(tensor).copy()) for tensor in graph.initializer}


def export(name, state, folder, training):
    """models/NAME.onnx, NAME.yaml and parity/NAME_*.npy. `training` goes into the manifest as it is."""
    network = build(name, training["options"].get("shape"))
    network.load_state_dict(state)
    network.eval()
    folder = pathlib.Path(folder)
    (folder / "parity").mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.onnx"
    partial = folder / f"{name}.partial.onnx"
    write_onnx(network, partial)
    partial.replace(path)
    image = parity_input()
    with torch.inference_mode():
        logits, descriptors = network(inputs(network, torch.from_numpy(image)))
    tensors = {"input": image, "logits": logits.numpy(), "descriptors": descriptors.numpy()}
    for kind, values in tensors.items():
        numpy.save(folder / "parity" / f"{name}_{kind}.npy", numpy.ascontiguousarray(values, dtype=numpy.float32))
    manifest = {
        "name": name,
        "file": path.name,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
        "input": {"name": INPUT, "shape": [1, 1, -1, -1]},
        "outputs": {LOGITS: {"name": LOGITS, "shape": [1, CELL * CELL + 1, -1, -1]},
                    DESCRIPTORS: {"name": DESCRIPTORS, "shape": [1, network.dimension, -1, -1]}},  # fmt: skip
        "normalisation": {"mean": 0.0, "scale": 1.0, "per_image": network.per_image},
        "training": training,
        "parity": {kind: f"parity/{name}_{kind}.npy" for kind in tensors},
    }
    (folder / f"{name}.yaml").write_text(yaml.safe_dump(manifest, sort_keys=False, width=110), encoding="utf-8")
    return path
