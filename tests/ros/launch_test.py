#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""The package and its launch files as roslaunch reads them: they start the programs that were built."""

import os
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

import graph

if not shutil.which("roslaunch"):
    graph.skip_all("roslaunch is not installed; scripts/setup.sh ros installs it")

ENVIRONMENT = {**os.environ, "ROS_PACKAGE_PATH": f"{graph.ROOT}:/usr/share"}


def roslaunch(*arguments):
    result = subprocess.run(["roslaunch", *arguments], capture_output=True, text=True, check=False, env=ENVIRONMENT,
                            timeout=60.0)
    return result.stdout + result.stderr


class Launch(unittest.TestCase):
    def test_nodes_of_each_file(self):
        arguments = ("rig:=/rig.yaml", "bag:=/drive.bag", "rviz:=true")
        slam = {"/regolith", "/rviz"}
        for file, nodes in (("slam", slam), ("replay", slam | {"/play"}),
                            ("sim", slam | {"/rover", "/robot_state_publisher"})):
            with self.subTest(file=file):
                output = roslaunch("--nodes", "regolith", f"{file}.launch", *arguments)
                self.assertEqual(set(output.split()), nodes, output)

    def test_the_package_says_what_it_is(self):
        package = xml.etree.ElementTree.parse(graph.ROOT / "package.xml").getroot()
        self.assertEqual(package.find("name").text, "regolith")
        self.assertEqual(package.find("export/build_type").text, "cmake")

    def test_the_view_is_there(self):
        launch = (graph.ROOT / "ros/launch/slam.launch").read_text(encoding="utf-8")
        self.assertIn("$(find regolith)/ros/rviz/regolith.rviz", launch)
        self.assertTrue((graph.ROOT / "ros/rviz/regolith.rviz").exists())


if __name__ == "__main__":
    unittest.main()
