#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/images/rviz.png: the simulated rover driven for a while, seen in RViz on a display without a screen.

usage: make_rviz_picture.py [--seconds 40] [--scenario NAME] [--out FILE]

Needs what scripts/setup.sh ros installs, and python3-pil. Takes about two minutes.
"""

import argparse
import math
import os
import pathlib
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests" / "ros"))

import graph  # noqa: E402
import rospy  # noqa: E402
from geometry_msgs.msg import Twist  # noqa: E402
from PIL import ImageGrab  # noqa: E402
from rosgraph_msgs.msg import Clock  # noqa: E402

DISPLAY = f":{graph.free_port() % 1000 + 100}"


def drive(listener, seconds):
    commands = rospy.Publisher("/cmd_vel", Twist, queue_size=5)
    start = None
    while True:
        clock = listener.take("/clock")
        now = clock[-1] if clock else None
        start = start or now
        if start and now - start > seconds:
            return
        twist = Twist()
        if start and now - start > 3.0:
            twist.linear.x = 0.5
            twist.angular.z = 0.16 * math.sin(2.0 * math.pi * (now - start) / 24.0)
        commands.publish(twist)
        time.sleep(0.05)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=40.0)
    parser.add_argument("--scenario", default="mars_dunes")
    parser.add_argument("--out", default=ROOT / "docs" / "images" / "rviz.png")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, graph.Graph(folder) as nodes:
        rospy.init_node("picture", anonymous=True, disable_signals=True)
        rospy.set_param("/use_sim_time", True)
        rig = pathlib.Path(folder) / "rig.yaml"
        nodes.start("display", "Xvfb", DISPLAY, "-screen", "0", "1280x800x24", "+extension", "GLX")
        rover = nodes.start("rover", graph.PROGRAMS / "regolith_sim_node", "__name:=rover", f"_rig_out:={rig}",
                            f"_scenario:={arguments.scenario}")
        nodes.start_slam(rig, publish_sensor_frames="false")
        nodes.start("publisher", "/usr/lib/robot_state_publisher/robot_state_publisher")
        nodes.wait_for_output(rover, "driving", 120.0)
        os.environ.update(DISPLAY=DISPLAY, LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1", XDG_RUNTIME_DIR=folder)
        nodes.start("rviz", "nice", "-n", "5", "rviz", "-d", ROOT / "ros" / "rviz" / "regolith.rviz")
        listener = graph.Listener()
        listener.listen("/clock", Clock, lambda message: message.clock.to_sec())
        drive(listener, arguments.seconds)
        ImageGrab.grab(xdisplay=DISPLAY).save(arguments.out, optimize=True)
        print(nodes.output("slam"), nodes.output("rover"))
    print(f"{arguments.out} written")


if __name__ == "__main__":
    main()
