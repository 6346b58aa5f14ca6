"""A ROS 1 node between a robot and a planning server.

    nbvopt serve --create 0.05 &
    python3 ros_node.py _server:=127.0.0.1:50051

Inserts each depth image and publishes where the joints should move next.

Subscribes
    depth/image (sensor_msgs/Image, 16UC1)   millimetres; 0 is not known, 65535 nothing in range
    depth/camera_info (sensor_msgs/CameraInfo)   of that image, which is rectified
    joint_states (sensor_msgs/JointState)   with the joints `~joints`
    tf   from the image's frame and from `~base_frame` to `~map_frame`
Publishes
    joint_command (trajectory_msgs/JointTrajectory)   one point, in reach within `~motion_time`
Parameters
    ~server (127.0.0.1:50051), ~map_frame (map), ~base_frame (base_link), ~joints ([pan, tilt,
    height]), ~motion_time (1.0 s, also the time between two plans)
"""

import threading

import numpy as np
import rospy
import tf2_ros
from sensor_msgs.msg import CameraInfo, Image, JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from nbvopt_client import Intrinsics, PlannerClient, PlannerError, pb


class PlanningNode:
    def __init__(self, planner: PlannerClient):
        self._planner = planner
        self._map_frame = rospy.get_param("~map_frame", "map")
        self._base_frame = rospy.get_param("~base_frame", "base_link")
        self._joint_names = rospy.get_param("~joints", ["pan", "tilt", "height"])
        self._motion_time_s = rospy.get_param("~motion_time", 1.0)
        self._camera = None
        self._joints = {}
        self._has_new_map = threading.Event()
        self._tf = tf2_ros.Buffer()
        tf2_ros.TransformListener(self._tf)
        self._command = rospy.Publisher("joint_command", JointTrajectory, queue_size=1)
        rospy.Subscriber("depth/camera_info", CameraInfo, self._on_camera_info)
        rospy.Subscriber("joint_states", JointState, self._on_joint_state)
        # An image that waits is replaced by a newer one. Images are larger than rospy's buffer,
        # and what is left in it would be read late.
        rospy.Subscriber("depth/image", Image, self._on_image, queue_size=1, buff_size=2**24)
        rospy.Timer(rospy.Duration(max(self._motion_time_s, 0.1)), self._plan)

    def _on_camera_info(self, info: CameraInfo) -> None:
        fx_px, _, cx_px, _, _, fy_px, cy_px = info.P[:7]
        self._camera = Intrinsics(fx_px, fy_px, cx_px, cy_px)

    def _on_joint_state(self, state: JointState) -> None:
        self._joints.update(zip(state.name, state.position))

    def _on_image(self, image: Image) -> None:
        if self._camera is None:
            return rospy.logwarn_throttle(5.0, "no camera_info yet, images are left out")
        try:
            T_map_sensor = self._pose(image.header.frame_id, image.header.stamp)
            seen = self._planner.insert_depth_image(depth_of(image), self._camera, T_map_sensor)
        except (tf2_ros.TransformException, PlannerError, ValueError) as error:
            return rospy.logwarn_throttle(5.0, f"an image is left out: {error}")
        rospy.loginfo(f"map version {seen.map_version}: gained {seen.information_gained:.1f}")
        self._has_new_map.set()

    def _plan(self, _: rospy.timer.TimerEvent) -> None:
        if not self._has_new_map.is_set() or not set(self._joint_names) <= self._joints.keys():
            return
        self._has_new_map.clear()
        joints = [self._joints[name] for name in self._joint_names]
        try:
            base = self._pose(self._base_frame, rospy.Time(0))
            plan = self._planner.plan(base, joints, self._motion_time_s, time_limit_ms=500)
        except (tf2_ros.TransformException, PlannerError) as error:
            return rospy.logwarn_throttle(5.0, f"no plan: {error}")
        rospy.loginfo(plan.message)
        self._command.publish(self._trajectory(plan))

    def _pose(self, frame: str, time: rospy.Time) -> pb.Pose:
        """T_map_frame; waits a little for a transform that comes after what it belongs to."""
        transform = self._tf.lookup_transform(self._map_frame, frame, time, rospy.Duration(0.2))
        p, q = transform.transform.translation, transform.transform.rotation
        return pb.Pose(x_m=p.x, y_m=p.y, z_m=p.z, qx=q.x, qy=q.y, qz=q.z, qw=q.w)

    def _trajectory(self, plan: pb.PlanReply) -> JointTrajectory:
        target = plan.joints
        point = JointTrajectoryPoint(
            positions=[target.pan_rad, target.tilt_rad, target.height_m],
            time_from_start=rospy.Duration(plan.move_time_s),
        )
        # A stamp of zero means that the motion starts at once.
        return JointTrajectory(joint_names=self._joint_names, points=[point])


def depth_of(image: Image) -> np.ndarray:
    """(height, width) uint16."""
    if image.encoding not in ("16UC1", "mono16"):
        raise ValueError(f"the image is {image.encoding}, it must be 16UC1")
    numbers = np.dtype(">u2" if image.is_bigendian else "<u2")
    rows = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
    # Rows may be padded at their end.
    return rows[:, : image.width * numbers.itemsize].copy().view(numbers)


if __name__ == "__main__":
    rospy.init_node("nbvopt")
    with PlannerClient(rospy.get_param("~server", "127.0.0.1:50051")) as client:
        node = PlanningNode(client)
        rospy.spin()
