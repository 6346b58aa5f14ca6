"""Tests the Python client, the simulated robot and the example driver against a real server.

    NBVOPT_CLI=PATH/TO/nbvopt PYTHONPATH=BUILD/python python3 test_nbvopt_client.py
"""

import os
import pathlib
import queue
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import grpc
import numpy as np

import simulated_robot
from nbvopt_client import (
    Intrinsics,
    MapFormat,
    PlannerClient,
    PlannerError,
    Tls,
    depth_image_scan,
    matrix,
    pb,
    plan_request,
    point_scan,
)
from served import Server
from simulated_robot import R_BODY_SENSOR, SimulatedRobot

PROGRAMS = pathlib.Path(simulated_robot.__file__).resolve().parent
# 2 x 2 pixels: a return at 1 m along the optical axis, one at 2 m, not known, nothing in range.
SMALL_DEPTH = np.array([[1000, 2000], [0, 65535]], np.uint16)
SMALL_CAMERA = Intrinsics(fx_px=10.0, fy_px=10.0, cx_px=0.0, cy_px=0.0)


def ahead(x_m: float, y_m: float, z_m: float) -> np.ndarray:
    """T_map_sensor of a level camera that looks along the map's x axis."""
    T = np.eye(4)
    T[:3, :3] = R_BODY_SENSOR
    T[:3, 3] = x_m, y_m, z_m
    return T


def coloured_points(ply: bytes) -> list:
    """The points of a binary PLY file as (x, y, z), sorted, to the millimetre."""
    header, body = ply.split(b"end_header\n")
    record = np.dtype([("xyz", "<f4", 3), ("rgb", "u1", 3)])
    assert f"element vertex {len(body) // record.itemsize}\n".encode() in header
    xyz = np.frombuffer(body, record)["xyz"].astype(float).round(3)
    return sorted(map(tuple, xyz.tolist()))


class ClientTest(unittest.TestCase):
    """One server for all tests; each starts with an empty map."""

    @classmethod
    def setUpClass(cls):
        cls.server = Server("--data-dir", "DATA", "--max-views", "3")
        cls.addClassCleanup(cls.server.stop)

    def setUp(self):
        self.planner = PlannerClient(self.server.address)
        self.addCleanup(self.planner.close)
        self.planner.clear_map(0.05)
        self.robot = SimulatedRobot()

    def look(self) -> pb.InsertScanReply:
        robot = self.robot
        return self.planner.insert_depth_image(robot.look(), robot.intrinsics, robot.T_map_sensor)

    def assert_fails(self, code: grpc.StatusCode, words: str, call, *arguments, **named):
        with self.assertRaises(PlannerError) as caught:
            call(*arguments, **named)
        self.assertEqual(caught.exception.code, code)
        self.assertIn(words, caught.exception.message)
        self.assertIn(words, str(caught.exception))


class InsertTest(ClientTest):
    def test_depth_image_lands_where_intrinsics_and_pose_say(self):
        before = self.planner.status().map_version
        reply = self.planner.insert_depth_image(SMALL_DEPTH, SMALL_CAMERA, ahead(1.01, 2.01, 0.51))
        self.assertEqual((reply.points_used, reply.rays_cleared, reply.points_ignored), (2, 1, 0))
        self.assertEqual(reply.map_version, before + 1)
        self.assertGreater(reply.information_gained, 0.0)
        # The second pixel looks to the right by 1 / fx: 0.2 m at 2 m, which is -y in the map.
        self.assertEqual(
            coloured_points(self.planner.get_map(MapFormat.COLOUR_PLY)),
            [(2.025, 2.025, 0.525), (3.025, 1.825, 0.525)],
        )

    def test_depth_scale_and_any_memory_layout(self):
        pose = ahead(1.01, 2.01, 0.51)
        self.planner.insert_depth_image(SMALL_DEPTH, SMALL_CAMERA, pose)
        expected = self.planner.get_map()
        in_half_millimetres = np.array([[2000, 4000], [0, 65535]], np.uint16)
        for name, depth, scale_m in (
            ("scaled", in_half_millimetres, 0.0005),
            ("big-endian", SMALL_DEPTH.astype(">u2"), 0.001),
            ("by columns", np.asfortranarray(SMALL_DEPTH), 0.001),
            ("strided", np.repeat(SMALL_DEPTH, 2, axis=1)[:, ::2], 0.001),
        ):
            with self.subTest(name):
                self.planner.clear_map()
                self.planner.insert_depth_image(depth, SMALL_CAMERA, pose, depth_scale_m=scale_m)
                self.assertEqual(self.planner.get_map(), expected)

    def test_points_are_the_same_as_the_depth_image_of_them(self):
        pose = ahead(1.01, 2.01, 0.51)
        self.planner.insert_depth_image(SMALL_DEPTH, SMALL_CAMERA, pose)
        expected = self.planner.get_map()
        points_m = np.array([[0.0, 0.0, 1.0], [0.2, 0.0, 2.0]])
        no_returns = np.array([[0.1, 0.1, 1.0]])
        for dtype in (np.float32, np.float64, ">f4"):
            with self.subTest(dtype):
                self.planner.clear_map()
                reply = self.planner.insert_points(
                    points_m.astype(dtype), pose, no_returns=no_returns.astype(dtype)
                )
                self.assertEqual((reply.points_used, reply.rays_cleared), (2, 1))
                self.assertEqual(self.planner.get_map(), expected)

    def test_points_that_are_not_finite_are_counted(self):
        points_m = np.array([[0.0, 0.0, 1.0], [np.nan, 0.0, 1.0]], np.float32)
        reply = self.planner.insert_points(points_m, ahead(0.0, 0.0, 0.5))
        self.assertEqual((reply.points_used, reply.points_ignored), (1, 1))

    def test_colours_reach_the_map(self):
        points_m = np.array([[0.0, 0.0, 1.0]], np.float32)
        colour = np.array([[11, 222, 133]], np.uint8)
        self.planner.insert_points(points_m, ahead(0.0, 0.0, 0.5), colours=colour)
        self.assertIn(colour.tobytes(), self.planner.get_map())
        self.planner.clear_map()
        self.planner.insert_points(points_m, ahead(0.0, 0.0, 0.5))
        self.assertNotIn(colour.tobytes(), self.planner.get_map())

    def test_a_stream_acknowledges_each_scan(self):
        points_m = np.array([[0.0, 0.0, 1.0]], np.float32)
        scans = [
            depth_image_scan(SMALL_DEPTH, SMALL_CAMERA, ahead(1.01, 2.01, 0.51)),
            point_scan(points_m, ahead(1.01, 2.01, 0.51)),
            pb.InsertScanRequest(),
            point_scan(points_m, ahead(1.01, 2.01, 0.51)),
        ]
        before = self.planner.status().map_version
        versions = []
        with self.assertRaises(PlannerError) as caught:
            for reply in self.planner.insert_scans(scans):
                versions.append(reply.map_version)
        self.assertEqual(versions, [before + 1, before + 2])
        self.assertEqual(caught.exception.code, grpc.StatusCode.INVALID_ARGUMENT)
        self.assertEqual(self.planner.status().map_version, before + 2)

    def test_poses_as_messages_with_a_quaternion(self):
        matrix_pose = ahead(1.01, 2.01, 0.51)
        quaternion = dict(qx=-0.5, qy=0.5, qz=-0.5, qw=0.5)
        self.planner.insert_depth_image(SMALL_DEPTH, SMALL_CAMERA, matrix_pose)
        expected = self.planner.get_map()
        self.planner.clear_map()
        message = pb.Pose(x_m=1.01, y_m=2.01, z_m=0.51, **quaternion)
        self.planner.insert_depth_image(SMALL_DEPTH, SMALL_CAMERA, message)
        self.assertEqual(self.planner.get_map(), expected)


class PlanTest(ClientTest):
    def setUp(self):
        super().setUp()
        self.look()

    def test_plan_is_in_reach_and_worth_what_evaluate_says(self):
        plan = self.planner.plan(self.robot.base, self.robot.joints, 0.5)
        q = np.array((plan.joints.pan_rad, plan.joints.tilt_rad, plan.joints.height_m))
        way = np.abs(q - self.robot.joints)
        self.assertTrue(np.all(way <= simulated_robot.JOINT_SPEED * 0.5 + 1e-12), way)
        self.assertGreater(plan.view.gain, plan.current.gain)
        gains = self.planner.evaluate([matrix(plan.sensor), self.robot.T_map_sensor]).gains
        self.assertEqual([gain.gain for gain in gains], [plan.view.gain, plan.current.gain])

    def test_base_as_matrix_and_planar(self):
        x_m, y_m, yaw_rad = self.robot.base
        T_map_base = np.eye(4)
        T_map_base[:3, :3] = simulated_robot._turn_z(yaw_rad)
        T_map_base[:2, 3] = x_m, y_m
        of_planar = self.planner.plan((x_m, y_m, yaw_rad), self.robot.joints, 1.0)
        of_matrix = self.planner.plan(T_map_base, self.robot.joints, 1.0)
        np.testing.assert_array_equal(matrix(of_matrix.base), T_map_base)
        self.assertEqual(of_planar.joints, of_matrix.joints)

    def test_a_matrix_keeps_every_bit(self):
        # A quaternion in between would change the last bits of most of these.
        for angle_rad in np.linspace(0.1, 3.0, 20):
            T = np.eye(4)
            T[:3, :3] = simulated_robot._turn_z(angle_rad) @ simulated_robot._turn_y(0.01)
            T[:3, 3] = 1.5, 1.5, 0.1
            plan = self.planner.plan(T, self.robot.joints, 0.1, max_evaluations=1)
            np.testing.assert_array_equal(matrix(plan.base), T)

    def test_every_option_arrives(self):
        def plan(**options):
            return self.planner.plan(self.robot.base, self.robot.joints, 1.0, **options)

        self.assertEqual(plan(search="nlopt:direct-l").solver, "nlopt:direct-l")
        grid = pb.Search(solver="grid", grid_steps=[0.8, 0.0, 0.0])
        self.assertEqual(plan(search=grid).status, pb.PLAN_STATUS_GRID_COMPLETE)
        composed = pb.Search(**{"global": "nlopt:crs2", "local": "none"})
        self.assertIn("nlopt:crs2", plan(search=composed).solver)
        self.assertEqual(plan(min_gain=1e9).status, pb.PLAN_STATUS_NO_GAIN_IN_REACH)
        self.assertEqual(plan(seed=7).seed, 7)
        self.assertEqual(plan(max_evaluations=3).status, pb.PLAN_STATUS_EVALUATION_LIMIT)
        slow = plan(search="random", time_limit_ms=1e-3)
        self.assertEqual(slow.status, pb.PLAN_STATUS_TIME_LIMIT)
        certified = plan(certify=0.3)
        self.assertEqual(certified.status, pb.PLAN_STATUS_CERTIFIED)
        self.assertLessEqual(certified.certificate.gap, 0.3)
        self.assertGreaterEqual(certified.certificate.upper_bound, certified.view.gain)
        self.assertFalse(plan().HasField("certificate"))
        self.assertEqual(plan(request_id=99).request_id, 99)
        self.assertFalse(plan().HasField("request_id"))

    def test_robot_that_follows_a_plan_arrives_where_the_plan_says(self):
        plan = self.planner.plan(
            self.robot.base, self.robot.joints, 1.0, base_twist=self.robot.base_twist
        )
        before = self.robot.T_map_sensor
        self.robot.move(plan.joints, plan.move_time_s)
        np.testing.assert_allclose(self.robot.T_map_sensor, matrix(plan.sensor), atol=1e-12)
        self.assertGreater(np.linalg.norm((self.robot.T_map_sensor - before)[:2, 3]), 0.1)

    def test_path_of_the_base_leads_to_where_the_view_is_taken(self):
        path = [(0.5, (0.1, 0.2, 0.3)), (1.5, (0.3, 0.2, 0.3))]
        plan = self.planner.plan(self.robot.base, self.robot.joints, 1.0, base_path=path)
        np.testing.assert_allclose(matrix(plan.base)[:2, 3], (0.2, 0.2), atol=1e-12)

    def test_stream_answers_each_state(self):
        states = queue.Queue()
        answers = self.planner.plan_stream(iter(states.get, None))
        for request_id in (5, 6, 7):
            states.put(
                plan_request(self.robot.base, self.robot.joints, 0.5, request_id=request_id)
            )
            answer = next(answers)
            self.assertEqual(answer.request_id, request_id)
            self.robot.move(answer.joints, 0.5)
        states.put(None)
        self.assertEqual(list(answers), [])

    def test_stream_always_answers_the_newest_state(self):
        requests = [
            plan_request(self.robot.base, self.robot.joints, 0.5, request_id=i) for i in range(50)
        ]
        answered = [answer.request_id for answer in self.planner.plan_stream(requests)]
        self.assertEqual(answered, sorted(set(answered)))
        self.assertEqual(answered[-1], 49)

    def test_stream_ends_when_it_is_closed(self):
        threads = threading.active_count()
        states = queue.Queue()
        states.put(plan_request(self.robot.base, self.robot.joints, 0.5))
        answers = self.planner.plan_stream(iter(states.get, None))
        next(answers)
        answers.close()
        self.assertEqual(list(answers), [])
        # The thread that reads states waits for one more, then finds that the call has ended.
        states.put(plan_request(self.robot.base, self.robot.joints, 0.5))
        for _ in range(100):
            if threading.active_count() <= threads:
                return
            time.sleep(0.05)
        self.fail("states are still being read")

    def test_stream_fails_at_a_bad_state(self):
        bad = plan_request(self.robot.base, self.robot.joints, float("nan"))
        with self.assertRaises(PlannerError) as caught:
            list(self.planner.plan_stream([bad]))
        self.assertEqual(caught.exception.code, grpc.StatusCode.INVALID_ARGUMENT)
        self.assertIn("motion_time_s", caught.exception.message)

    def test_evaluate_keeps_the_order_and_takes_both_kinds(self):
        mounted = (self.robot.base, self.robot.joints)
        away = ahead(1.0, 2.5, 1.2)
        reply = self.planner.evaluate([away, mounted, self.robot.T_map_sensor])
        far, of_joints, of_matrix = (view.gain for view in reply.gains)
        self.assertAlmostEqual(of_joints, of_matrix, delta=1e-6 * of_matrix)
        self.assertGreater(abs(far - of_joints), 1.0)
        self.assertEqual(reply.map_version, self.planner.status().map_version)


class MapTest(ClientTest):
    def test_saved_file_and_got_bytes_are_equal(self):
        self.look()
        for map_format in MapFormat:
            with self.subTest(map_format.name):
                saved = self.planner.save_map("saved", map_format)
                in_file = (self.server.data / "saved").read_bytes()
                self.assertEqual(in_file, self.planner.get_map(map_format))
                self.assertEqual(saved.bytes, len(in_file))
                self.assertEqual(saved.map_version, self.planner.status().map_version)

    def test_formats_are_those_that_their_names_say(self):
        self.look()
        first_lines = {kind: self.planner.get_map(kind).split(b"\n")[0] for kind in MapFormat}
        self.assertEqual(first_lines[MapFormat.BT], b"# Octomap OcTree binary file")
        self.assertEqual(first_lines[MapFormat.UNCERTAINTY_OT], b"# Octomap OcTree file")
        self.assertEqual(first_lines[MapFormat.COLOUR_OT], b"# Octomap OcTree file")
        self.assertIn(b"\nid ColorOcTree\n", self.planner.get_map(MapFormat.COLOUR_OT)[:500])
        self.assertEqual(first_lines[MapFormat.COLOUR_PLY], b"ply")

    def test_clear_and_load_bring_a_saved_map_back(self):
        self.look()
        counts = self.planner.status(with_counts=True).counts
        self.assertGreater(counts.information, 0.0)
        self.planner.save_map("room.ot")
        cleared = self.planner.clear_map(0.1)
        status = self.planner.status(with_counts=True)
        self.assertEqual((status.counts.occupied_voxels, status.resolution_m), (0, 0.1))
        loaded = self.planner.load_map("room.ot")
        self.assertEqual(loaded.resolution_m, 0.05)
        self.assertEqual(loaded.map_version, cleared.map_version + 1)
        self.assertEqual(self.planner.status(with_counts=True).counts, counts)

    def test_a_map_of_many_chunks_arrives_whole(self):
        self.planner.clear_map(0.01)
        self.look()
        got = self.planner.get_map()
        self.assertGreater(len(got), 2 * 2**20)  # chunks have at most 1 MiB
        self.planner.save_map("large.ot")
        self.assertEqual(got, (self.server.data / "large.ot").read_bytes())

    def test_status_counts_only_where_asked_for(self):
        self.look()
        self.assertFalse(self.planner.status().HasField("counts"))
        status = self.planner.status(with_counts=True)
        self.assertGreater(status.counts.occupied_voxels, 0)
        self.assertEqual(status.counted_version, status.map_version)


class RefusalTest(ClientTest):
    def test_codes_and_messages(self):
        base, joints = self.robot.base, self.robot.joints
        code, planner = grpc.StatusCode, self.planner
        self.assert_fails(code.NOT_FOUND, "none.ot", planner.load_map, "none.ot")
        self.assert_fails(code.PERMISSION_DENIED, "..", planner.save_map, "../out.ot")
        self.assert_fails(code.INVALID_ARGUMENT, "motion_time_s", planner.plan, base, joints, -1.0)
        self.assert_fails(
            code.INVALID_ARGUMENT, "magic", planner.plan, base, joints, 1.0, search="magic"
        )
        nowhere = np.diag((1.0, 1.0, -1.0, 1.0))
        self.assert_fails(code.INVALID_ARGUMENT, "rotation", planner.evaluate, [nowhere])
        self.assert_fails(code.OUT_OF_RANGE, "max_views", planner.evaluate, 4 * [np.eye(4)])
        self.assert_fails(code.INVALID_ARGUMENT, "format", planner.get_map, 99)

    def test_server_without_a_data_folder(self):
        server = Server()
        self.addCleanup(server.stop)
        with PlannerClient(server.address) as planner:
            self.assert_fails(
                grpc.StatusCode.FAILED_PRECONDITION, "no data folder", planner.save_map, "out.ot"
            )

    def test_no_server_there(self):
        with PlannerClient(f"unix:{self.server.folder}/nobody") as planner:
            self.assert_fails(grpc.StatusCode.UNAVAILABLE, "nobody", planner.status)

    def test_server_that_never_answers(self):
        path = str(self.server.folder / "silent")
        with socket.socket(socket.AF_UNIX) as silent:
            silent.bind(path)
            silent.listen()
            with PlannerClient(f"unix:{path}", timeout_s=0.2) as planner:
                with self.assertRaises(PlannerError) as caught:
                    planner.status()
        self.assertEqual(caught.exception.code, grpc.StatusCode.DEADLINE_EXCEEDED)


class ArgumentTest(ClientTest):
    def assert_refused(self, message: str, call, *arguments, **named):
        with self.assertRaises(ValueError) as caught:
            call(*arguments, **named)
        self.assertIn(message, str(caught.exception))

    def test_arrays_of_the_wrong_shape_or_type_are_not_sent(self):
        version = self.planner.status().map_version
        depth, camera, pose = SMALL_DEPTH, SMALL_CAMERA, np.eye(4)
        points_m = np.zeros((5, 3), np.float32)
        image, points = self.planner.insert_depth_image, self.planner.insert_points
        with_channel = depth[..., np.newaxis]
        self.assert_refused("depth has shape (2, 2, 1), it", image, with_channel, camera, pose)
        metres = depth / 1000.0
        self.assert_refused("depth holds float64, it must hold uint16", image, metres, camera, pose)
        self.assert_refused("depth is a list", image, [[1]], camera, pose)
        self.assert_refused("T_map_sensor has shape (3, 4)", image, depth, camera, pose[:3])
        self.assert_refused("points_m has shape (5, 2)", points, points_m[:, :2], pose)
        self.assert_refused("points_m holds int16", points, points_m.astype(np.int16), pose)
        colours = np.zeros((4, 3), np.uint8)
        self.assert_refused("colours has 4 rows, points_m 5", points, points_m, pose, colours)
        shades = np.zeros((5, 3), np.float32)
        self.assert_refused("colours holds float32", points, points_m, pose, shades)
        rays = np.zeros((3, 1), np.float32)
        self.assert_refused("no_returns has shape (3, 1)", points, points_m, pose, no_returns=rays)
        self.assertEqual(self.planner.status().map_version, version)

    def test_a_transposed_pose_is_noticed(self):
        transposed = ahead(1.0, 2.0, 3.0).T
        self.assert_refused("ends in the row", self.planner.evaluate, [transposed])

    def test_states_of_the_wrong_shape(self):
        joints = (0.0, 0.0, 0.4)
        self.assert_refused("base has shape (2,)", plan_request, (0.0, 0.0), joints, 1.0)
        self.assert_refused("base has shape (3, 3)", plan_request, np.eye(3), joints, 1.0)
        self.assert_refused("joints has shape (2,)", plan_request, np.eye(4), joints[:2], 1.0)
        self.assert_refused(
            "base_twist has shape (2,)", plan_request, np.eye(4), joints, 1.0, base_twist=(1, 2)
        )


class TlsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if shutil.which("openssl") is None:
            raise unittest.SkipTest("openssl is not there, it makes the certificates")
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="nbvopt-tls-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.certify("ca", signer=None)
        cls.certify("server", signer="ca")
        cls.certify("client", signer="ca")
        cls.certify("stranger", signer=None)
        cls.server = Server(
            *("--tls-cert", cls.pem("server"), "--tls-key", cls.pem("server.key")),
            *("--tls-client-ca", cls.pem("ca")),
            listen="0.0.0.0:0",  # on this machine's own addresses it takes no certificates
        )
        cls.addClassCleanup(cls.server.stop)
        cls.address = cls.server.address.replace("0.0.0.0", "127.0.0.1")

    @classmethod
    def pem(cls, name: str) -> str:
        return str(cls.folder / f"{name}.pem")

    @classmethod
    def certify(cls, name: str, signer) -> None:
        """Makes NAME.pem and NAME.key.pem, signed by SIGNER or by itself."""
        request = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2"]
        request += ["-subj", f"/CN={name}", "-addext", "subjectAltName=IP:127.0.0.1"]
        request += ["-keyout", cls.pem(f"{name}.key"), "-out", cls.pem(name)]
        if signer is not None:
            request += ["-CA", cls.pem(signer), "-CAkey", cls.pem(f"{signer}.key")]
        subprocess.run(request, check=True, capture_output=True)

    def tls(self, name: str) -> Tls:
        return Tls(
            server_ca=self.pem("ca"), certificate=self.pem(name), key=self.pem(f"{name}.key")
        )

    def test_a_known_client_is_served(self):
        with PlannerClient(self.address, self.tls("client")) as planner:
            self.assertEqual(planner.status().resolution_m, 0.05)

    def test_a_stranger_is_not(self):
        for name, tls in (("without TLS", None), ("by another CA", self.tls("stranger"))):
            with self.subTest(name), PlannerClient(self.address, tls, 5.0) as planner:
                with self.assertRaises(PlannerError) as caught:
                    planner.status()
                self.assertEqual(caught.exception.code, grpc.StatusCode.UNAVAILABLE)


class SimulatedRobotTest(unittest.TestCase):
    def test_depth_of_a_wall_does_not_depend_on_the_pixel(self):
        robot = SimulatedRobot()  # at y = 1.1, heads for +x
        self.look_towards(robot, pan_rad=-np.pi / 2)  # the wall y = 0
        self.assertTrue(np.all(robot.look()[:180] == 1100), robot.look())

    def test_too_near_and_nothing_in_range(self):
        robot = SimulatedRobot()
        robot._joints = np.array((np.pi, 0.0, 0.6))  # the wall x = 0 is at 3 m, the desk nearer
        depth = robot.look()
        rays = simulated_robot._pixel_rays(robot.intrinsics)
        distance_m = 0.001 * depth * np.linalg.norm(rays, axis=-1)
        seen = (depth > 0) & (depth < 65535)
        self.assertTrue(np.all((distance_m[seen] > 0.499) & (distance_m[seen] < 4.001)))
        self.assertIn(3000, depth)
        robot._joints = np.array((0.3, 0.0, 0.4))  # over the stool into the far corner
        self.assertIn(65535, robot.look())
        robot._joints = np.array((0.0, -0.79, 0.18))  # the floor in front of the robot
        self.assertIn(0, robot.look())

    def test_field_of_view(self):
        camera = SimulatedRobot().intrinsics
        left, top = -(camera.cx_px + 0.5) / camera.fx_px, -(camera.cy_px + 0.5) / camera.fy_px
        self.assertAlmostEqual(np.degrees(2 * np.arctan(-left)), 59.0)
        self.assertAlmostEqual(np.degrees(2 * np.arctan(-top)), 46.0)

    def test_joints_keep_their_speed_and_limits(self):
        robot = SimulatedRobot()
        far = pb.JointPosition(pan_rad=10.0, tilt_rad=-2.0, height_m=2.0)
        robot.move(far, 0.1)
        np.testing.assert_allclose(robot.joints, (0.1 * np.pi, -0.05, 0.415))
        robot.move(far, 10.0)
        np.testing.assert_allclose(robot.joints, (10.0, -0.79, 0.63))

    def test_base_drives_a_closed_path_at_its_speed(self):
        robot = SimulatedRobot()
        start = robot.base
        robot.move(pb.JointPosition(), 0.01)
        step_m = np.hypot(robot.base[0] - start[0], robot.base[1] - start[1])
        self.assertAlmostEqual(step_m, 0.0025, places=7)
        robot = SimulatedRobot()
        robot.move(pb.JointPosition(), 2 * np.pi * simulated_robot.CIRCLE_RADIUS_M / 0.25)
        np.testing.assert_allclose(robot.base[:2], start[:2], atol=1e-12)

    @staticmethod
    def look_towards(robot: SimulatedRobot, pan_rad: float) -> None:
        robot._joints = np.array((pan_rad, 0.0, 0.5))


class DriverTest(unittest.TestCase):
    def test_driver_maps_the_room(self):
        server = Server()
        self.addCleanup(server.stop)
        lines = self.drive(server.address, steps=8)
        pattern = re.compile(r"step (\d+): gained ([\d.]+) in map version (\d+)")
        steps = [pattern.match(line) for line in lines[:-1]]
        self.assertEqual([int(step[1]) for step in steps], list(range(1, 9)))
        versions = [int(step[3]) for step in steps]
        self.assertEqual(versions, list(range(versions[0], versions[0] + 8)))
        gained = [float(step[2]) for step in steps]
        self.assertGreater(min(gained), 0.0)
        with PlannerClient(server.address) as planner:
            information = planner.status(with_counts=True).counts.information
        self.assertAlmostEqual(information, sum(gained), delta=1.0)  # they are rounded to 0.1
        self.assertEqual(lines[-1], f"the map holds {information:.1f}")
        # Where the camera rests, looking once more teaches much less.
        self.assertGreater(information, 4 * gained[0])

    @staticmethod
    def drive(address: str, steps: int) -> list:
        command = [sys.executable, str(PROGRAMS / "robot_driver.py"), address, str(steps)]
        done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, timeout=120)
        return done.stdout.splitlines()


if __name__ == "__main__":
    if "NBVOPT_CLI" not in os.environ:
        sys.exit("set NBVOPT_CLI to the nbvopt that serves")
    unittest.main()
