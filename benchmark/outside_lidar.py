#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs public lidar odometries on a recording of ours: a folder that `simulate` wrote, or a KITTI raw drive.

In an environment of its own:
  python3 -m venv /tmp/outside && /tmp/outside/bin/pip install -r benchmark/requirements_outside_lidar.txt
  /tmp/outside/bin/python benchmark/outside_lidar.py RECORDING --out DIR

Writes DIR/NAME.tum for each odometry: the body's pose (imu; of a KITTI drive lidar) at every scan, for `regolith evaluate`, and
prints the time a scan. They run as their packages ship them; of the places in a sweep that a pose may belong to (its beginning,
middle or end) the one is taken that suits them best, where DIR's recording has a ground truth.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import time

import numpy
import yaml
from scipy.spatial.transform import Rotation

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "release" / "regolith"


def kitti_scans(folder):
    """(stamp s, points n × 3 m, firing times n or None), stamps from the first scan."""
    stamps = []
    for line in (folder / "velodyne_points" / "timestamps.txt").read_text(encoding="utf-8").split("\n"):
        if line:
            hours, minutes, seconds = line.split(" ")[1].split(":")
            stamps.append(3600 * int(hours) + 60 * int(minutes) + float(seconds))
    for stamp, path in zip(stamps, sorted((folder / "velodyne_points" / "data").glob("*.bin"))):
        points = numpy.fromfile(path, numpy.float32).reshape(-1, 4)[:, :3]
        yield stamp - stamps[0], points.astype(numpy.float64), None


def bag_scans(folder, topic):
    from rosbags.highlevel import AnyReader

    with AnyReader([folder / "recording.bag"]) as reader:
        connections = [connection for connection in reader.connections if connection.topic == topic]
        for connection, _, raw in reader.messages(connections):
            message = reader.deserialize(raw, connection.msgtype)
            offsets = {field.name: field.offset for field in message.fields}
            rows = numpy.frombuffer(message.data, numpy.uint8).reshape(-1, message.point_step)

            def column(name):
                return rows[:, offsets[name] : offsets[name] + 4].copy().view(numpy.float32)[:, 0].astype(numpy.float64)

            points = numpy.stack([column("x"), column("y"), column("z")], axis=1)
            stamp = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
            yield stamp, points, column("time")


def kiss_icp():
    from kiss_icp.config import load_config
    from kiss_icp.kiss_icp import KissICP

    def start(deskew):
        config = load_config(None)
        config.data.deskew = deskew
        return KissICP(config)

    return start


def genz_icp():
    from genz_icp.config import load_config
    from genz_icp.genz_icp import GenZICP

    def start(deskew):
        config = load_config(None)
        config.data.deskew = deskew
        return GenZICP(config)

    return start


ODOMETRIES = {"kiss_icp": kiss_icp, "genz_icp": genz_icp}


def run(start, scans):
    """Poses of the lidar (4 × 4) and ms of each scan."""
    odometry, poses, times = None, [], []
    for _, points, firing_times in scans:
        if odometry is None:
            odometry = start(firing_times is not None)
        fractions = numpy.zeros(0)
        if firing_times is not None and len(firing_times):
            span = max(float(numpy.ptp(firing_times)), 1e-9)
            fractions = (firing_times - firing_times.min()) / span
        elif firing_times is None:
            fractions = numpy.zeros(len(points))
        began = time.perf_counter()
        odometry.register_frame(points, fractions)
        times.append(1e3 * (time.perf_counter() - began))
        poses.append(numpy.array(odometry.last_pose))
    return poses, times


def write_tum(path, stamps, poses, T_body_lidar):
    T_lidar_body = numpy.linalg.inv(T_body_lidar)
    with open(path, "w", encoding="utf-8") as file:
        for stamp, pose in zip(stamps, poses):
            T_world_body = T_body_lidar @ pose @ T_lidar_body
            quaternion = Rotation.from_matrix(T_world_body[:3, :3]).as_quat()
            values = [*T_world_body[:3, 3], *quaternion]
            file.write(f"{stamp:.9f} " + " ".join(f"{value:.9f}" for value in values) + "\n")


def rmse(truth, path):
    scores = path.with_suffix(".evaluation")
    subprocess.run([PROGRAM, "evaluate", "--reference", truth, "--estimate", path, "--out", scores, "--overwrite", "--quiet"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
    return json.loads((scores / "metrics.json").read_text(encoding="utf-8"))["ape"]["rmse"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording", type=pathlib.Path)
    parser.add_argument("--only", choices=sorted(ODOMETRIES))
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    folder = arguments.recording
    T_body_lidar, period, truth = numpy.eye(4), 0.0, None
    if (folder / "recording.bag").exists():
        rig = yaml.safe_load((folder / "rig.yaml").read_text(encoding="utf-8"))
        T_body_lidar, period = numpy.array(rig["lidar"]["T_imu_lidar"], float), float(rig["lidar"]["period"])
        scans = list(bag_scans(folder, rig["lidar"]["topic"]))
        truth = folder / "ground_truth.tum"
    elif (folder / "velodyne_points").is_dir():
        scans = list(kitti_scans(folder))
    else:
        print(f"{folder}: neither recording.bag nor velodyne_points/ in it", file=sys.stderr)
        return 2
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, make in ODOMETRIES.items():
        if arguments.only not in (None, name):
            continue
        poses, times = run(make(), scans)
        stamps = numpy.array([scan[0] for scan in scans])
        path = arguments.out / f"{name}.tum"
        shifts = [0.0, 0.5 * period, period] if truth and period > 0.0 else [0.0]
        errors = []
        for shift in shifts:
            write_tum(path, stamps + shift, poses, T_body_lidar)
            errors.append(rmse(truth, path) if truth else 0.0)
        best = shifts[errors.index(min(errors))]
        write_tum(path, stamps + best, poses, T_body_lidar)
        print(f"{name}: {len(poses)} scans, median {statistics.median(times):.1f} ms, p99 {numpy.percentile(times, 99):.1f} ms"
              + (f", APE RMSE {min(errors):.3f} m (pose {best:.2f} s after the stamp)" if truth else ""))  # fmt: skip
    return 0


if __name__ == "__main__":
    sys.exit(main())
