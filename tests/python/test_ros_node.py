"""Runs the ROS 1 node between a simulated robot and a real server, with a ROS master of its own.

    NBVOPT_CLI=PATH/TO/nbvopt PYTHONPATH=BUILD/python python3 test_ros_node.py

The robot publishes depth images, joint states and tf, and moves its joints as it is told to.
Skipped where rospy is not there. On Debian 12: apt-get install --no-install-recommends
python3-rospy python3-sensor-msgs python3-tf2-ros python3-trajectory-msgs python3-rosmaster
"""

import math
import os
import socket
import subprocess
import sys
import time
import unittest

import numpy as np

from nbvopt_client import PlannerClient, pb
from simulated_robot import HEIGHT_PX, WIDTH_PX, SimulatedRobot
from served import Server
from test_nbvopt_client import PROGRAMS

MISSING = ""
try:
    import rosgraph
    import rosmaster  # noqa: F401, run as a program
    import rospy
    import tf2_ros
    from geometry_msgs.msg import TransformStamped
    from sensor_msgs.msg import CameraInfo, Image, JointState
    from trajectory_msgs.msg import JointTrajectory

    import ros_node
except ImportError as error:
    MISSING = str(error)

JOINTS = ["pan", "tilt", "height"]


def quaternion(R: np.ndarray) -> np.ndarray:
    """(x, y, z, w) of a rotation matrix: the eigenvector of Bar-Itzhack's K to its eigenvalue 1."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = R
    K = np.array(
        (
            (xx - yy - zz, yx + xy, zx + xz, zy - yz),
            (yx + xy, yy - xx - zz, zy + yz, xz - zx),
            (zx + xz, zy + yz, zz - xx - yy, yx - xy),
            (zy - yz, xz - zx, yx - xy, xx + yy + zz),
        )
    )
    return np.linalg.eigh(K / 3.0)[1][:, -1]


class RobotOnRos:
    """A simulated robot behind the topics that a real one has."""

    def __init__(self):
        self.robot = SimulatedRobot()
        self.commands = []
        self._image = rospy.Publisher("depth/image", Image, queue_size=1)
        self._info = rospy.Publisher("depth/camera_info", CameraInfo, queue_size=1)
        self._joints = rospy.Publisher("joint_states", JointState, queue_size=1)
        self._tf = tf2_ros.TransformBroadcaster()
        rospy.Subscriber("joint_command", JointTrajectory, self.commands.append)

    def publish(self) -> None:
        now, robot = rospy.Time.now(), self.robot
        x_m, y_m, yaw_rad = robot.base
        upright = (0.0, 0.0, math.sin(yaw_rad / 2), math.cos(yaw_rad / 2))
        T = robot.T_map_sensor
        self._tf.sendTransform(
            [
                self._transform(now, "base_link", (x_m, y_m, 0.0), upright),
                self._transform(now, "camera_optical", T[:3, 3], quaternion(T[:3, :3])),
            ]
        )
        self._joints.publish(self._stamped(JointState(name=JOINTS, position=robot.joints), now))
        fx, fy, cx, cy = robot.intrinsics
        info = CameraInfo(P=[fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0])
        self._info.publish(self._stamped(info, now))
        image = Image(height=HEIGHT_PX, width=WIDTH_PX, encoding="16UC1", step=2 * WIDTH_PX)
        image.data = robot.look().astype("<u2").tobytes()
        self._image.publish(self._stamped(image, now))

    def follow(self, command: "JointTrajectory") -> None:
        (point,) = command.points
        pan_rad, tilt_rad, height_m = point.positions
        joints = pb.JointPosition(pan_rad=pan_rad, tilt_rad=tilt_rad, height_m=height_m)
        self.robot.move(joints, point.time_from_start.to_sec() + 1e-6)

    @staticmethod
    def _stamped(message, now: "rospy.Time"):
        message.header.stamp = now
        message.header.frame_id = "camera_optical"
        return message

    @staticmethod
    def _transform(now: "rospy.Time", frame: str, position, orientation) -> "TransformStamped":
        message = TransformStamped()
        message.header.stamp = now
        message.header.frame_id = "map"
        message.child_frame_id = frame
        p, q = message.transform.translation, message.transform.rotation
        p.x, p.y, p.z = position
        q.x, q.y, q.z, q.w = orientation
        return message


@unittest.skipIf(MISSING, f"ROS 1 is not there: {MISSING}")
class DepthImageTest(unittest.TestCase):
    def test_byte_order_and_padded_rows(self):
        little = Image(height=2, width=2, encoding="16UC1", step=6, is_bigendian=0)
        little.data = bytes((1, 0, 2, 0, 9, 9, 3, 0, 0, 1, 9, 9))
        self.assertEqual(ros_node.depth_of(little).tolist(), [[1, 2], [3, 256]])
        big = Image(height=1, width=2, encoding="16UC1", step=4, is_bigendian=1)
        big.data = bytes((0, 1, 1, 0))
        self.assertEqual(ros_node.depth_of(big).tolist(), [[1, 256]])

    def test_other_encodings_are_refused(self):
        with self.assertRaisesRegex(ValueError, "32FC1, it must be 16UC1"):
            ros_node.depth_of(Image(height=1, width=1, encoding="32FC1", step=4, data=bytes(4)))


@unittest.skipIf(MISSING, f"ROS 1 is not there: {MISSING}")
class RosNodeTest(unittest.TestCase):
    def start(self, *command: str) -> None:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)

    def start_ros(self, logs: str) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1")
        os.environ["ROS_HOME"] = logs  # not the user's
        program = "import rosmaster; rosmaster.rosmaster_main()"
        self.start(sys.executable, "-c", program, "--core", "-p", str(port))
        self.wait_for("the ROS master", rosgraph.is_master_online)

    def wait_for(self, what: str, is_there) -> None:
        for _ in range(200):
            if is_there():
                return
            time.sleep(0.1)
        self.fail(f"waited 20 s for {what}")

    def test_robot_follows_the_plans_and_learns(self):
        server = Server()
        self.addCleanup(server.stop)
        self.start_ros(str(server.folder / "ros"))
        arguments = [f"_server:={server.address}", "_motion_time:=0.5"]
        self.start(sys.executable, str(PROGRAMS / "ros_node.py"), *arguments)
        rospy.init_node("robot", disable_signals=True)
        self.addCleanup(rospy.signal_shutdown, "the test is over")
        robot = RobotOnRos()
        with PlannerClient(server.address) as planner:
            first = self.publish_until_told(robot)
            seen_from_the_start = self.information(planner)
            self.assertGreater(seen_from_the_start, 1000.0)
            self.assertEqual(first.joint_names, JOINTS)
            self.assertLessEqual(first.points[0].time_from_start.to_sec(), 0.5 + 1e-6)
            robot.follow(first)
            np.testing.assert_allclose(robot.robot.joints, first.points[0].positions)
            for _ in range(4):
                robot.follow(self.publish_until_told(robot))
            self.assertGreater(self.information(planner), 2.0 * seen_from_the_start)

    def publish_until_told(self, robot: RobotOnRos) -> "JointTrajectory":
        robot.commands.clear()

        def is_told() -> bool:
            robot.publish()
            return bool(robot.commands)

        self.wait_for("a command", is_told)
        return robot.commands[0]

    @staticmethod
    def information(planner: PlannerClient) -> float:
        return planner.status(with_counts=True).counts.information


if __name__ == "__main__":
    if "NBVOPT_CLI" not in os.environ:
        sys.exit("set NBVOPT_CLI to the nbvopt that serves")
    unittest.main()
