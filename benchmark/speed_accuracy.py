#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Plots how good feature networks are over the time that they take on a VGA picture, 2 threads.

usage: speed_accuracy.py FEATURES.json --out PLOT.svg

FEATURES.json is what `python -m regolith_train evaluate` wrote; a run of ours is read from REGOLITH_CACHE/training. Ours and XFeat's
network run in OpenVINO (f32), without keypoint selection; ALIKED and DISK as their packages run them. In the environment of
benchmark/requirements_outside.txt.
"""

import argparse
import json
import pathlib
import sys
import tempfile

import torch
from outside_features import THREADS, median_ms, network_ms, picture, write_xfeat

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
from regolith_train.export import write_onnx
from regolith_train.methods import OUTSIDE, network_of
from regolith_train.networks import NETWORKS, inputs
from regolith_train.report import figure_of, save
from regolith_train.training import cache_folder

MODELS = pathlib.Path(__file__).resolve().parents[1] / "models"
IN_TORCH = ("aliked-n16", "disk")


def times(name, image):
    """Milliseconds of a method (f32, bf16) and its parameters; None where it has neither."""
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/network.onnx"
        if name.partition("@")[0] in NETWORKS:
            network = network_of(name, MODELS, cache_folder())
            write_onnx(network, path)
            values = inputs(network, image).numpy()
        elif name == "xfeat":
            network = write_xfeat(image, path)
            values = image.numpy()
        elif name in IN_TORCH:
            extract = OUTSIDE[name]()
            return median_ms(lambda: extract(image[0, 0])), None, None
        else:
            return None
        return network_ms(path, values, "f32"), network_ms(path, values, "bf16"), sum(p.numel() for p in network.parameters())


def accuracies(result):
    """Two figures of a method: right matches on graf and boat, and on simulated pairs under one sun 0.1 to 0.5 m apart."""
    homographies = [row["correct"] for row in result["oxford"].values()]
    near = [row["correct"] for name, row in result["simulated"].items() if "same sun, 0.1–0.5" in name]
    return sum(homographies) / len(homographies), sum(near) / len(near) if near else None


def plot(rows, path):
    figure, axes = figure_of(1, 2, figsize=(13, 5), sharex=True)
    titles = "graf and boat, mean", "simulated pairs, one sun, 0.1–0.5 m, mean of planets"
    for axis, title, which in zip(axes, titles, (0, 1)):
        for name, milliseconds, values in rows:
            if values[which] is None:
                continue
            axis.plot(milliseconds, values[which], "o" if name.partition("@")[0] in NETWORKS else "s", color="C0" if "@" in name else "C1")
            axis.annotate(name, (milliseconds, values[which]), xytext=(5, 4), textcoords="offset points", fontsize=8)
        axis.set_xscale("log")
        axis.margins(x=0.15)
        axis.set_title(title)
        axis.set_xlabel("ms a picture, 640 × 480, f32, 2 threads")
        axis.set_ylabel("correct matches of 500 keypoints, 3 px")
        axis.grid(alpha=0.3, which="both")
    save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("features", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    torch.set_num_threads(THREADS)
    results = json.loads(arguments.features.read_text(encoding="utf-8"))
    image = picture()
    rows = []
    print("| network | parameters | ms, f32 | ms, bf16 | graf and boat | simulated |\n|---|---|---|---|---|---|")
    for name, result in results.items():
        with torch.inference_mode():
            measured = times(name, image)
        if measured is None:
            continue
        values = accuracies(result)
        rows.append((name, measured[0], values))
        cells = [f"`{name}`", measured[2], *measured[:2], *values]
        print("| " + " | ".join(cell if isinstance(cell, str) else "–" if cell is None else f"{cell:,.0f}" if cell > 30 else f"{cell:.1f}"
                                for cell in cells) + " |", flush=True)  # fmt: skip
    plot(rows, arguments.out)


if __name__ == "__main__":
    main()
