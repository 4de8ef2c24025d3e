#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Input that is wrong in one way each: a clear line, the right exit code, no crash."""

import pathlib
import shutil
import unittest

import numpy
from rosbags.rosbag1 import Reader, Writer
from rosbags.typesys import Stores, get_typestore

from program import RECORDING, ProgramTest, call, evaluate, read_tum

TYPES = get_typestore(Stores.ROS1_NOETIC)
SECONDS = 8


def rewrite(target, change):
    """Copies the first seconds of the recording's lidar and IMU; change(topic, message, index) gives the messages to
    write, with their stamps."""
    counts = {}
    with Reader(RECORDING / "recording.bag") as reader, Writer(target) as writer:
        connections = {}
        for connection, time, data in reader.messages():
            if connection.topic not in ("/imu/data", "/velodyne_points"):
                continue
            if time > reader.start_time + SECONDS * 10**9:
                break
            if connection.topic not in connections:
                connections[connection.topic] = writer.add_connection(
                    connection.topic, connection.msgtype, typestore=TYPES)
            index = counts[connection.topic] = counts.get(connection.topic, -1) + 1
            message = TYPES.deserialize_ros1(data, connection.msgtype)
            for changed in change(connection.topic, message, index):
                writer.write(connections[connection.topic], time, TYPES.serialize_ros1(changed, connection.msgtype))
    shutil.copyfile(RECORDING / "rig.yaml", target.parent / "rig.yaml")


def without_fields(message, names):
    """The cloud without some of its fields, packed anew."""
    kept = [field for field in message.fields if field.name not in names]
    count = message.width * message.height
    rows = message.data.reshape(count, message.point_step)
    sizes = {2: 1, 4: 2, 6: 4, 7: 4, 8: 8}
    columns, offset = [], 0
    for field in kept:
        size = sizes[field.datatype]
        columns.append(rows[:, field.offset:field.offset + size])
        field.offset = offset
        offset += size
    message.fields = kept
    message.point_step = offset
    message.row_step = offset * message.width
    message.data = numpy.ascontiguousarray(numpy.hstack(columns)).reshape(-1)
    return message


class BadRecordings(ProgramTest):
    def run_on(self, path, *arguments):
        return call("run", path, *arguments, "--out", self.folder / "out")

    def test_no_such_file(self):
        self.assert_refused(self.run_on(self.folder / "none.bag"), "none.bag")

    def test_empty_foreign_and_truncated_files(self):
        rig = ["--rig", RECORDING / "rig.yaml"]
        empty = self.folder / "empty.bag"
        empty.write_bytes(b"")
        self.assert_refused(self.run_on(empty, *rig), "empty.bag")
        foreign = self.folder / "foreign.bag"
        foreign.write_bytes(b"this is no bag\n" * 1000)
        self.assert_refused(self.run_on(foreign, *rig), "foreign.bag")
        whole = (RECORDING / "recording.bag").open("rb").read(3_000_000)
        for size in (10, 5000, 3_000_000):
            truncated = self.folder / "truncated.bag"
            truncated.write_bytes(whole[:size])
            self.assert_refused(self.run_on(truncated, *rig), "truncated.bag")

    def test_a_bag_without_a_rig(self):
        bag = self.folder / "alone.bag"
        bag.symlink_to(RECORDING / "recording.bag")
        self.assert_refused(self.run_on(bag), "--rig")

    def test_topics_that_are_missing_or_of_another_type(self):
        rig = (RECORDING / "rig.yaml").read_text()
        wrong = self.folder / "rig.yaml"
        wrong.write_text(rig.replace("/velodyne_points", "/lidar/points"))
        self.assert_refused(self.run_on(RECORDING, "--rig", wrong), "/lidar/points", "/velodyne_points")
        wrong.write_text(rig.replace("/velodyne_points", "/imu/data"))
        self.assert_refused(self.run_on(RECORDING, "--rig", wrong), "/imu/data", "sensor_msgs/Imu")

    def test_rigs_that_cannot_be(self):
        rig = (RECORDING / "rig.yaml").read_text()
        wrong = self.folder / "rig.yaml"
        reflected = rig.splitlines()
        row = next(i for i, line in enumerate(reflected) if "T_imu_lidar" in line) + 1
        numbers = [float(word) for word in reflected[row].strip(" -[]").split(",")]
        reflected[row] = reflected[row].split("[")[0] + str([-number for number in numbers[:3]] + numbers[3:])
        wrong.write_text("\n".join(reflected))
        self.assert_refused(self.run_on(RECORDING, "--rig", wrong), "rig.yaml", "T_imu_lidar", "reflected")
        wrong.write_text(rig.replace("gravity: 1.62", "gravity: 0.165"))
        self.assert_refused(self.run_on(RECORDING, "--rig", wrong), "gravity", "m/s²")
        wrong.write_text(rig + "\ncolour: red\n")
        self.assert_refused(self.run_on(RECORDING, "--rig", wrong), "rig.yaml:", "colour")
        wrong.write_text(rig.replace("gravity: 1.62", "gravity: 9.81"))
        self.assert_refused(self.run_on(RECORDING, "--rig", wrong), "gravity")

    def test_settings_that_cannot_be(self):
        self.assert_refused(self.run_on(RECORDING, "--set", "lio.voxel=3"), "lio.voxel")
        self.assert_refused(self.run_on(RECORDING, "--set", "lio.map.voxel_size=-1"),
                            "--set lio.map.voxel_size=-1: lio.map: expected voxel_size > 0")
        self.assert_refused(self.run_on(RECORDING, "--pipeline", "nonsense"), "nonsense", "lio")
        self.assert_refused(self.run_on(RECORDING, "--drop", "/imu/data:5"), "--drop")
        self.assert_refused(self.run_on(RECORDING, "--drop", "/nothing:5:6"), "/nothing")
        self.assert_refused(self.run_on(RECORDING, "--frame", "wheel"), "--frame")

    def test_acceleration_in_units_of_g(self):
        def in_g(topic, message, _):
            if topic == "/imu/data":
                for axis in "xyz":
                    setattr(message.linear_acceleration, axis, getattr(message.linear_acceleration, axis) / 9.81)
            return [message]

        rewrite(self.folder / "g.bag", in_g)
        self.assert_refused(self.run_on(self.folder / "g.bag"), "/imu/data", "m/s²")
        info = call("info", self.folder / "g.bag")
        self.assertEqual(info.returncode, 2, info.stdout)

    def assert_runs(self, bag, notice, least_poses=70, most_error=0.10):
        result = self.run_on(bag)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(notice, result.stderr)
        trajectory = self.folder / "out" / "trajectory.tum"
        self.assertGreaterEqual(len(read_tum(trajectory)), least_poses)
        self.assertLess(evaluate(RECORDING / "ground_truth.tum", trajectory)["ape"]["rmse"], most_error)

    def test_clouds_without_ring_and_time_are_derived_and_said(self):
        def bare(topic, message, _):
            return [without_fields(message, ("ring", "time")) if topic == "/velodyne_points" else message]

        rewrite(self.folder / "bare.bag", bare)
        self.assert_runs(self.folder / "bare.bag", "time")

    def test_nan_is_dropped_and_said(self):
        def with_nan(topic, message, index):
            if topic == "/imu/data" and index % 50 == 7:
                message.angular_velocity.y = float("nan")
            if topic == "/velodyne_points":
                rows = message.data.copy().reshape(-1, message.point_step)
                rows[::10, 0:4] = numpy.frombuffer(numpy.float32("nan").tobytes(), numpy.uint8)
                message.data = rows.reshape(-1)
            return [message]

        rewrite(self.folder / "nan.bag", with_nan)
        self.assert_runs(self.folder / "nan.bag", "finite")

    def test_stamps_that_repeat_or_run_backwards_are_dropped_and_said(self):
        def twice(topic, message, index):
            if topic == "/imu/data" and index % 100 == 50:
                earlier = TYPES.deserialize_ros1(TYPES.serialize_ros1(message, "sensor_msgs/msg/Imu"),
                                                 "sensor_msgs/msg/Imu")
                earlier.header.stamp.sec -= 1
                return [message, earlier]
            return [message, message] if topic == "/velodyne_points" and index % 20 == 5 else [message]

        rewrite(self.folder / "twice.bag", twice)
        self.assert_runs(self.folder / "twice.bag", "stamp")


class BadElevationModels(ProgramTest):
    def simulate(self, *arguments):
        return call("simulate", "--scenario", "lunar_short", *arguments, "--out", self.folder / "out")

    def grid(self, value, nodata):
        rows = "\n".join(" ".join([str(value)] * 60) for _ in range(60))
        path = self.folder / "dem.asc"
        path.write_text(f"ncols 60\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value {nodata}\n{rows}\n")
        return path

    def test_nothing_but_no_data(self):
        self.assert_refused(self.simulate("--dem", self.grid(-9999, -9999)), "dem.asc", "data")

    def test_no_raster_and_no_file(self):
        path = self.folder / "dem.tif"
        self.assert_refused(self.simulate("--dem", path), "dem.tif")
        path.write_text("not a raster")
        self.assert_refused(self.simulate("--dem", path), "dem.tif")

    def test_scenarios_that_cannot_be(self):
        self.assert_refused(call("simulate", "--scenario", "venus", "--out", self.folder / "out"), "venus", "lunar_short")
        self.assert_refused(self.simulate("--duration", "-3"), "duration")
        self.assert_refused(self.simulate("--set", "nonsense.key=3"), "nonsense")


class BadTrajectories(ProgramTest):
    def test_wrong_files_are_named(self):
        truth = RECORDING / "ground_truth.tum"
        wrong = self.folder / "wrong.tum"
        for text in ("", "1 2 3\n", "a b c d e f g h\n", "1 nan 0 0 0 0 0 1\n", "5 0 0 0 0 0 0 1\n"):
            wrong.write_text(text)
            self.assert_refused(
                call("evaluate", "--reference", truth, "--estimate", wrong, "--out", self.folder / "out"), "wrong.tum")


class Arguments(unittest.TestCase):
    def test_wrong_arguments_end_with_two(self):
        for arguments in ([], ["fly"], ["run"], ["run", "x", "--speed", "3"], ["simulate", "--out", "x"]):
            self.assertEqual(call(*arguments).returncode, 2, arguments)

    def test_help_shows_an_example(self):
        for command in ("simulate", "run", "evaluate", "info"):
            result = call(command, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertIn("Example", result.stdout)

    def test_it_works_from_any_folder(self):
        self.assertEqual(call("info", RECORDING, cwd=pathlib.Path("/")).returncode, 0)


if __name__ == "__main__":
    unittest.main()
