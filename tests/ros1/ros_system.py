"""A ROS master, and nodes that talk to it, as the tests start them."""

import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

import rosgraph

ROS = pathlib.Path(os.environ["NBVOPT_ROS"])  # the build's folder of packages
NODE = ROS / "share" / "nbvopt" / "nbvopt_node"
ROBOT = ROS / "share" / "nbvopt" / "nbvopt_simulated_robot"
CONFIG = ROS / "share" / "nbvopt" / "config" / "paper_robot.yaml"


class RosSystem:
    """A master at a port of its own, and what is started later. Its `folder` goes with it."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="nbvopt-ros-"))
        self._processes = []
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1")
        os.environ["ROS_HOME"] = str(self.folder)  # not the user's
        program = "import rosmaster; rosmaster.rosmaster_main()"
        self.start(sys.executable, "-c", program, "--core", "-p", str(port))
        wait_for("the ROS master", rosgraph.is_master_online)

    def start(self, *command) -> subprocess.Popen:
        with (self.folder / "said").open("a") as log:
            process = subprocess.Popen(list(map(str, command)), stdout=log, stderr=log)
        self._processes.append(process)
        return process

    def load(self, node: str, config: pathlib.Path) -> None:
        """Gives a node the parameters of a file."""
        subprocess.run(["rosparam", "load", str(config), node], check=True)

    def log(self) -> str:
        return (self.folder / "said").read_text()

    def stop(self) -> None:
        for process in reversed(self._processes):
            process.terminate()
            process.wait()
        shutil.rmtree(self.folder)


def wait_for(what: str, is_there, seconds: float = 30.0) -> None:
    deadline = time.monotonic() + seconds
    while not is_there():
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {seconds} s for {what}")
        time.sleep(0.05)
