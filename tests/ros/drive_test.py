#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""The simulator live and SLAM on it: driven by /cmd_vel for 30 s; frames, rates, error."""

import math
import pathlib
import shutil
import tempfile
import time
import unittest

import graph

graph.require_ros()
graph.require_long("the rover drives in real time, which takes a minute or two")

import rospy  # noqa: E402  after the check that it is there
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Twist  # noqa: E402
from nav_msgs.msg import Odometry, Path  # noqa: E402
from rosgraph_msgs.msg import Clock  # noqa: E402
from sensor_msgs.msg import Image, JointState, PointCloud2  # noqa: E402
from tf2_msgs.msg import TFMessage  # noqa: E402

DRIVE = 30.0  # s, simulated
REST = 3.0  # s, before


def tum_line(message):
    position, turn = message.pose.position, message.pose.orientation
    return (f"{message.header.stamp.to_nsec() / 1e9:.9f} {position.x} {position.y} {position.z} "
            f"{turn.x} {turn.y} {turn.z} {turn.w}")


def stamp_of(message):
    return message.header.stamp.to_sec()


class Drive(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="regolith_ros_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.graph = graph.Graph(self.folder)
        self.addCleanup(self.graph.__exit__)
        rospy.init_node("test", anonymous=True, disable_signals=True)
        self.listener = graph.Listener()

    def listen(self):
        for topic, kind, keep in (
                ("/clock", Clock, lambda message: message.clock.to_sec()),
                ("/ground_truth/pose", PoseStamped, tum_line),
                ("/joint_states", JointState, lambda message: message.position),
                ("/camera/mono/image_raw", Image, stamp_of),
                ("/velodyne_points", PointCloud2, stamp_of),
                ("/imu/data", rospy.AnyMsg, lambda message: 0),
                ("/regolith/odom", Odometry, stamp_of),
                ("/regolith/pose", PoseWithCovarianceStamped, stamp_of),
                ("/regolith/path", Path, stamp_of),
                ("/regolith/features", Image, stamp_of),
                ("/regolith/map", PointCloud2, lambda message: message.width),
                ("/tf", TFMessage, lambda message: [(each.header.frame_id, each.child_frame_id)
                                                    for each in message.transforms]),
                ("/tf_static", TFMessage, lambda message: [(each.header.frame_id, each.child_frame_id)
                                                           for each in message.transforms])):
            self.listener.listen(topic, kind, keep)

    def now(self):
        clock = self.listener.take("/clock")
        return clock[-1] if clock else 0.0

    def drive(self):
        """Ahead in wide curves, by simulated time; how long that took by the clock."""
        commands = rospy.Publisher("/cmd_vel", Twist, queue_size=5)
        begin = time.monotonic()
        while not self.now():
            self.assertLess(time.monotonic() - begin, 120.0, self.graph.output("rover"))
            time.sleep(0.1)
        begin = time.monotonic()
        start = self.now()
        while self.now() < start + REST + DRIVE:
            self.assertLess(time.monotonic() - begin, 6.0 * DRIVE, self.graph.output("rover"))
            seconds = self.now() - start - REST
            twist = Twist()
            if seconds > 0.0:
                twist.linear.x = 0.45
                twist.angular.z = 0.12 * math.sin(2.0 * math.pi * seconds / 20.0)
            commands.publish(twist)
            time.sleep(0.05)
        return time.monotonic() - begin

    def test_thirty_seconds_by_commands(self):
        rig = self.folder / "rig.yaml"
        rover = self.graph.start("rover", graph.PROGRAMS / "regolith_sim_node", "__name:=rover", f"_rig_out:={rig}",
                                 "_scenario:=mars_dunes")
        self.listen()
        slam = self.graph.start_slam(rig, publish_sensor_frames="false")
        self.graph.wait_for_output(rover, "driving", 120.0)
        before = [self.graph.cpu_seconds(process) for process in (rover, slam)]
        wall = self.drive()
        cpu = [self.graph.cpu_seconds(process) - start for process, start in zip((rover, slam), before, strict=True)]
        time.sleep(1.5)
        trajectory = self.folder / "trajectory.tum"
        rospy.set_param("/regolith/trajectory_file", str(trajectory))
        self.assertTrue(graph.call_trigger("/regolith/save_trajectory").success)
        truth = self.folder / "truth.tum"
        truth.write_text("\n".join(self.listener.take("/ground_truth/pose")) + "\n", encoding="utf-8")
        metrics = graph.evaluate(truth, trajectory)

        take = self.listener.take
        rates = {topic: graph.rate_of(take(topic)) for topic in (
            "/regolith/odom", "/regolith/path", "/regolith/pose", "/camera/mono/image_raw", "/velodyne_points")}
        print(f"{DRIVE + REST:.0f} s simulated in {wall:.1f} s, "
              f"processor {cpu[0]:.1f} s simulator, {cpu[1]:.1f} s SLAM")
        print(f"{metrics['length_m']:.1f} m, APE RMSE {metrics['ape']['rmse']:.3f} m, "
              f"{metrics['percent_of_distance']:.2f} % of the distance; Hz: {rates}")
        print(self.graph.output("slam"))
        print(self.graph.output("rover"))
        self.assertGreater(metrics["length_m"], 9.0)
        self.assertLessEqual(metrics["percent_of_distance"], 2.0)
        self.assertGreaterEqual(rates["/regolith/odom"], 100.0)
        self.assertGreaterEqual(rates["/regolith/path"], 2.0)
        self.assertGreaterEqual(rates["/regolith/pose"], 9.0)
        self.assertGreaterEqual(rates["/camera/mono/image_raw"], 9.0)
        links = {link for message in take("/tf") + take("/tf_static") for link in message}
        for link in (("map", "odom"), ("odom", "base_link"), ("base_link", "base")):
            self.assertIn(link, links)
        self.assertGreater(len(take("/regolith/features")), 10)
        self.assertGreater(take("/regolith/map")[-1], 10_000)
        self.assertGreater(take("/joint_states")[-1][0], 9.0 / 0.15)
        self.assertEqual(self.graph.stop(slam), 0)
        self.assertEqual(self.graph.stop(rover), 0)


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # rospy leaves sockets open
