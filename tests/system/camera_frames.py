# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frames of a recording's camera, each with how high above the horizon its pixels look."""

import io

import numpy
from PIL import Image
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_typestore
from ruamel.yaml import YAML
from scipy.spatial.transform import Rotation

from program import read_tum

TYPES = get_typestore(Stores.ROS1_NOETIC)
CAMERA_DELAY = 0.004  # s, of the camera's clock: DESIGN §6


def bearings(camera):
    """Directions of all pixels in the camera's frame, rows × columns × 3; undoes the distortion."""
    fx, fy, cx, cy = camera["intrinsics"]
    k1, k2, p1, p2 = camera["distortion"]
    u, v = numpy.meshgrid(numpy.arange(camera["width"]), numpy.arange(camera["height"]))
    x_seen, y_seen = (u - cx) / fx, (v - cy) / fy
    x, y = x_seen, y_seen
    for _ in range(40):
        square = x * x + y * y
        radial = 1.0 + k1 * square + k2 * square * square
        x, y = ((x_seen - 2.0 * p1 * x * y - p2 * (square + 2.0 * x * x)) / radial,
                (y_seen - p1 * (square + 2.0 * y * y) - 2.0 * p2 * x * y) / radial)
    directions = numpy.stack([x, y, numpy.ones_like(x)], axis=-1)
    return directions / numpy.linalg.norm(directions, axis=-1, keepdims=True)


def decode(message):
    return numpy.array(Image.open(io.BytesIO(message.data.tobytes())))


def stamped_images(folder, camera="mono"):
    """Stamps (s, of the camera's clock) and image messages of a recording's camera."""
    rig = YAML(typ="safe", pure=True).load(folder / "rig.yaml")["cameras"][camera]
    with Reader(folder / "recording.bag") as reader:
        topics = [
            connection for connection in reader.connections
            if connection.topic in (rig["topic"], rig["topic"] + "/compressed")
        ]
        for connection, _, data in reader.messages(connections=topics):
            message = TYPES.deserialize_ros1(data, connection.msgtype)
            yield message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec, message


def read_frames(folder, every=1, camera="mono"):
    """Pairs of an image and its pixels' elevations above the horizontal in degrees."""
    rig = YAML(typ="safe", pure=True).load(folder / "rig.yaml")["cameras"][camera]
    directions = bearings(rig)
    R_imu_camera = numpy.array(rig["T_imu_camera"], dtype=float)[:3, :3]
    truth = numpy.array(read_tum(folder / "ground_truth.tum"))
    frames = []
    for index, (stamp, message) in enumerate(stamped_images(folder, camera)):
        if index % every != 0:
            continue
        pose = truth[numpy.argmin(numpy.abs(truth[:, 0] - (stamp - CAMERA_DELAY)))]
        up_camera = (Rotation.from_quat(pose[4:8]).as_matrix() @ R_imu_camera)[2]
        elevation = numpy.degrees(numpy.arcsin(directions @ up_camera))
        frames.append((decode(message), elevation))
    return frames
