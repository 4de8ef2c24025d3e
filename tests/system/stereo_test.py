#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Stereo SLAM (pipeline orb_slam2): the short lunar traverse, and a pair that is wrong in one way each."""

import csv
import io
import json
import pathlib
import shutil
import unittest

import numpy
from PIL import Image
from rosbags.rosbag1 import Reader, Writer
from rosbags.typesys import Stores, get_typestore
from ruamel.yaml import YAML

from camera_frames import decode
from program import RECORDING, ProgramTest, call, evaluate, read_tum

TYPES = get_typestore(Stores.ROS1_NOETIC)
START, SECONDS = 8.0, 6.0  # of the traverse: it moves


def eye_of(topic):
    """left or right, None for what is no stereo image."""
    if "image_raw" not in topic:
        return None
    return next((eye for eye in ("left", "right") if f"/{eye}/" in topic), None)


def write_pair(folder, change):
    """A recording of some seconds of both eyes alone; change(eye, message) may change a message or give another eye."""
    with Reader(RECORDING / "recording.bag") as reader, Writer(folder / "recording.bag") as writer:
        sources = {eye_of(one.topic): one for one in reader.connections if eye_of(one.topic)}
        targets = {eye: writer.add_connection(one.topic, one.msgtype, typestore=TYPES) for eye, one in sources.items()}
        for connection, time, data in reader.messages(connections=list(sources.values())):
            seconds = (time - reader.start_time) * 1e-9
            if not START <= seconds < START + SECONDS:
                continue
            message = TYPES.deserialize_ros1(data, connection.msgtype)
            eye = change(eye_of(connection.topic), message)
            writer.write(targets[eye], time, TYPES.serialize_ros1(message, connection.msgtype))
    rig = YAML(typ="safe", pure=True).load(RECORDING / "rig.yaml")
    rig = {"gravity": rig["gravity"], "cameras": {eye: rig["cameras"][eye] for eye in ("left", "right")}}
    write_rig(folder, rig)
    return rig


def write_rig(folder, rig):
    with (folder / "rig.yaml").open("w", encoding="utf-8") as file:
        YAML(typ="safe", pure=True).dump(rig, file)


def blacken(message):
    """The same image with nothing in it."""
    buffer = io.BytesIO()
    Image.fromarray(numpy.zeros_like(decode(message))).save(buffer, format="PNG")
    message.data = numpy.frombuffer(buffer.getvalue(), dtype=numpy.uint8)


class Stereo(ProgramTest):
    def run_stereo(self, recording, *arguments):
        out = self.folder / "run"
        result = call("run", recording, "--pipeline", "orb_slam2", "--out", out, "--overwrite", *arguments)
        if result.returncode != 0:
            return result, None, None
        with (out / "status.csv").open() as table:
            health = [row["health"] for row in csv.DictReader(table)]
        return result, json.loads((out / "summary.json").read_text()), health

    def pair(self, change=lambda eye, message: eye):
        folder = pathlib.Path(self.folder, "pair")
        folder.mkdir()
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        return folder, write_pair(folder, change)

    def test_two_eyes_follow_the_lunar_traverse(self):
        for features in ("orb", "ghost"):
            _, summary, health = self.run_stereo(RECORDING, "--features", features)
            metrics = evaluate(RECORDING / "ground_truth.tum", self.folder / "run/trajectory.tum")
            # 0.06 and 0.28 with ghost, before its keypoints were aligned.
            self.assertLess(metrics["percent_of_distance"], 0.04, features)
            self.assertLess(metrics["drift_percent"], 0.2, features)
            self.assertGreaterEqual(summary["coverage"], 0.99, features)
            self.assertEqual(set(health), {"good"})
            first = read_tum(self.folder / "run/trajectory.tum")[0]
            for value, expected in zip(first[1:], (0, 0, 0, 0, 0, 0, 1)):
                self.assertAlmostEqual(value, expected, delta=0.01)

    def test_runs_agree_for_any_number_of_threads(self):
        folder, _ = self.pair()
        results = []
        for threads in (1, 2):
            self.run_stereo(folder, "--threads", threads)
            results.append([(self.folder / "run" / name).read_bytes() for name in ("trajectory.tum", "odometry.tum",
                                                                                   "map.ply")])
        self.assertGreater(len(results[0][0]), 1000)
        self.assertEqual(results[0], results[1])

    def test_a_time_without_images_is_a_gap_and_not_invented(self):
        _, summary, _ = self.run_stereo(RECORDING, "--drop", "left:12:17")
        self.assertLess(summary["coverage"], 0.9)
        start = read_tum(RECORDING / "ground_truth.tum")[0][0]
        inside = [pose for pose in read_tum(self.folder / "run/trajectory.tum") if start + 12.2 < pose[0] < start + 16.8]
        self.assertEqual(inside, [])

    def test_an_eye_that_is_black_is_said_to_see_nothing(self):
        folder, _ = self.pair(lambda eye, message: (blacken(message) if eye == "right" else None, eye)[1])
        result, summary, health = self.run_stereo(folder)
        self.assertEqual(summary["coverage"], 0.0)
        self.assertEqual(set(health), {"not started"})
        self.assertIn("both eyes", result.stderr)

    def test_swapped_eyes_are_an_error(self):
        folder, rig = self.pair(lambda eye, message: "left" if eye == "right" else "right")
        self.assert_refused(self.run_stereo(folder)[0], "swapped")
        cameras = rig["cameras"]
        cameras["left"]["topic"], cameras["right"]["topic"] = cameras["right"]["topic"], cameras["left"]["topic"]
        write_rig(folder, rig)
        self.assertGreater(self.run_stereo(folder)[1]["coverage"], 0.9)

    def test_eyes_swapped_in_the_rig_are_an_error(self):
        folder, rig = self.pair()
        cameras = rig["cameras"]
        cameras["left"]["T_imu_camera"], cameras["right"]["T_imu_camera"] = (cameras["right"]["T_imu_camera"],
                                                                            cameras["left"]["T_imu_camera"])
        write_rig(folder, rig)
        self.assert_refused(self.run_stereo(folder)[0], "swapped", "T_imu_camera")

    def test_a_pair_out_of_step_has_no_poses_and_says_why(self):
        def late(eye, message):
            if eye == "right":
                total = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec + 50 * 10**6
                message.header.stamp.sec, message.header.stamp.nanosec = divmod(total, 10**9)
            return eye
        folder, _ = self.pair(late)
        result, summary, health = self.run_stereo(folder)
        self.assertEqual(summary["coverage"], 0.0)
        self.assertEqual(set(health), {"no right image"})
        self.assertIn("stamps", result.stderr)

    def test_a_rig_without_a_baseline_or_a_second_eye_is_refused(self):
        folder, rig = self.pair()
        right = dict(rig["cameras"]["right"])
        rig["cameras"]["right"] = {**right, "T_imu_camera": rig["cameras"]["left"]["T_imu_camera"]}
        write_rig(folder, rig)
        self.assert_refused(self.run_stereo(folder)[0], "orb_slam2", "0 m apart", "T_imu_camera")
        del rig["cameras"]["right"]
        write_rig(folder, rig)
        self.assert_refused(self.run_stereo(folder)[0], "orb_slam2", "right")

    def test_features_without_descriptors_are_refused(self):
        self.assert_refused(self.run_stereo(RECORDING, "--features", "st_lk")[0], "st_lk", "descriptors")


if __name__ == "__main__":
    unittest.main()
