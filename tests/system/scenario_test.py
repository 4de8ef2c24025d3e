#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""DESIGN §6, line by line: on the scenarios, and on a recording measured against its truth."""

import functools
import math
import re
import unittest

import numpy
from rosbags.rosbag1 import Reader
from ruamel.yaml import YAML
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation

from camera_frames import TYPES, decode
from geotiff import GeoTiff
from program import RECORDING, ROOT, ProgramTest, call, read_tum

CAMERAS = ("mono", "left", "right")
SCENARIOS = {path.stem: path for path in (ROOT / "config" / "scenarios").glob("*.yaml")}
MARS = {"mars", "mars_short", "mars_dunes"}
# What only says where and how long, and the quick ways below, is not compared between scenarios.
DURATIONS = {
    "lunar": 700,
    "mars": 300,
    "lunar_short": 40,
    "mars_short": 40,
    "lunar_pole": 120,
    "lunar_dark": 120,
    "mars_dunes": 120,
    "crater_rim": 120,
    "flat": 120
}
SLOPES = (0.0, 5.0, 10.0, 15.0)  # degrees, of the table of slip
SLIP = (0.025, 0.05, 0.10, 0.35)
CAMERA_DELAY = 4_000_000  # ns


def read_yaml(path):
    return YAML(typ="safe", pure=True).load(path)


class Scenarios(ProgramTest):
    """What `simulate` resolves, without simulating: one rough image pair, and no recording."""

    def resolve(self, name):
        out = self.folder / name
        result = call("simulate", "--scenario", name, "--duration", 4, "--quality", "draft",
                      "--pairs", 1, "--pairs-only", "--set", "mesh.reach=20", "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return read_yaml(out / "scenario.yaml")

    def test_all_lines_of_the_table(self):
        self.assertEqual(set(SCENARIOS), set(DURATIONS))
        for name, path in sorted(SCENARIOS.items()):
            with self.subTest(name):
                scenario = self.resolve(name)
                self.assertEqual(scenario["planet"], "mars" if name in MARS else "moon")
                self.assertEqual(scenario["gravity"], 3.72 if name in MARS else 1.62)
                self.check_drive(name, scenario["drive"], read_yaml(path))
                self.check_ground(name, scenario["terrain"])
                self.check_light(name, scenario["sun"], scenario["lamp"])
                self.check_cameras(scenario["camera"])
                self.check_lidar(scenario["lidar"])
                self.check_imu(scenario["imu"])
                self.check_motion(name, scenario["vibration"], scenario["wheels"])

    def assert_holds(self, values, **expected):
        self.assertEqual({key: values[key] for key in expected}, expected)

    def check_drive(self, name, drive, text):
        self.assertEqual(text["duration"], DURATIONS[name])
        self.assertNotIn("mesh", text, "full quality is the default of all")
        self.assert_holds(drive,
                          speed=0.65 if name in MARS else 0.5,
                          rest=3,
                          turn_rate_deg=20,
                          max_slope_deg=15)
        self.assertGreater(drive["stop"], 0.0)
        self.assertLess(drive["leg_duration"], DURATIONS[name])
        self.assertGreaterEqual(drive["wanted_slope_deg"], 0.0 if name == "flat" else 10.0)
        if name in ("lunar", "mars"):
            self.assertEqual(drive["route"], "loops")
            self.assertGreaterEqual(drive["length"], 300.0 if name == "lunar" else 150.0)

    def check_ground(self, name, terrain):
        relief, craters, rocks = terrain["relief"], terrain["craters"], terrain["rocks"]
        if name in MARS:
            self.assert_holds(relief, slope_deg=5, statistic="rms")
            self.assertGreater(terrain["ripples"]["height"], 0.0)
            if name == "mars_dunes":
                self.assertEqual(rocks["law"], "none")
                self.assertGreater(terrain["ripples"]["dune_height"], 0.5)
            else:
                self.assert_holds(rocks, law="golombek", cover=0.05)
        else:
            self.assertEqual(relief["statistic"], "median")
            self.assert_holds(rocks, law="power", density=0.03)
            if name == "flat":
                self.assertLessEqual(relief["slope_deg"], 1.0)
            elif name == "lunar_pole":
                # Highlands: rougher than the maria (planetary-statistics.md §1).
                self.assertGreaterEqual(relief["hurst"], 0.9)
                self.assertGreaterEqual(relief["slope_deg"], 4.0)
            else:
                self.assert_holds(relief, hurst=0.76, slope_deg=4)
            self.assert_holds(craters, min_diameter=0.2, equilibrium_diameter=20)
            if name != "flat":
                self.assertEqual(craters["density"], 0.079)
            self.assertLess(craters["oldest_depth"], 0.5 * craters["fresh_depth"],
                            "mixed degradation")
        self.assertEqual(terrain["albedo"]["contrast"], 0.12 if name in MARS else 0.06)
        self.assertEqual(bool(craters["extra"]), name == "crater_rim")

    def check_light(self, name, sun, lamp):
        if name in MARS:
            self.assert_holds(sun, elevation_deg=40, tau=0.5)
        else:
            self.assert_holds(sun,
                              elevation_deg={
                                  "lunar_pole": 3,
                                  "lunar_dark": -5
                              }.get(name, 12),
                              tau=0)
        self.assertEqual(lamp["candela"] > 0.0, name == "lunar_dark")

    def check_cameras(self, camera):
        self.assert_holds(camera,
                          width=640,
                          height=480,
                          field_of_view_deg=80,
                          rate=10,
                          mast=1.1,
                          pitch_deg=15,
                          baseline=0.12,
                          min_exposure=0.002,
                          max_exposure=0.02,
                          noise=True,
                          motion_blur=True,
                          time_offset=0.004,
                          time_offset_sigma=0.005)
        self.assertGreater(camera["read_noise"], 0.0)
        self.assertLess(camera["full_well"], 2e4, "electrons: shot noise of a small CMOS pixel")
        self.assertTrue(all(camera["distortion"]), "radial and tangential")

    def check_lidar(self, lidar):
        self.assert_holds(lidar,
                          mast=1.2,
                          rings=16,
                          lowest_deg=-15,
                          highest_deg=15,
                          rate=10,
                          firings=1800,
                          min_range=0.5,
                          max_range=100,
                          range_sigma=0.02,
                          dropout=0.05)

    def check_imu(self, imu):
        self.assert_holds(imu,
                          rate=200,
                          gyro_density=1.7e-4,
                          gyro_walk=2e-5,
                          accelerometer_density=2e-3,
                          accelerometer_walk=3e-3,
                          gyro_bias_sigma=5e-3,
                          accelerometer_bias_sigma=0.05)

    def check_motion(self, name, vibration, wheels):
        self.assert_holds(vibration,
                          acceleration=0.3,
                          angular_rate=0.02,
                          reference_speed=0.5,
                          min_frequency=5,
                          max_frequency=40)
        share = 0.5 if name in MARS else 1.0
        self.assert_holds(wheels,
                          rate=50,
                          slip=[share * slip for slip in SLIP],
                          turn_error=0.1,
                          radius_error=0.01)
        self.assertAlmostEqual(wheels["slip_spread"], 1.0 / 3.0)


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


def vector(message):
    return [message.x, message.y, message.z]


class Recording:
    """The fixture's bag in arrays. Times in s from the first IMU sample; stamps in ns."""

    def __init__(self, folder):
        self.rig = read_yaml(folder / "rig.yaml")
        self.scenario = read_yaml(folder / "scenario.yaml")
        rows = {name: [] for name in ("imu", "odom", "truth")}
        self.stamps = {name: [] for name in (*rows, *CAMERAS, "scans")}
        self.scans = []  # rows of x y z time, and rings, a scan
        self.images = {name: [] for name in CAMERAS}  # every 50th
        readers = {
            "/imu/data": self._imu,
            "/odom": self._odom,
            "/ground_truth/pose": self._pose,
            "/velodyne_points": self._scan
        }
        with Reader(folder / "recording.bag") as reader:
            for connection, _, data in reader.messages():
                message = TYPES.deserialize_ros1(data, connection.msgtype)
                if connection.topic in readers:
                    readers[connection.topic](message, rows)
                elif connection.topic.endswith(("image_raw", "image_raw/compressed")):
                    self._image(connection.topic.split("/")[2], message)
        self.stamps = {name: numpy.array(stamps) for name, stamps in self.stamps.items()}
        self.start = self.stamps["imu"][0]
        self.imu, self.odom, self.truth = (numpy.array(rows[name])
                                           for name in ("imu", "odom", "truth"))

    def times(self, name):
        return (self.stamps[name] - self.start) * 1e-9

    def _imu(self, message, rows):
        self.stamps["imu"].append(nanoseconds(message.header.stamp))
        rows["imu"].append(vector(message.angular_velocity) + vector(message.linear_acceleration))

    def _odom(self, message, rows):
        self.stamps["odom"].append(nanoseconds(message.header.stamp))
        rows["odom"].append([message.twist.twist.linear.x, message.twist.twist.angular.z])

    def _pose(self, message, rows):
        self.stamps["truth"].append(nanoseconds(message.header.stamp))
        pose = message.pose
        rows["truth"].append(
            vector(pose.position) + vector(pose.orientation) + [pose.orientation.w])

    def _scan(self, message, _):
        self.stamps["scans"].append(nanoseconds(message.header.stamp))
        offsets = {field.name: field.offset for field in message.fields}
        bytes_ = message.data.reshape(-1, message.point_step)

        def column(name, layout):
            size = numpy.dtype(layout).itemsize
            return bytes_[:, offsets[name]:offsets[name] + size].copy().view(layout)[:, 0]

        points = numpy.stack([column(name, "<f4") for name in ("x", "y", "z", "time")], axis=1)
        self.scans.append((points, column("ring", "<u2")))

    def _image(self, camera, message):
        if len(self.stamps[camera]) % 50 == 0:
            self.images[camera].append(decode(message))
        self.stamps[camera].append(nanoseconds(message.header.stamp))


@functools.lru_cache(maxsize=1)
def recording():
    return Recording(RECORDING)


def matrix(rows):
    return numpy.array(rows, dtype=float)


class Motion:
    """The base's true motion at 50 Hz, from the truth at 100 Hz: central differences over 0.2 s,
    which shaking of 5 Hz and more (millimetres) hardly touches."""

    HALF = 10  # samples of truth

    def __init__(self, times, poses, T_imu_base):
        rotations = Rotation.from_quat(poses[:, 3:7])
        base = poses[:, :3] + rotations.apply(T_imu_base[:3, 3])
        half, last = self.HALF, len(poses)
        self.truth_times = times
        self.times = times[half:last - half:2]
        middle = slice(half, last - half, 2)
        before, after = slice(0, last - 2 * half, 2), slice(2 * half, last, 2)
        seconds = 0.02 * half
        self.speed = rotations[middle].inv().apply((base[after] - base[before]) / seconds)[:, 0]
        self.yaw_rate = (rotations[before].inv() * rotations[after]).as_rotvec()[:, 2] / seconds
        matrices = rotations.as_matrix()
        self.slope = numpy.degrees(numpy.arcsin(matrices[middle, 2, 0]))
        self.tilt = numpy.degrees(numpy.arccos(matrices[:, 2, 2]))
        self.yaw = numpy.unwrap(numpy.arctan2(matrices[:, 1, 0], matrices[:, 0, 0]))
        self.heading_rate = (self.yaw[after] - self.yaw[before]) / seconds
        self.position = base
        self.length = numpy.linalg.norm(numpy.diff(base[::10], axis=0), axis=1).sum()


@functools.lru_cache(maxsize=1)
def motion():
    record = recording()
    return Motion(record.times("truth"), record.truth, matrix(record.rig["wheels"]["T_imu_base"]))


@functools.lru_cache(maxsize=1)
def odometry():
    """Reported speed and yaw rate at the motion's times."""
    odom = recording().odom[Motion.HALF // 2:, :][:len(motion().times)]
    return odom[:, 0], odom[:, 1]


def check_pace(test, moves, nominal):
    """At rest for 3 s, then 0.2 to 0.8 m/s on the move: a second or more away from any rest."""
    test.assertLess(numpy.abs(moves.speed[moves.times < 2.7]).max(), 1e-4)
    test.assertGreater(numpy.abs(moves.speed).max(), 0.3)
    test.assertLess(moves.speed.max(), 0.8)
    test.assertGreater(moves.speed.min(), -0.02)
    resting = numpy.convolve(moves.speed < 0.02, numpy.ones(101), "same") > 0
    moving = moves.speed[~resting]
    test.assertGreater(len(moving), 0.4 * len(moves.speed))
    test.assertGreater(moving.min(), 0.2)
    test.assertAlmostEqual(moving.mean(), nominal, delta=0.2 * nominal)


def turns(moves):
    return (numpy.abs(moves.speed) < 0.02) & (numpy.abs(moves.yaw_rate) > math.radians(2.0))


def check_turns(test, moves):
    """Of the heading: the body's own rate holds its rocking over uneven ground, too."""
    rate = numpy.degrees(numpy.abs(moves.heading_rate[turns(moves)]))
    test.assertGreater(len(rate), 25, "half a second of turning on the spot")
    test.assertLess(rate.max(), 20.1)
    test.assertGreater(rate.max(), 5.0)


# Little but the motion: rough ground, and the sensors as slow and small as they may be.
ONLY_MOTION = ("mesh.reach=20", "camera.rate=0.1", "camera.width=64", "camera.height=48",
               "lidar.rate=1", "lidar.firings=36", "imu.rate=50", "wheels.rate=1")
LENGTHS = {"lunar": (300, 400), "mars": (150, 220), "lunar_short": (16, 20), "mars_short": (18, 24)}
OTHERS_LENGTH = (45, 100)  # m
PLACES_APART = 0.5  # m, of the places in which revisits are sought
REACH = 2.0  # m to the old track


def revisits(position, yaw):
    """Length (m) and facing (1: the old way, -1: the other way) of stretches within 2 m of a track
    that is 20 m of driving older or more."""
    steps = numpy.linalg.norm(numpy.diff(position, axis=0), axis=1)
    driven = numpy.concatenate([[0.0], numpy.cumsum(steps)])
    chosen = numpy.searchsorted(driven, numpy.arange(0.0, driven[-1], PLACES_APART))
    place, way, yaw = position[chosen], driven[chosen], yaw[chosen]
    distance = numpy.linalg.norm(place[:, None] - place[None], axis=2)
    distance[way[:, None] - way[None] < 20.0] = numpy.inf
    nearest = distance.argmin(axis=1)
    facing = numpy.cos(yaw[nearest] - yaw)
    kind = numpy.where((distance.min(axis=1) < REACH) & (numpy.abs(facing) > 0.5),
                       numpy.sign(facing), 0.0)
    ends = numpy.flatnonzero(numpy.diff(kind, prepend=0.0, append=0.0))
    return [(way[last - 1] - way[first], kind[first]) for first, last in zip(ends, ends[1:])
            if kind[first] != 0.0]


class Drives(ProgramTest):
    """The drives of all scenarios in full, seen by next to no sensors."""

    def drive(self, name):
        out = self.folder / name
        settings = [word for setting in ONLY_MOTION for word in ("--set", setting)]
        result = call("simulate", "--scenario", name, "--quality", "draft", *settings, "--quiet",
                      "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        steepest = float(re.search(r"slopes up to ([0-9.]+) degrees", result.stdout).group(1))
        truth = numpy.array(read_tum(out / "ground_truth.tum"))
        rig = read_yaml(out / "rig.yaml")
        return Motion(truth[:, 0] - truth[0, 0], truth[:, 1:],
                      matrix(rig["wheels"]["T_imu_base"])), steepest

    def test_length_speed_turns_slopes_and_revisits(self):
        for name in sorted(SCENARIOS):
            with self.subTest(name):
                moves, steepest = self.drive(name)
                self.assertAlmostEqual(moves.truth_times[-1], DURATIONS[name], delta=0.02)
                low, high = LENGTHS.get(name, OTHERS_LENGTH)
                self.assertGreaterEqual(moves.length, low)
                self.assertLessEqual(moves.length, high)
                check_pace(self, moves, 0.65 if name in MARS else 0.5)
                check_turns(self, moves)
                self.check_slopes(name, moves, steepest)
                if name in ("lunar", "mars"):
                    found = revisits(moves.position[:, :2], moves.yaw)
                    self.assertEqual([kind for length, kind in found if length >= 10.0], [1, -1])

    def check_slopes(self, name, moves, steepest):
        """`steepest` is the planner's: of the body, and of the ground over 1 m."""
        self.assertLess(steepest, 15.0)
        self.assertLess(moves.tilt.max(), 15.2, "shaking counted in")
        if name != "flat":
            self.assertGreaterEqual(steepest, 10.0)
            self.assertGreater(moves.tilt.max(), 6.0)


class Drive(unittest.TestCase):
    def test_it_rests_for_three_seconds_first(self):
        record = recording()
        resting = record.truth[record.times("truth") < 2.995]
        # Less than a hundredth of a millimetre: the spline's first curve begins a little early.
        numpy.testing.assert_allclose(resting[:, :3], 0.0, atol=1e-5)
        self.assertLess(numpy.abs(resting - resting[0]).max(), 1e-4)
        self.assertLess(abs(Rotation.from_quat(resting[0, 3:]).as_euler("ZYX")[0]), 1e-6)
        self.assertGreater(numpy.abs(motion().speed[motion().times > 3.0]).max(), 0.3)
        moved = numpy.linalg.norm(record.truth[:, 3:] - resting[0, 3:], axis=1) > 1e-4
        self.assertLess(record.times("truth")[moved][0], 4.0)

    def test_it_drives_at_half_a_metre_a_second_between_stops(self):
        check_pace(self, motion(), 0.5)
        self.assertGreater(motion().length, 16.0)
        self.assertLess(motion().length, 20.0)

    def test_slopes_on_the_path(self):
        self.assertLess(motion().tilt.max(), 15.2, "shaking counted in")
        self.assertGreater(motion().tilt.max(), 6.0)

    def test_point_turns_keep_their_rate_and_are_ten_percent_off_in_the_odometry(self):
        moves = motion()
        check_turns(self, moves)
        turning = turns(moves)
        error = odometry()[1][turning].sum() / moves.yaw_rate[turning].sum() - 1.0
        self.assertAlmostEqual(abs(error), 0.10, delta=0.02)

    def test_wheels_slip_by_the_table(self):
        """Uphill and level, where the table holds; the radius is off by one per cent besides."""
        moves = motion()
        driving = (moves.speed > 0.2) & (moves.slope >= 0.0)
        self.assertGreater(driving.sum(), 200)
        expected = numpy.interp(moves.slope[driving], SLOPES, SLIP)
        slip = 1.0 - moves.speed[driving].sum() / odometry()[0][driving].sum()
        mean = numpy.average(expected, weights=moves.speed[driving])
        self.assertGreater(slip, SLIP[0] - 0.012)
        # The slip of each second strays by a third; the drive has some tens of seconds.
        self.assertAlmostEqual(slip, mean, delta=0.011 + 0.25 * mean)

    def test_slip_varies(self):
        moves = motion()
        driving = (moves.speed > 0.3) & (moves.slope >= 0.0)
        expected = numpy.interp(moves.slope[driving], SLOPES, SLIP)
        stray = (1.0 - moves.speed[driving] / odometry()[0][driving] - expected) / expected
        self.assertGreater(stray.std(), 0.15)
        self.assertLess(stray.std(), 0.6)

    def test_shaking_is_part_of_the_motion_and_grows_with_speed(self):
        """RMS from 4.5 to 45 Hz of the IMU, less the noise of the same band at rest."""
        record = recording()
        band = sosfiltfilt(butter(6, (4.5, 45.0), "bandpass", fs=200.0, output="sos"),
                           record.imu,
                           axis=0)
        times = record.times("imu")
        floor = (band[(times > 0.3) & (times < 2.7)]**2).mean(axis=0)
        speed = numpy.interp(times, motion().times, motion().speed)

        def shaking(chosen):
            squares = (band[chosen]**2 - floor).sum(axis=0) / ((speed[chosen] / 0.5)**2).sum()
            return numpy.sqrt(squares.reshape(2, 3).mean(axis=1))

        driving = (speed > 0.1) & (times > 3.0) & (times < 39.5)
        gyro, accelerometer = shaking(driving)
        self.assertAlmostEqual(accelerometer, 0.3, delta=0.15 * 0.3)
        self.assertAlmostEqual(gyro, 0.02, delta=0.15 * 0.02)
        slow, fast = shaking(driving & (speed < 0.4)), shaking(driving & (speed > 0.55))
        numpy.testing.assert_allclose(slow / fast, 1.0, atol=0.25)

    def test_truth_shakes_as_the_imu_does(self):
        """All sensors see it: the truth's positions hold the shaking too."""
        record = recording()
        times = record.times("truth")
        acceleration = numpy.diff(record.truth[:, :3], n=2, axis=0) * 1e4
        band = sosfiltfilt(butter(6, (4.5, 12.0), "bandpass", fs=100.0, output="sos"),
                           acceleration,
                           axis=0)
        imu = sosfiltfilt(butter(6, (4.5, 12.0), "bandpass", fs=200.0, output="sos"),
                          record.imu[:, 3:],
                          axis=0)
        driving = (times[1:-1] > 6.0) & (times[1:-1] < 14.0)
        seen = imu[2:-2:2][driving]
        body = Rotation.from_quat(record.truth[1:-1, 3:]).inv().apply(band)[driving]
        for axis in range(3):
            self.assertGreater(numpy.corrcoef(body[:, axis], seen[:, axis])[0, 1], 0.9)


class Imu(unittest.TestCase):
    def test_noise_and_biases_at_rest(self):
        record = recording()
        resting = record.imu[record.times("imu") < 2.99]
        density = numpy.repeat([1.7e-4, 2e-3], 3)
        # Differences of neighbours are free of the biases' walk.
        noise = numpy.diff(resting, axis=0).std(axis=0) / math.sqrt(2.0)
        numpy.testing.assert_allclose(noise, density * math.sqrt(200.0), rtol=0.12)
        gravity = Rotation.from_quat(record.truth[0, 3:]).inv().apply([0.0, 0.0, 1.62])
        bias = resting.mean(axis=0) - numpy.concatenate([numpy.zeros(3), gravity])
        deviation = bias / numpy.repeat([5e-3, 0.05], 3)
        self.assertLess(numpy.abs(deviation).max(), 3.5)
        self.assertGreater(numpy.sqrt((deviation**2).mean()), 0.3)


class Lidar(unittest.TestCase):
    def test_scans_have_the_points_of_open_ground(self):
        counts = [len(ring) for _, ring in recording().scans]
        self.assertEqual(len(counts), 400)
        self.assertGreater(numpy.mean(counts), 12000)
        self.assertLess(numpy.mean(counts), 14000)

    def test_rings_firings_and_ranges(self):
        points = numpy.concatenate([points for points, _ in recording().scans[::20]])
        rings = numpy.concatenate([ring for _, ring in recording().scans[::20]])
        self.assertEqual(rings.min(), 0)
        self.assertLessEqual(rings.max(), 15)
        self.assertGreater(rings.max(), 7)
        distance = numpy.linalg.norm(points[:, :3], axis=1)
        self.assertGreater(distance.min(), 0.4)
        self.assertLess(distance.max(), 100.1)
        elevation = numpy.degrees(numpy.arcsin(points[:, 2] / distance))
        numpy.testing.assert_allclose(elevation, -15.0 + 2.0 * rings, atol=0.01)
        firing = points[:, 3] * 18000.0
        self.assertGreater(points[:, 3].min(), -1e-6)
        fired = set(numpy.floor(firing + 1e-3).astype(int))
        self.assertLessEqual(fired, set(range(1800)))
        self.assertGreater(len(fired), 1770, "all but those that the rover's antenna hides")

    def at_rest(self):
        """Ranges, scan × firing × ring, NaN where nothing returned: each beam meets one place."""
        ranges = numpy.full((29, 1800, 16), numpy.nan)
        for scan in range(29):
            points, ring = recording().scans[scan]
            firing = numpy.floor(points[:, 3] * 18000.0 + 1e-3).astype(int)
            ranges[scan, firing, ring] = numpy.linalg.norm(points[:, :3], axis=1)
        return ranges

    def test_range_noise_of_two_centimetres(self):
        ranges = self.at_rest()
        often = numpy.isfinite(ranges).sum(axis=0) >= 25
        self.assertGreater(often.sum(), 8000)
        numpy.testing.assert_allclose(numpy.nanstd(ranges[:, often], axis=0, ddof=1).mean(),
                                      0.02,
                                      rtol=0.05)

    def test_five_percent_are_lost_more_from_afar(self):
        ranges = self.at_rest().reshape(29, -1)
        ranges = ranges[:, numpy.isfinite(ranges).any(axis=0)]
        distance = numpy.nanmedian(ranges, axis=0)
        lost = numpy.isnan(ranges).mean(axis=0)
        self.assertAlmostEqual(lost[distance < 30.0].mean(), 0.05, delta=0.015)
        self.assertGreater(lost[(distance > 15.0) & (distance < 30.0)].mean(),
                           1.5 * lost[distance < 7.0].mean())

    def test_points_lie_on_the_terrain_file(self):
        """Frames, height of the lidar, clocks and `terrain.tif` at once."""
        record = recording()
        raster = GeoTiff(RECORDING / "terrain.tif")
        left, top = raster.tie_point[3:5]
        T_imu_lidar = matrix(record.rig["lidar"]["T_imu_lidar"])
        times = record.times("truth")
        for index in (10, 150, 300, 390):
            points, _ = record.scans[index]
            points = points[numpy.linalg.norm(points[:, :3], axis=1) < 8.0].astype(float)
            fired = (record.stamps["scans"][index] - record.start) * 1e-9 + points[:, 3]
            nearest = numpy.clip(numpy.round(fired * 100.0).astype(int), 0, len(times) - 1)
            pose = record.truth[nearest]
            body = points[:, :3] @ T_imu_lidar[:3, :3].T + T_imu_lidar[:3, 3]
            world = pose[:, :3] + Rotation.from_quat(pose[:, 3:]).apply(body)
            column = numpy.round((world[:, 0] - left) / 0.05 - 0.5).astype(int)
            row = numpy.round((top - world[:, 1]) / 0.05 - 0.5).astype(int)
            error = world[:, 2] - raster.values[row, column, 0]
            self.assertLess(abs(numpy.median(error)), 0.01)
            self.assertLess(numpy.median(numpy.abs(error)), 0.02)


class Cameras(unittest.TestCase):
    def test_images(self):
        for camera in CAMERAS:
            self.assertEqual(len(recording().images[camera]), 9)
            for image in recording().images[camera]:
                self.assertEqual((image.shape, image.dtype), ((480, 640), numpy.uint8))
                # Exposed for the ground, neither black nor burnt out.
                ground = image[200:]
                self.assertGreater(ground.mean(), 40.0)
                self.assertLess((ground > 250).mean(), 0.03)
                self.assertGreater(ground.std(), 5.0)

    def test_field_of_view_and_distortion(self):
        for camera in CAMERAS:
            rig = recording().rig["cameras"][camera]
            self.assertEqual((rig["width"], rig["height"]), (640, 480))
            k1, k2 = rig["distortion"][:2]
            self.assertTrue(all(rig["distortion"]))
            focal, centre = rig["intrinsics"][0], rig["intrinsics"][2]
            angle = 0.0
            for border in (-0.5, 639.5):
                distorted = (border - centre) / focal
                straight = distorted
                for _ in range(50):
                    straight = distorted / (1.0 + k1 * straight**2 + k2 * straight**4)
                angle += abs(math.degrees(math.atan(straight)))
            self.assertAlmostEqual(angle, 80.0, delta=0.3)


class Rig(unittest.TestCase):
    @staticmethod
    def in_base(rows):
        rig = recording().rig
        return numpy.linalg.inv(matrix(rig["wheels"]["T_imu_base"])) @ matrix(rows)

    def test_places_of_the_sensors(self):
        rig = recording().rig
        places = {
            camera: self.in_base(rig["cameras"][camera]["T_imu_camera"])
            for camera in CAMERAS
        }
        for place in places.values():
            self.assertAlmostEqual(place[2, 3], 1.1, places=6)
            self.assertAlmostEqual(math.degrees(math.asin(-place[2, 2])), 15.0, places=6)
            self.assertAlmostEqual(place[1, 2], 0.0, places=9)
        T_left_right = numpy.linalg.inv(places["left"]) @ places["right"]
        numpy.testing.assert_allclose(T_left_right[:3, 3], [0.12, 0.0, 0.0], atol=1e-9)
        numpy.testing.assert_allclose(T_left_right[:3, :3], numpy.eye(3), atol=1e-9)
        T_base_lidar = self.in_base(rig["lidar"]["T_imu_lidar"])
        self.assertAlmostEqual(T_base_lidar[2, 3], 1.2, places=6)
        numpy.testing.assert_allclose(T_base_lidar[:3, :3], numpy.eye(3), atol=1e-9)

    def test_it_tells_the_sensors_and_hides_their_errors(self):
        rig = recording().rig
        self.assertEqual(rig["gravity"], 1.62)
        self.assertEqual(rig["lidar"]["rings"], 16)
        self.assertEqual(rig["lidar"]["time_offset"], 0.0)
        for camera in CAMERAS:
            self.assertEqual(rig["cameras"][camera]["time_offset"], 0.0)
            self.assertEqual(rig["cameras"][camera]["time_offset_sigma"], 0.005)
        self.assertEqual(
            rig["imu"], {
                "topic": "/imu/data",
                "rate": 200,
                "gyro_density": 1.7e-4,
                "gyro_walk": 2e-5,
                "accelerometer_density": 2e-3,
                "accelerometer_walk": 3e-3,
                "gyro_bias_sigma": 5e-3,
                "accelerometer_bias_sigma": 0.05
            })
        self.assertEqual(set(rig["wheels"]), {"topic", "T_imu_base"})
        self.assertEqual(set(rig), {"gravity", "imu", "lidar", "cameras", "wheels"})


class Clocks(unittest.TestCase):
    def test_rates_and_the_cameras_late_clock(self):
        record = recording()
        for name, period, count in (("imu", 5_000_000, 8001), ("odom", 20_000_000, 2001),
                                    ("scans", 100_000_000, 400), ("truth", 10_000_000, 4001),
                                    *((name, 100_000_000, 401) for name in CAMERAS)):
            stamps = record.stamps[name]
            self.assertAlmostEqual(len(stamps), count, delta=1, msg=name)
            self.assertEqual(set(numpy.diff(stamps)), {period}, name)
            self.assertEqual((stamps[0] - record.start) % period,
                             CAMERA_DELAY if name in CAMERAS else 0, name)


class Files(unittest.TestCase):
    def test_a_bag_of_twelve_megabytes_a_second_at_most(self):
        size = (RECORDING / "recording.bag").stat().st_size
        self.assertLess(size / 40.0, 12e6)

    def test_full_quality_is_what_it_was_made_with(self):
        text = (RECORDING / "scenario.yaml").read_text()
        self.assertNotIn("raft", text)
        self.assertEqual(recording().scenario["mesh"]["interreflection"], True)
        self.assertLessEqual(recording().scenario["mesh"]["spacing"], 0.01)

    def test_the_truth_is_the_same_in_both_its_files(self):
        written = numpy.array(read_tum(RECORDING / "ground_truth.tum"))
        record = recording()
        self.assertEqual(len(written), len(record.truth))
        numpy.testing.assert_allclose(written[:, 1:4], record.truth[:, :3], atol=1e-6)
        numpy.testing.assert_allclose(written[:, 0], record.stamps["truth"] * 1e-9, atol=1e-6)

    def test_terrain_covers_the_path_and_thirty_metres(self):
        raster = GeoTiff(RECORDING / "terrain.tif")
        numpy.testing.assert_allclose(raster.scale[:2], 0.05)
        self.assertEqual((raster.bits, raster.sample_format), ({32}, {3}))
        rows, columns = raster.values.shape[:2]
        left, top = raster.tie_point[3:5]
        place = motion().position[:, :2]
        low, high = place.min(axis=0), place.max(axis=0)
        numpy.testing.assert_allclose([left, top - 0.05 * rows], low - 30.0, atol=0.3)
        numpy.testing.assert_allclose([left + 0.05 * columns, top], high + 30.0, atol=0.3)
        self.assertTrue(numpy.isfinite(raster.values).all())


if __name__ == "__main__":
    unittest.main()
