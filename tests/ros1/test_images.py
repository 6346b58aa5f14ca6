"""The node takes depth images: its map is that of their points, inserted by the command line.

    NBVOPT_CLI=PATH/TO/nbvopt NBVOPT_ROS=BUILD/ros PYTHONPATH=BUILD/ros/python python3 test_images.py
"""

import os
import subprocess
import unittest

import numpy as np

MISSING = ""
try:
    import rosmaster  # noqa: F401, run as a program
    import rospy
    import tf2_ros
    from geometry_msgs.msg import TransformStamped
    from octomap_msgs.srv import GetOctomap, GetValue
    from sensor_msgs.msg import CameraInfo, CompressedImage, Image
    from std_srvs.srv import Empty

    import depth_frames
    from ros_system import NODE, RosSystem, wait_for
except ImportError as error:
    MISSING = str(error)

FRAME = "camera_optical_frame"
POSE = (0.2, 0.1, 0.4, -0.5, 0.5, -0.5, 0.5)  # x y z, and level along x
SERVICES = ("octomap_full", "octomap_binary", "optimize_current_pose")


@unittest.skipIf(MISSING, f"ROS 1 is not there: {MISSING}")
class ImageTest(unittest.TestCase):
    """Two nodes beside one camera: one takes its images, one what compressedDepth makes of them."""

    @classmethod
    def setUpClass(cls):
        cls.ros = RosSystem()
        for name, transport in (("raw", "raw"), ("packed", "compressedDepth")):
            cls.ros.start(
                *(NODE, f"__name:={name}", "depth_in:=/camera/depth/image", "_resolution:=0.05"),
                *(f"{service}:=/{name}/{service}" for service in SERVICES),
                f"_image_transport:={transport}",
            )
        rospy.init_node("camera", disable_signals=True)
        told = TransformStamped(child_frame_id=FRAME)
        told.header.frame_id = "map"
        p, q = told.transform.translation, told.transform.rotation
        p.x, p.y, p.z, q.x, q.y, q.z, q.w = POSE
        cls.tf = tf2_ros.StaticTransformBroadcaster()
        cls.tf.sendTransform(told)
        image = "/camera/depth/image"
        cls.info, cls.raw, cls.packed = (
            rospy.Publisher(topic, kind, queue_size=5)
            for topic, kind in (
                ("/camera/depth/camera_info", CameraInfo),
                (image, Image),
                (f"{image}/compressedDepth", CompressedImage),
            )
        )
        for publisher, nodes in ((cls.info, 2), (cls.raw, 1), (cls.packed, 1)):
            wait_for("the nodes", lambda: publisher.get_num_connections() == nodes)

    @classmethod
    def tearDownClass(cls):
        rospy.signal_shutdown("the tests are over")
        cls.ros.stop()

    @staticmethod
    def call(name: str, kind):
        rospy.wait_for_service(name, timeout=30)
        return rospy.ServiceProxy(name, kind)()

    def publish(self, publisher, image, info=None) -> None:
        stamp = rospy.Time.now()
        for message in (info, image):
            if message is not None:
                message.header.stamp, message.header.frame_id = stamp, FRAME
        if info is not None:
            self.info.publish(info)
        publisher.publish(image)

    def map_of(self, node: str, publisher, image) -> bytes:
        """The nodes of the octree that the image alone makes."""
        self.call(f"/{node}/reset", Empty)
        self.publish(publisher, image, depth_frames.camera_info())
        value = f"/{node}/get_map_info"
        wait_for("the image", lambda: self.call(value, GetValue).value > 0.0)
        return np.array(self.call(f"/{node}/octomap_full", GetOctomap).map.data, np.int8).tobytes()

    def by_hand(self, points: np.ndarray) -> bytes:
        scan, out = self.ros.folder / "scan.txt", self.ros.folder / "by_hand.ot"
        np.savetxt(scan, points, fmt="%.9g")
        pose = ",".join(map(repr, POSE))
        command = ("map", "insert", out, scan, "--pose", pose, "--create", "0.05", "--overwrite")
        out.unlink(missing_ok=True)
        cli = os.environ["NBVOPT_CLI"]
        subprocess.run([cli, *map(str, command)], capture_output=True, check=True)
        return out.read_bytes().split(b"\ndata\n", 1)[1]

    def test_maps_are_those_of_the_points(self):
        for frame, encoding in enumerate(("16UC1", "32FC1")):
            with self.subTest(encoding=encoding):
                image = depth_frames.image(frame, encoding)
                expected = self.by_hand(depth_frames.points(frame, encoding))
                self.assertEqual(self.map_of("raw", self.raw, image), expected)
                packed = depth_frames.compressed_image(frame, encoding)
                expected = self.by_hand(depth_frames.compressed_points(frame, encoding))
                self.assertEqual(self.map_of("packed", self.packed, packed), expected)

    def test_what_is_wrong_is_said(self):
        def wait_for_words(words: str, publish=lambda: None) -> None:
            def is_there() -> bool:
                publish()
                return words in self.ros.log()

            wait_for(f"'{words}'", is_there)

        def publish_two_and_one_info() -> None:
            self.publish(self.raw, depth_frames.image(0, "16UC1"))
            rospy.sleep(0.2)  # or the node takes the newer one alone
            self.publish(self.raw, depth_frames.image(0, "16UC1"), depth_frames.camera_info())

        small = depth_frames.image(0, "16UC1")
        small.height = 10
        self.publish(self.raw, small, depth_frames.camera_info())
        wait_for_words("an image has 40 x 10 pixels, its camera_info is of 40 x 30 pixels")
        words = "no camera_info of its stamp has come on /camera/depth/camera_info"
        wait_for_words(words, publish_two_and_one_info)
        packed = CompressedImage(format="16UC1; compressedDepth rvl", data=bytes(100))
        self.publish(self.packed, packed, depth_frames.camera_info())
        wait_for_words("'16UC1; compressedDepth rvl': set the transport's format to png")


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # of sockets that rospy leaves open
