"""`nbvopt map build` of bags that rosbag wrote: the map is that of the frames inserted by hand.

    NBVOPT_CLI=PATH/TO/nbvopt python3 test_bag.py
"""

import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

MISSING = ""
try:
    import rosbag
    import rospy
    from geometry_msgs.msg import TransformStamped
    from std_msgs.msg import String
    from tf2_msgs.msg import TFMessage

    import depth_frames
except ImportError as error:
    MISSING = str(error)

FRAMES = 3
OPTICAL = (-0.5, 0.5, -0.5, 0.5)  # of a camera that looks along x, x y z w


def stamped(message, time_s: float, frame: str):
    message.header.stamp = rospy.Time.from_sec(time_s)
    message.header.frame_id = frame
    return message


def transform(time_s: float, parent: str, child: str, position, orientation) -> "TFMessage":
    told = stamped(TransformStamped(child_frame_id=child), time_s, parent)
    p, q = told.transform.translation, told.transform.rotation
    p.x, p.y, p.z = position
    q.x, q.y, q.z, q.w = orientation
    return TFMessage([told])


@unittest.skipIf(MISSING, f"rosbag is not there: {MISSING}")
class BagTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_cli(self, *arguments) -> subprocess.CompletedProcess:
        command = [os.environ["NBVOPT_CLI"], *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True)

    def build(self, bag: pathlib.Path, *arguments) -> dict:
        out = self.folder / "built.ot"
        said = self.run_cli("map", "build", bag, out, "--overwrite", "--json", *arguments)
        self.assertEqual(said.returncode, 0, said.stderr)
        return json.loads(said.stdout)

    def write(self, compression: str) -> pathlib.Path:
        path = self.folder / f"{compression}.bag"
        # Chunks of a few messages each.
        with rosbag.Bag(str(path), "w", compression=compression, chunk_threshold=20_000) as bag:

            def write(topic: str, message, time_s: float) -> None:
                bag.write(topic, message, rospy.Time.from_sec(time_s))

            camera = transform(1.0, "base_link", "camera_optical_frame", (0, 0, 0.4), OPTICAL)
            write("/tf_static", camera, 1.0)
            for i in range(FRAMES + 1):
                pose = (0.2 * i, 0, 0), (0, 0, math.sin(0.1 * i), math.cos(0.1 * i))
                write("/tf", transform(10.0 + i, "map", "base_link", *pose), 10.0 + i)
                write("/chatter", String("x" * 1000), 10.0 + i)
            for i in range(FRAMES):
                self.write_frame(write, i)
        return path

    def write_frame(self, write, frame: int) -> None:
        time_s = 10.0 + frame
        for topic, message in (
            ("/depth/camera_info", depth_frames.camera_info()),
            ("/depth/image_rect", depth_frames.image(frame, "16UC1")),
            *(
                (f"/depth/{encoding}/compressedDepth", depth_frames.compressed_image(frame, encoding))
                for encoding in ("16UC1", "32FC1")
            ),
            ("/depth/points", depth_frames.cloud(frame)),
        ):
            write(topic, stamped(message, time_s, "camera_optical_frame"), time_s)

    def by_hand(self, points) -> bytes:
        """The map of points(frame), (N, 3)."""
        out = self.folder / "by_hand.ot"
        out.unlink(missing_ok=True)
        for i in range(FRAMES):
            scan = self.folder / "scan.txt"
            np.savetxt(scan, points(i), fmt="%.9g")
            x, y, z, w = 0.0, 0.0, math.sin(0.1 * i), math.cos(0.1 * i)
            a, b, c, d = OPTICAL
            # The product of both turns.
            q = (
                w * a + z * -b,
                w * b + z * a,
                w * c + z * d,
                w * d - z * c,
            )
            pose = ",".join(map(repr, (0.2 * i, 0.0, 0.4, *q)))
            said = self.run_cli(
                *("map", "insert", out, scan, "--pose", pose, "--create", "0.05", "--overwrite")
            )
            self.assertEqual(said.returncode, 0, said.stderr)
        return out.read_bytes()

    def test_map_is_that_of_the_frames_by_hand(self):
        expected = self.by_hand(depth_frames.points)
        for compression in ("none", "bz2", "lz4"):
            bag = self.write(compression)
            for topic in ("/depth/points", "/depth/image_rect"):
                told = self.build(bag, "--topic", topic)
                self.assertEqual(told["frames_inserted"], FRAMES)
                self.assertEqual((told["fixed_frame"], told["topic"]), ("map", topic))
                with self.subTest(compression=compression, topic=topic):
                    self.assertEqual((self.folder / "built.ot").read_bytes(), expected)

    def test_compressed_images_are_what_was_compressed(self):
        bag = self.write("none")
        for encoding in ("16UC1", "32FC1"):
            expected = self.by_hand(lambda i: depth_frames.compressed_points(i, encoding))
            told = self.build(bag, "--topic", f"/depth/{encoding}/compressedDepth")
            self.assertEqual(told["frames_inserted"], FRAMES)
            with self.subTest(encoding=encoding):
                self.assertEqual((self.folder / "built.ot").read_bytes(), expected)

    def test_refusals_name_the_remedy(self):
        bag = self.write("none")
        out = self.folder / "out.ot"
        truncated = self.folder / "truncated.bag"
        truncated.write_bytes(bag.read_bytes()[:-1000])
        for path, arguments, said in (
            (bag, (), "choose one by topic: /depth/16UC1/compressedDepth"),
            (bag, ("--topic", "/chatter"), "no clouds or depth images on the topic '/chatter'"),
            (bag, ("--topic", "/depth/points", "--fixed-frame", "odom"), "to 'odom'"),
            (truncated, ("--topic", "/depth/points"), "truncated"),
            (pathlib.Path(__file__), (), "is no rosbag"),
        ):
            result = self.run_cli("map", "build", path, out, *arguments)
            self.assertEqual(result.returncode, 3, result.stderr)
            self.assertIn(said, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertFalse(out.exists())
        result = self.run_cli("map", "build", bag, out, "--format", "tum")
        self.assertEqual(result.returncode, 2)


if __name__ == "__main__":
    unittest.main()
