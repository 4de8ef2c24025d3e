# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""A ROS graph of a test's own: a master on a free port, nodes, and what they publish."""

import contextlib
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).parents[2]
PROGRAMS = pathlib.Path(os.environ.get("REGOLITH_PROGRAM", ROOT / "build/release/regolith")).parent
RECORDING = pathlib.Path(os.environ.get("REGOLITH_TEST_RECORDING", ROOT / "build/release/test_data/lunar_short"))
DATA = pathlib.Path(os.environ.get("REGOLITH_DATA", ROOT / "../shared/data"))
SKIPPED = 77


def skip_all(reason):
    """Ends the test program so that ctest lists it as skipped."""
    print(f"SKIPPED: {reason}", file=sys.stderr)
    sys.exit(SKIPPED)


def require_ros():
    for program in ("roscore", "rosbag"):
        if not shutil.which(program):
            skip_all(f"{program} is not installed; scripts/setup.sh ros installs it")
    if not (PROGRAMS / "regolith_node").exists():
        skip_all("regolith_node is not built: ROS was not found")


def require_long(what):
    if not os.environ.get("REGOLITH_LONG_TESTS"):
        skip_all(f"{what}; scripts/test.sh --long runs it")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def evaluate(reference, estimate):
    with tempfile.TemporaryDirectory() as out:
        result = subprocess.run(
            [PROGRAMS / "regolith", "evaluate", "--reference", reference, "--estimate", estimate, "--out", out],
            capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        return json.loads(pathlib.Path(out, "metrics.json").read_text(encoding="utf-8"))


def read_stamps(path):
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    return {line.split()[0] for line in lines if not line.startswith("#")}


class Graph(contextlib.AbstractContextManager):
    """Starts a master; ends it and all nodes at the end."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.processes = []
        port = free_port()
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_HOSTNAME="127.0.0.1",
                          ROS_LOG_DIR=str(self.folder / "log"), ROS_PACKAGE_PATH=f"{ROOT}:/usr/share")
        self.start("roscore", "roscore", "-p", port)
        deadline = time.monotonic() + 30.0
        import rosgraph  # of Debian's ROS, which a test that is skipped need not have
        while not rosgraph.is_master_online():
            if time.monotonic() > deadline:
                raise AssertionError("no ROS master: " + self.output("roscore"))
            time.sleep(0.1)

    def start(self, name, *command):
        """Starts a program; its output goes to NAME.log."""
        with (self.folder / f"{name}.log").open("w") as log:
            process = subprocess.Popen([str(word) for word in command], stdout=log, stderr=subprocess.STDOUT,
                                       cwd=self.folder)
        process.name = name
        self.processes.append(process)
        return process

    def start_slam(self, rig, **parameters):
        parameters = {"rig": rig, **parameters}
        process = self.start("slam", PROGRAMS / "regolith_node", "__name:=regolith",
                             *(f"_{key}:={value}" for key, value in parameters.items()))
        self.wait_for_output(process, "listening")
        return process

    def output(self, name):
        return (self.folder / f"{name}.log").read_text(encoding="utf-8")

    def wait_for_output(self, process, word, seconds=90.0):
        deadline = time.monotonic() + seconds
        while word not in self.output(process.name):
            if process.poll() is not None or time.monotonic() > deadline:
                raise AssertionError(f"{process.name} did not say `{word}`: {self.output(process.name)}")
            time.sleep(0.1)

    @staticmethod
    def cpu_seconds(process):
        """Of a program that still runs."""
        fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def stop(self, process):
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(20.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.processes.remove(process)
        return process.returncode

    def __exit__(self, *_):
        for process in reversed(list(self.processes)):
            self.stop(process)


class Listener:
    """Counts the messages of topics and keeps what a function makes of each."""

    def __init__(self):
        self.kept = {}
        self.subscribers = {}
        self.lock = threading.Lock()

    def listen(self, topic, kind, keep):
        """From now on; who listened to the topic before does so no more."""
        import rospy
        if topic in self.subscribers:
            self.subscribers.pop(topic).unregister()
        self.kept[topic] = []

        def receive(message):
            value = keep(message)
            with self.lock:
                self.kept[topic].append(value)

        self.subscribers[topic] = rospy.Subscriber(topic, kind, receive, queue_size=1000)

    def take(self, topic):
        with self.lock:
            return list(self.kept[topic])


def rate_of(stamps):
    """Hz, of stamps in seconds."""
    return (len(stamps) - 1) / (stamps[-1] - stamps[0]) if len(stamps) > 1 else 0.0


def call_trigger(name):
    """Calls a std_srvs/Trigger; its answer."""
    import rospy
    import std_srvs.srv
    rospy.wait_for_service(name, timeout=20.0)
    return rospy.ServiceProxy(name, std_srvs.srv.Trigger)()
