#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of docs/images by the program itself: camera frames, terrains, a lidar sweep.

Needs the tools of `scripts/setup.sh test`. Takes about three minutes.
"""

import argparse
import io
import pathlib
import subprocess
import tempfile

import matplotlib
import numpy
from PIL import Image
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_typestore

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

ROOT = pathlib.Path(__file__).parents[1]
PROGRAM = ROOT / "build/release/regolith"
TYPES = get_typestore(Stores.ROS1_NOETIC)
CAMERA = "/camera/mono/image_raw"
# Scenario, seconds, and the frames to show.
DRIVES = {"lunar_short": (26, (190, 255)), "mars_short": (16, (60, 150)), "lunar_dark": (6, (40,))}


def regolith(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments), "--overwrite", "--quiet"], check=True)


def messages(bag, topic):
    with Reader(bag) as reader:
        connections = [c for c in reader.connections if c.topic.startswith(topic)]
        for connection, _, raw in reader.messages(connections=connections):
            if "camera_info" not in connection.topic:
                yield TYPES.deserialize_ros1(raw, connection.msgtype)


def save_frames(bag, wanted, target, name):
    for index, message in enumerate(messages(bag, CAMERA)):
        if index in wanted:
            frame = Image.open(io.BytesIO(bytes(message.data))).convert("L")
            frame.save(target / f"{name}_frame_{wanted.index(index) + 1}.jpg", quality=88)


def points_of(cloud):
    """x y z intensity of a cloud's points."""
    fields = {field.name: field.offset for field in cloud.fields}
    rows = numpy.asarray(cloud.data).reshape(-1, cloud.point_step)
    columns = [rows[:, fields[n]:fields[n] + 4].copy().view("<f4") for n in "xyz"]
    return numpy.hstack(columns)


def save_sweep(bag, index, target):
    for number, cloud in enumerate(messages(bag, "/velodyne_points")):
        if number == index:
            break
    points = points_of(cloud)
    figure, axes = pyplot.subplots(figsize=(7, 7), facecolor="black")
    axes.set_facecolor("black")
    image = axes.scatter(points[:, 0], points[:, 1], s=1.2, c=points[:, 2], cmap="viridis", vmin=-4, vmax=2, linewidths=0)
    axes.plot(0, 0, "r^", markersize=7)
    axes.set(xlim=(-25, 25), ylim=(-25, 25), aspect="equal")
    axes.set_xlabel("m ahead", color="white")
    axes.set_ylabel("m to the left", color="white")
    axes.tick_params(colors="white")
    bar = figure.colorbar(image, ax=axes, shrink=0.7)
    bar.set_label("m above the lidar", color="white")
    bar.ax.tick_params(colors="white")
    figure.tight_layout()
    figure.savefig(target, dpi=100, facecolor="black")
    pyplot.close(figure)


def save_terrains(folder, target):
    for planet in ("moon", "mars"):
        out = folder / planet
        regolith("terrain", "--statistics", planet, "--out", out)
        preview = Image.open(out / "preview.png").convert("L")
        preview.resize((640, 640), Image.LANCZOS).save(target / f"terrain_{planet}.jpg", quality=85)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/images")
    target = parser.parse_args().out
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        save_terrains(folder, target)
        for scenario, (seconds, wanted) in DRIVES.items():
            out = folder / scenario
            regolith("simulate", "--scenario", scenario, "--duration", seconds, "--out", out)
            save_frames(out / "recording.bag", wanted, target, scenario)
            if scenario == "lunar_short":
                save_sweep(out / "recording.bag", 200, target / "lidar_sweep.png")
                preview = Image.open(out / "preview.png").convert("L")
                preview.save(target / "lunar_short.jpg", quality=80)


if __name__ == "__main__":
    main()
