#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Bags played into the SLAM node: as good as offline at their own pace, worse and saying so when too fast."""

import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

import graph

graph.require_ros()
graph.require_long("bags are played at their own pace, which takes minutes")

import rospy  # noqa: E402  after the check that it is there
from diagnostic_msgs.msg import DiagnosticArray  # noqa: E402
from geometry_msgs.msg import PoseWithCovarianceStamped  # noqa: E402
from nav_msgs.msg import Odometry, Path  # noqa: E402
from tf2_msgs.msg import TFMessage  # noqa: E402

RIG = graph.RECORDING / "rig.yaml"
BAG = graph.RECORDING / "recording.bag"
LISTENER = graph.Listener()


def statuses(level=None):
    """Of the diagnostics so far: (name, level, message, values)."""
    return [status for message in LISTENER.take("/diagnostics") for status in message
            if level is None or status[1] >= level]


def keep_statuses(array):
    return [(status.name, status.level if isinstance(status.level, int) else status.level[0], status.message,
             {pair.key: pair.value for pair in status.values}) for status in array.status]


class Replay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="regolith_ros_"))
        cls.graph = graph.Graph(cls.folder)
        rospy.init_node("test", anonymous=True, disable_signals=True)

    @classmethod
    def tearDownClass(cls):
        cls.graph.__exit__()
        shutil.rmtree(cls.folder, ignore_errors=True)

    def setUp(self):
        LISTENER.listen("/regolith/odom", Odometry, lambda message: message.header.stamp.to_sec())
        LISTENER.listen("/regolith/pose", PoseWithCovarianceStamped, lambda message: message.header.stamp.to_sec())
        LISTENER.listen("/regolith/path", Path, lambda message: len(message.poses))
        LISTENER.listen("/diagnostics", DiagnosticArray, keep_statuses)
        LISTENER.listen("/tf", TFMessage, lambda message: [
            (transform.header.frame_id, transform.child_frame_id) for transform in message.transforms])

    def play(self, *options, rig=RIG, bags=(BAG,), parameters=None, settle=3.0):
        slam = self.graph.start_slam(rig, **(parameters or {}))
        play = self.graph.start("play", "rosbag", "play", "--quiet", "--delay=1", *options, *bags)
        play.wait(240.0)
        time.sleep(settle)
        return slam

    def save(self, name):
        path = self.folder / name
        rospy.set_param("/regolith/trajectory_file", str(path))
        answer = graph.call_trigger("/regolith/save_trajectory")
        self.assertTrue(answer.success, answer.message)
        return path

    def last_status(self, name):
        return [status for status in statuses() if status[0] == f"regolith: {name}"][-1]

    def test_at_its_own_pace_it_is_as_good_as_offline(self):
        slam = self.play()
        live = self.save("live.tum")
        rospy.set_param("/regolith/map_file", str(self.folder / "map.ply"))
        self.assertTrue(graph.call_trigger("/regolith/save_map").success)
        self.assertGreater((self.folder / "map.ply").stat().st_size, 100_000)
        self.assertFalse([line for line in self.graph.output("slam").splitlines() if "faster" in line])

        out = self.folder / "offline"
        result = subprocess.run([graph.PROGRAMS / "regolith", "run", graph.RECORDING, "--out", out],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        offline = out / "trajectory.tum"
        coverage = len(graph.read_stamps(live) & graph.read_stamps(offline)) / len(graph.read_stamps(offline))
        difference = graph.evaluate(offline, live)["ape"]["rmse"]
        odometry = graph.rate_of(LISTENER.take("/regolith/odom"))
        print(f"coverage {coverage:.4f}, live against offline {difference:.4f} m, odometry {odometry:.0f} Hz, "
              f"paths {len(LISTENER.take('/regolith/path'))}, poses {len(LISTENER.take('/regolith/pose'))}")
        self.assertGreaterEqual(coverage, 0.99)
        self.assertLessEqual(difference, 0.05)
        self.assertGreater(odometry, 100.0)
        links = {link for message in LISTENER.take("/tf") for link in message}
        self.assertEqual(links, {("map", "odom"), ("odom", "base_link")})
        stamps = LISTENER.take("/regolith/odom")
        self.assertEqual(stamps, sorted(stamps))
        self.assertEqual(self.graph.stop(slam), 0)

    def test_too_fast_it_drops_says_so_and_ends_with_the_bag(self):
        slam = self.play("--rate=20", settle=6.0)
        pipeline = self.last_status("pipeline")
        print(pipeline[2], pipeline[3])
        self.assertGreater(int(pipeline[3]["dropped scans"]) + int(pipeline[3]["dropped images"]), 0)
        self.assertLessEqual(float(pipeline[3]["behind, s"]), 0.1)
        self.assertEqual(pipeline[3]["time jumps"], "0")
        self.assertIn("faster than they can be worked off", self.graph.output("slam"))
        self.assertEqual(self.graph.stop(slam), 0)

    def test_a_bag_in_a_loop_begins_anew(self):
        slam = self.play("--duration=4")
        play = self.graph.start("play", "rosbag", "play", "--quiet", "--duration=4", BAG)
        play.wait(60.0)
        time.sleep(3.0)
        pipeline = self.last_status("pipeline")
        self.assertEqual(pipeline[3]["time jumps"], "1")
        self.assertIn("begins anew: time jumped", self.graph.output("slam"))
        stamps = sorted(float(stamp) for stamp in graph.read_stamps(self.save("loop.tum")))
        self.assertGreater(len(stamps), 35)
        self.assertLess(stamps[-1] - stamps[0], 4.1)
        self.assertTrue(graph.call_trigger("/regolith/reset").success)
        time.sleep(1.0)
        self.assertIn("begins anew: asked for", self.graph.output("slam"))
        self.assertEqual(self.graph.stop(slam), 0)

    def test_real_bags_say_what_is_missing(self):
        bags = sorted((graph.DATA / "bags").glob("*.bag"))
        if not bags:
            self.skipTest("SKIPPED: no real bags in REGOLITH_DATA")
        rig = self.folder / "real.yaml"
        text = RIG.read_text(encoding="utf-8").replace("1.62", "9.81")
        rig.write_text(text, encoding="utf-8")
        for bag in bags:
            with self.subTest(bag=bag.name):
                slam = self.play("--rate=4", rig=rig, bags=(bag,), settle=1.5)
                lidar = self.last_status("lidar")
                print(bag.name, [status[:3] for status in LISTENER.take("/diagnostics")[-1]])
                self.assertEqual(lidar[1], 2)
                self.assertIn("no message on /velodyne_points", lidar[2])
                # While the bag is played: /imu/data_raw in one, a wheels' topic of another name in the other.
                hints = [status[2] for status in statuses(2) if "; of that type there is /" in status[2]]
                self.assertTrue(hints)
                self.assertEqual(self.graph.stop(slam), 0)


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # rospy leaves sockets open
