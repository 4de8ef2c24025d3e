#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""A ROS 2 recording is refused with the very command that makes it readable, and that command does."""

import re
import shlex
import subprocess
import unittest

from program import RECORDING, ROOT, ProgramTest, call, skip_all

CONVERT = ROOT / ".venv/bin/rosbags-convert"
SECONDS = 5.0

if not CONVERT.exists():
    skip_all("rosbags is not installed in .venv; scripts/setup.sh test installs it")

from rosbags.rosbag1 import Reader, Writer  # noqa: E402  after the check that it is there


def cut(bag, out):
    """The first seconds of a bag, without the stereo pair."""
    with Reader(bag) as reader, Writer(out) as writer:
        connections = [each for each in reader.connections
                       if "/left/" not in each.topic and "/right/" not in each.topic]
        copies = {each.id: writer.add_connection(each.topic, each.msgtype, msgdef=each.msgdef.data, md5sum=each.digest)
                  for each in connections}
        for connection, time, data in reader.messages(connections, stop=reader.start_time + int(SECONDS * 1e9)):
            writer.write(copies[connection.id], time, data)


class Ros2(ProgramTest):
    def convert(self, *arguments):
        result = subprocess.run([CONVERT, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr + result.stdout)

    def command_in(self, recording):
        result = call("run", recording, "--rig", RECORDING / "rig.yaml", "--out", self.folder / "refused")
        self.assert_refused(result, str(recording), "ROS 2", "rosbags-convert", "pip install rosbags")
        words = shlex.split(re.search("`(rosbags-convert [^`]*)`", result.stderr).group(1))
        return words[1:], words[words.index("--dst") + 1]

    def test_the_command_that_is_printed_makes_a_bag_that_runs_as_before(self):
        short = self.folder / "short.bag"
        cut(RECORDING / "recording.bag", short)
        rig = RECORDING / "rig.yaml"
        run = ("run", "--rig", rig, "--pipeline", "lio")
        self.assertEqual(call(*run, short, "--out", self.folder / "before").returncode, 0)
        for storage in ("sqlite3", "mcap"):
            with self.subTest(storage=storage):
                ros2 = self.folder / f"ros2 {storage}"
                self.convert("--src", short, "--dst", ros2, "--dst-storage", storage, "--dst-typestore", "ros2_humble")
                files = [path for path in ros2.iterdir() if path.suffix in (".db3", ".mcap")]
                self.assertEqual(self.command_in(files[0]), self.command_in(ros2))
                words, bag = self.command_in(ros2)
                self.convert(*words)
                out = self.folder / storage
                result = call(*run, bag, "--out", out)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual((out / "trajectory.tum").read_bytes(),
                                 (self.folder / "before" / "trajectory.tum").read_bytes())


if __name__ == "__main__":
    unittest.main()
