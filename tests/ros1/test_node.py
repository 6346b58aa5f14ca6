"""The ROS node with a simulated robot and a real master, called as rospy and rosservice call it.

    NBVOPT_CLI=PATH/TO/nbvopt NBVOPT_ROS=BUILD/ros PYTHONPATH=BUILD/ros/python python3 test_node.py
"""

import json
import math
import os
import pathlib
import subprocess
import unittest

import numpy as np

MISSING = ""
try:
    import rosmaster  # noqa: F401, run as a program
    import rospy
    import tf2_ros
    from geometry_msgs.msg import Point, PoseStamped, TransformStamped
    from nav_msgs.msg import OccupancyGrid, Path
    from octomap_msgs.msg import Octomap
    from octomap_msgs.srv import (
        BoundingBoxQuery,
        EstimateGain,
        GetAABBoxValue,
        GetOctomap,
        GetValue,
    )
    from reconstruction_3d_planner.srv import OptimizeCurrentPose
    from sensor_msgs.msg import JointState, PointCloud2
    from std_srvs.srv import Empty
    from trajectory_msgs.msg import JointTrajectory
    from visualization_msgs.msg import MarkerArray

    from ros_system import CONFIG, NODE, ROBOT, RosSystem, wait_for
except ImportError as error:
    MISSING = str(error)

DATASETS = pathlib.Path(__file__).resolve().parents[2] / "datasets"
WORLD = DATASETS / "office.world"
BASE = (0.62, 0.71, 0.3)  # x, y, yaw: the robot stands, so that nothing depends on time
MOTION_TIME_S = 0.5
LOOKS = 6


def cli_json(*arguments) -> dict:
    command = [os.environ["NBVOPT_CLI"], *map(str, arguments)]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def corners(low, high):
    return {"min": Point(*low), "max": Point(*high)}


@unittest.skipIf(MISSING, f"ROS 1 is not there: {MISSING}")
class InterfaceTest(unittest.TestCase):
    def test_types_are_those_of_other_programs(self):
        """The sums by which ROS compares types, from octomap_msgs as others have built it."""
        self.assertEqual(Octomap._md5sum, "9a45536b45c5e409cd49f04bb2d9999f")
        self.assertEqual(GetOctomap._md5sum, "be9d2869d24fe40d6bc21ac21f6bb2c5")
        self.assertEqual(BoundingBoxQuery._md5sum, "93aa3d73b866f04880927745f4aab303")

    def test_fields_are_those_of_the_paper_s_system(self):
        def fields(message):
            return list(zip(message._slot_types, message.__slots__))

        angles = ["angle_h_min", "angle_h_max", "angle_v_min", "angle_v_max"]
        numbers = ["h_res", "v_res", *angles, "range_min", "range_max", "unknown_gain_value"]
        self.assertEqual(
            fields(EstimateGain._request_class),
            [("geometry_msgs/PoseStamped", "pose"), *(("float32", name) for name in numbers)],
        )
        self.assertEqual(
            fields(EstimateGain._response_class),
            [("float32", "gain"), ("int64", "unknown_cells")],
        )
        self.assertEqual(fields(OptimizeCurrentPose._request_class), [("float32", "time")])
        self.assertEqual(
            fields(OptimizeCurrentPose._response_class),
            [
                ("string", "message"),
                ("bool", "success"),
                ("geometry_msgs/Pose", "pose"),
                ("float32", "pan"),
            ],
        )
        self.assertEqual(
            fields(GetValue._response_class),
            [("float32", "value"), ("float32", "value_occupied")],
        )
        self.assertEqual(
            fields(GetAABBoxValue._request_class)[2:], [("float32", "unknown_cell_value")]
        )


@unittest.skipIf(MISSING, f"ROS 1 is not there: {MISSING}")
class NodeTest(unittest.TestCase):
    """One system, looked at in the order in which a robot's day goes."""

    @classmethod
    def setUpClass(cls):
        cls.ros = RosSystem()
        cls.ros.load("octomap_server", CONFIG)
        shown = ("_publish_free_space:=true", "_publish_period:=0.1", "_occupancy_max_z:=0.5")
        cls.node = cls.ros.start(NODE, *shown)
        rospy.init_node("client", disable_signals=True)
        cls.tf = tf2_ros.Buffer()
        tf2_ros.TransformListener(cls.tf)
        cls.joints = {}
        rospy.Subscriber(
            "joint_states", JointState, lambda m: cls.joints.update(zip(m.name, m.position))
        )

    @classmethod
    def tearDownClass(cls):
        rospy.signal_shutdown("the tests are over")
        cls.ros.stop()

    @staticmethod
    def call(name: str, kind, *arguments, **fields):
        rospy.wait_for_service(name, timeout=30)
        return rospy.ServiceProxy(name, kind)(*arguments, **fields)

    def information(self) -> float:
        return self.call("/octomap_server/get_map_info", GetValue).value

    def look(self):
        return self.call("/optimize_current_pose", OptimizeCurrentPose, MOTION_TIME_S)

    def box_values(self, service: str, box: dict) -> tuple:
        """Without and with 1 for each unknown voxel."""
        name = f"/octomap_server/{service}"
        return tuple(
            self.call(name, GetAABBoxValue, **box, unknown_cell_value=value).value
            for value in (0.0, 1.0)
        )

    def start_robot(self) -> subprocess.Popen:
        x_m, y_m, yaw_rad = BASE
        drive = self.ros.folder / "stands.csv"
        line = f"{x_m},{y_m},0,{yaw_rad}\n"
        drive.write_text(f"time_s,x_m,y_m,z_m,yaw_rad\n0,{line}{(LOOKS - 1) * MOTION_TIME_S},{line}")
        self.ros.load("simulated_robot", CONFIG)
        return self.ros.start(ROBOT, f"_world:={WORLD}", f"_trajectory:={drive}")

    def test_1_says_what_is_missing(self):
        answer = self.look()
        self.assertFalse(answer.success)
        self.assertIn('"map"', answer.message)
        self.assertEqual(self.information(), 0.0)

    def test_2_the_camera_follows_and_the_map_grows(self):
        robot = self.start_robot()
        wait_for("the first cloud", lambda: self.information() > 0.0)
        information = [self.information()]
        for _ in range(LOOKS - 1):
            before = dict(self.joints)
            answer = self.look()
            self.assertTrue(answer.success, answer.message)
            self.check_camera_is_there(answer, before)
            information.append(self.information())
        self.assertEqual(information, sorted(information))
        simulated = cli_json(
            *("simulate", WORLD, "--trajectory", self.ros.folder / "stands.csv", "--mode", "auto"),
            *("--motion-time", MOTION_TIME_S, "--json"),
        )["information"]
        # It looks on its way, too, and plans with what it then knows.
        self.assertGreater(information[-1], 0.9 * simulated)
        self.assertGreater(information[-1], 2.0 * information[0])
        self.check_path_is_heeded()
        robot.terminate()
        robot.wait()

    def check_camera_is_there(self, answer, before: dict) -> None:
        pan = self.joints["telescopic_arm_continuous_joint"]
        self.assertAlmostEqual(pan, answer.pan, delta=0.02)
        moved = abs(pan - before["telescopic_arm_continuous_joint"])
        self.assertLessEqual(moved, math.pi * MOTION_TIME_S + 1e-3)
        frame = "top_camera_rgb_optical_frame"
        sensor = self.tf.lookup_transform("map", frame, rospy.Time(0)).transform
        there, said = sensor.translation, answer.pose.position
        np.testing.assert_allclose(
            (there.x, there.y, there.z), (said.x, said.y, said.z), rtol=0, atol=0.01
        )
        q, r = sensor.rotation, answer.pose.orientation
        cosine = abs(q.x * r.x + q.y * r.y + q.z * r.z + q.w * r.w)
        self.assertGreater(cosine, math.cos(0.02))

    def check_path_is_heeded(self) -> None:
        """The base is said to be a metre further on by then."""
        publisher = rospy.Publisher("base_path", Path, queue_size=1, latch=True)
        path = Path()
        path.header.frame_id = "map"
        now = rospy.Time.now().to_sec()
        for i in range(1000):
            pose = PoseStamped()
            pose.header.stamp = rospy.Time.from_sec(now + 0.1 * i)
            pose.pose.position.x, pose.pose.position.y = BASE[0] + 1.0, BASE[1]
            pose.pose.orientation.w = 1.0
            path.poses.append(pose)
        publisher.publish(path)
        wait_for("the path", lambda: publisher.get_num_connections() > 0)
        x_m = BASE[0] + 1.0
        wait_for("a view from there", lambda: abs(self.look().pose.position.x - x_m) < 0.01)
        publisher.unregister()

    def test_3_services_tell_of_the_map_that_they_give(self):
        message = self.call("/octomap_full", GetOctomap).map
        self.assertEqual((message.id, message.binary), ("UncertaintyOcTree", False))
        self.assertAlmostEqual(message.resolution, 0.1)
        file = self.ros.folder / "map.ot"
        data = np.array(message.data, np.int8).tobytes()
        header = "# Octomap OcTree file\nid UncertaintyOcTree\nsize 0\nres 0.1\ndata\n"
        file.write_bytes(header.encode() + data)
        info = cli_json("map", "info", file, "--json")
        self.assertAlmostEqual(self.information() / info["information"], 1.0, places=5)
        voxels = self.call("/octomap_server/get_map_voxels", GetValue)
        self.assertEqual(voxels.value, info["certain_voxels"])
        self.assertEqual(voxels.value_occupied, info["certain_voxels"])
        binary = self.call("/octomap_binary", GetOctomap).map
        self.assertEqual((binary.id, binary.binary), ("OcTree", True))
        self.assertLess(len(binary.data), len(message.data) / 4)
        self.check_gain(file)
        self.check_boxes(info)

    def check_gain(self, file: pathlib.Path) -> None:
        base = dict(zip(("x", "y", "z", "yaw"), (BASE[0], BASE[1], 0.0, BASE[2])))
        position, q = [1.2, 1.5, 0.5], [-0.5, 0.5, -0.5, 0.5]  # level, along x
        views = self.ros.folder / "views.json"
        case = {"position": position, "orientation_xyzw": q}
        sensor = {"half_fov_horizontal_rad": 0.5, "half_fov_vertical_rad": 0.375}
        sensor.update(horizontal_rays=32, vertical_rays=24, range_max_m=3.0)
        views.write_text(json.dumps({"cases": [case], "sensor": sensor}))
        known = cli_json("evaluate", file, "--poses", views)["cases"][0]
        pose = PoseStamped()
        pose.header.frame_id = "map"
        pose.pose.position = Point(*position)
        (o := pose.pose.orientation).x, o.y, o.z, o.w = q
        rays = (32, 24, -0.5, 0.5, -0.375, 0.375, 0.5, 3.0)
        name = "/octomap_server/estimate_gain"
        answer = self.call(name, EstimateGain, pose, *rays, 1.0)
        self.assertAlmostEqual(answer.gain / known["gain"], 1.0, places=5)
        self.assertEqual(answer.unknown_cells, known["unknown_rays"])
        self.assertGreater(answer.unknown_cells, 0)
        none_of_unknown = self.call(name, EstimateGain, pose, *rays, 0.0).gain
        doubled = self.call(name, EstimateGain, pose, *rays, 2.0).gain
        self.assertLess(none_of_unknown, answer.gain)
        self.assertAlmostEqual(
            doubled - answer.gain, answer.gain - none_of_unknown, delta=1e-4 * answer.gain
        )
        uneven = (pose, 32, 24, -0.5, 0.6, -0.4, 0.4, 0.5, 3.0, 1.0)
        with self.assertRaisesRegex(rospy.ServiceException, "angle_h_min and angle_h_max are -0.5"):
            self.call(name, EstimateGain, *uneven)
        pose.header.frame_id = "nowhere"
        with self.assertRaisesRegex(rospy.ServiceException, "nowhere"):
            self.call(name, EstimateGain, pose, *rays, 1.0)

    def check_boxes(self, info: dict) -> None:
        low, high = info["min_m"], info["max_m"]
        inside = 0.01  # of the outermost voxels
        box = corners([c + inside for c in low], [c - inside for c in high])
        voxels = np.prod([round((b - a) / 0.1) for a, b in zip(low, high)])
        unknown = voxels - info["occupied_voxels"] - info["free_voxels"]
        held, held_with_unknown = self.box_values("get_AABBox_info", box)
        self.assertAlmostEqual(held / info["information"], 1.0, places=5)
        self.assertAlmostEqual((held_with_unknown - held) / unknown, 1.0, places=4)
        gain, _ = self.box_values("get_AABBox_gain", box)
        self.assertAlmostEqual(gain, info["occupied_voxels"] - held, delta=1e-4 * gain)
        upside_down = corners((1, 0, 0), (0, 1, 1))
        with self.assertRaisesRegex(rospy.ServiceException, "min nowhere above its max"):
            self.box_values("get_AABBox_info", upside_down)
        with self.assertRaisesRegex(rospy.ServiceException, "min nowhere above its max"):
            self.call("/octomap_server/clear_bbx", BoundingBoxQuery, **upside_down)

    def test_4_topics_show_the_map(self):
        cubes = rospy.wait_for_message("occupied_cells_vis_array", MarkerArray, timeout=30)
        points = sum(len(marker.points) for marker in cubes.markers)
        self.assertGreater(points, 100)
        voxels = cubes.markers[-1]
        self.assertEqual((voxels.header.frame_id, voxels.action), ("map", voxels.ADD))
        self.assertAlmostEqual(voxels.scale.x, 0.1)
        self.assertEqual(len(voxels.colors), points)
        self.assertEqual(cubes.markers[0].action, voxels.DELETE)
        self.assertLess(max(point.z for point in voxels.points), 0.5, "occupancy_max_z")
        reds = {round(colour.r, 2) for colour in voxels.colors}
        self.assertGreater(len(reds), 3)  # surely and less surely seen voxels
        centres = rospy.wait_for_message("octomap_point_cloud_centers", PointCloud2, timeout=30)
        self.assertEqual(centres.width, points)
        free = rospy.wait_for_message("free_cells_vis_array", MarkerArray, timeout=30)
        self.assertGreater(sum(len(marker.points) for marker in free.markers), 100)
        plan = rospy.wait_for_message("projected_map", OccupancyGrid, timeout=30)
        self.assertEqual(len(plan.data), plan.info.width * plan.info.height)
        self.assertEqual(set(plan.data), {-1, 0, 100})
        full = rospy.wait_for_message("octomap_full", Octomap, timeout=30)
        self.assertEqual(full.data, self.call("/octomap_full", GetOctomap).map.data)
        self.assertTrue(rospy.wait_for_message("octomap_binary", Octomap, timeout=30).binary)

    def test_5_boxes_and_the_map_are_cleared(self):
        box = corners((0.0, 0.0, 0.05), (2.0, 2.0, 1.0))
        held, with_unknown = self.box_values("get_AABBox_info", box)
        self.assertGreater(held, 0.0)
        all_held = self.information()
        self.call("/octomap_server/clear_bbx", BoundingBoxQuery, **box)
        cleared, unknown = self.box_values("get_AABBox_info", box)
        self.assertEqual(cleared, 0.0)
        self.assertAlmostEqual(unknown, with_unknown - held, delta=1.0)
        self.assertAlmostEqual(self.information(), all_held - held, delta=1e-3 * all_held)
        # As other programs call it.
        said = subprocess.run(
            ["rosservice", "call", "/octomap_server/reset"], capture_output=True, text=True
        )
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertEqual(self.information(), 0.0)
        said = subprocess.run(
            ["rosservice", "call", "/octomap_server/get_map_voxels"], capture_output=True, text=True
        )
        self.assertEqual(said.stdout, "value: 0.0\nvalue_occupied: 0.0\n")

    def test_6_parameters_that_cannot_be_are_named(self):
        for i, (parameter, named) in enumerate(
            (
                ("resolution:=-0.1", "resolution is -0.1"),
                ("fov/angle/horizontal/max:=1.0", "fov/angle/horizontal"),
                ("pan/vel:=fast", "pan/vel"),
                ("image_transport:=theora", "image_transport is 'theora'"),
                ("robot:=/nowhere.yaml", "/nowhere.yaml"),
                ("map:=/nowhere.ot", "/nowhere.ot"),
            )
        ):
            wrong = self.ros.start(NODE, f"__name:=wrong_{i}", f"_{parameter}")
            self.assertEqual(wrong.wait(timeout=30), 3)
            self.assertIn(named, self.ros.log())

    def start_apart(self, name: str, *parameters) -> subprocess.Popen:
        """Another node, whose services of global names come under its own."""
        services = ("octomap_full", "octomap_binary", "optimize_current_pose")
        apart = (f"{service}:=/{name}/{service}" for service in services)
        return self.ros.start(NODE, f"__name:={name}", *parameters, *apart)

    def test_7_a_map_that_is_given_is_kept(self):
        file = DATASETS / "office_partial.ot"
        self.start_apart("given", f"_map:={file}", "_resolution:=0.3")
        info = cli_json("map", "info", file, "--json")
        held = self.call("/given/get_map_info", GetValue).value
        self.assertAlmostEqual(held / info["information"], 1.0, places=5)
        message = self.call("/given/octomap_full", GetOctomap).map
        self.assertAlmostEqual(message.resolution, info["resolution_m"])

    def test_8_joints_are_those_of_the_urdf(self):
        """The camera's height is 0.18 m and three times what the lowest of three lifts says."""
        robot = (f"_robot:={DATASETS}/robots/lift.urdf", "_camera_link:=camera_link")
        self.start_apart("lift", *robot, "_arrival/timeout:=0.0")
        base = TransformStamped(child_frame_id="base_link")
        base.header.frame_id = "map"
        base.transform.rotation.w = 1.0
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(base)
        publisher = rospy.Publisher("joint_states", JointState, queue_size=1, latch=True)
        names = ["pan_joint", "tilt_joint", "lift_1_joint"]
        publisher.publish(JointState(name=names, position=[0.0, 0.0, 0.1]))
        commands = []
        command = "/sensor_trajectory_controller/command"
        rospy.Subscriber(command, JointTrajectory, commands.append)
        time_s = 0.1

        def has_moved() -> bool:
            self.answer = self.call("/lift/optimize_current_pose", OptimizeCurrentPose, time_s)
            return self.answer.success and len(commands) > 0

        wait_for("a command", has_moved)
        height_m = self.answer.pose.position.z
        self.assertAlmostEqual(height_m, 0.18 + 3 * 0.1, delta=0.15 * time_s + 1e-6)

        def commanded_m() -> float:
            target = dict(zip(commands[-1].joint_names, commands[-1].points[0].positions))
            return 0.18 + 3 * target["lift_1_joint"]

        wait_for("that height", lambda: abs(commanded_m() - height_m) < 1e-6)


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # of sockets that rospy leaves open
