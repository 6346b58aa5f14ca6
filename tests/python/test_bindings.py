"""Tests the module nbvopt: its answers are those of the command line, to the last bit.

    NBVOPT_CLI=PATH/TO/nbvopt PYTHONPATH=BUILD/python python3 test_bindings.py
"""

import gc
import json
import pathlib
import re
import tempfile
import threading
import time
import unittest
import zlib

import numpy as np

import nbvopt
from support import BASE, JOINTS, OFFICE, ModuleTest, cli_json, gains_of, run_cli

# Views from several places of the office: base, then pan, tilt and height.
VIEWS = [
    ((1.9, 2.6, 1.57), (0.0, -0.2, 0.4)),
    ((1.9, 2.6, 1.57), (2.07, 0.014, 0.541)),
    ((4.1, 1.2, 0.1, -0.4), (-2.9, 0.7, 0.63)),
    ((2.0, 4.4, 3.0), (0.6, -0.79, 0.18)),
]

# Level, at a height of 0.42 m, looking along the map's x.
FORWARD = np.array([[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0.42], [0, 0, 0, 1.0]])


def image_rows(png: bytes) -> list:
    """The rows of a picture of three bytes a pixel, as filtered: equal where they and the rows
    before them are."""
    width = int.from_bytes(png[16:20], "big")
    data, at = b"", 8
    while at < len(png):
        size, kind = int.from_bytes(png[at : at + 4], "big"), png[at + 4 : at + 8]
        if kind == b"IDAT":
            data += png[at + 8 : at + 8 + size]
        at += 12 + size
    pixels, row = zlib.decompress(data), 1 + 3 * width
    return [pixels[i : i + row] for i in range(0, len(pixels), row)]


def cli_evaluate(*arguments: str, sensor: dict = {}) -> list:
    """What the command line says of VIEWS, an object a view."""
    cases = [
        {
            "base": dict(zip("xyz", base[:-1]), yaw=base[-1]),
            "pan": pan,
            "tilt": tilt,
            "height": height,
        }
        for base, (pan, tilt, height) in VIEWS
    ]
    poses = json.dumps({"sensor": sensor, "cases": cases})
    return cli_json("evaluate", OFFICE, "--poses", "-", *arguments, text=poses)["cases"]


def cli_query(*arguments: str) -> dict:
    base = ",".join(map(str, BASE))
    situation = ["--base", base, "--pan", "0", "--tilt", "0", "--height", "0.4"]
    return cli_json("query", OFFICE, *situation, *arguments, "--json")


class BindingsTest(ModuleTest):
    @classmethod
    def setUpClass(cls):
        cls.office = nbvopt.Map(OFFICE)
        cls.robot = nbvopt.Robot()
        cls.poses = np.concatenate(
            [nbvopt.sensor_poses(cls.robot, base, [joints]) for base, joints in VIEWS]
        )


class MapTest(BindingsTest):
    def test_tells_what_map_info_tells(self):
        info = run_cli("map", "info", OFFICE)
        counts = self.office.counts()
        self.assertEqual(self.office.resolution_m, 0.05)
        self.assertIn(f"occupied voxels    {counts.occupied_voxels}\n", info)
        self.assertIn(f"free voxels        {counts.free_voxels}\n", info)
        self.assertIn(f"occupied with u<1  {counts.certain_voxels}\n", info)
        self.assertIn(f"information        {counts.information:.1f}\n", info)
        self.assertIn(f"leaves, nodes      {counts.leaves}, {counts.nodes}\n", info)
        (x0, y0, z0), (x1, y1, z1) = self.office.known_box_m
        box = f"{x0:.2f} to {x1:.2f}, {y0:.2f} to {y1:.2f}, {z0:.2f} to {z1:.2f} m"
        self.assertIn(f"known box          {box}\n", info)

    def test_slices_add_up_to_the_counts(self):
        """Every voxel of the known box is in one slice, and u as Eq. 11 sums it."""
        (_, _, bottom_m), (_, _, top_m) = self.office.known_box_m
        layers = round((top_m - bottom_m) / self.office.resolution_m)
        heights_m = bottom_m + (np.arange(layers) + 0.5) * self.office.resolution_m
        occupied, free, information = 0, 0, 0.0
        for z_m in heights_m:
            layer = self.office.slice(z_m)
            is_occupied = layer.states == 2
            occupied += is_occupied.sum()
            free += (layer.states == 1).sum()
            information += (1.0 - layer.uncertainty[is_occupied].astype(float)).sum()
            self.assertTrue((layer.uncertainty[~is_occupied] == 1.0).all())
        counts = self.office.counts()
        self.assertEqual((occupied, free), (counts.occupied_voxels, counts.free_voxels))
        self.assertAlmostEqual(information, counts.information, places=3)

    def test_a_slice_spans_the_known_box(self):
        layer = self.office.slice(0.4)
        left, right, bottom, top = layer.extent_m
        (x0, y0, _), (x1, y1, _) = self.office.known_box_m
        self.assertEqual((left, right, bottom, top), (x0, x1, y0, y1))
        rows, columns = layer.states.shape
        self.assertEqual((rows, columns), (round((top - bottom) / 0.05), round((right - left) / 0.05)))
        self.assertEqual(layer.states.dtype, np.uint8)
        self.assertEqual(layer.uncertainty.shape, layer.states.shape)

    def test_a_scan_of_one_point_is_one_voxel_of_its_slice(self):
        made = nbvopt.Map(resolution_m=0.1)
        # Looking along the map's x: the point is at (1.02, -0.22, 0.42).
        made.insert([[0.22, 0, 1.02]], FORWARD)
        layer = made.slice(0.42)
        ((row, column),) = np.argwhere(layer.states == 2)
        left, _, bottom, _ = layer.extent_m
        self.assertAlmostEqual(left + (column + 0.5) * 0.1, 1.05)
        self.assertAlmostEqual(bottom + (row + 0.5) * 0.1, -0.25)
        self.assertLess(layer.uncertainty[row, column], 1.0)

    def test_far_from_the_map_all_is_unknown(self):
        self.assertTrue((self.office.slice(100.0).states == 0).all())

    def test_refuses_what_is_no_map(self):
        self.assert_refused("/no/such/map.ot: .*", nbvopt.Map, "/no/such/map.ot")
        self.assert_refused("give the path of a map, or .*", nbvopt.Map)
        self.assert_refused("give the path .*", nbvopt.Map, OFFICE, resolution_m=0.1)
        self.assert_refused(".*resolution.*", nbvopt.Map, resolution_m=0)
        self.assert_refused(f"{re.escape(__file__)}: .*", nbvopt.Map, __file__)
        self.assert_refused("z_m is nan, .*", self.office.slice, float("nan"))
        self.assert_refused(r"z_m is 1e\+06, .*", self.office.slice, 1e6)


class InsertTest(BindingsTest):
    """A scan of a wall two metres ahead with a hole in it, and a point that is too near."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        x, y = np.meshgrid(np.arange(-0.8, 0.8, 0.02), np.arange(-0.6, 0.6, 0.02))
        wall = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 2.0)])
        is_hole = (np.abs(wall[:, 0]) < 0.1) & (np.abs(wall[:, 1]) < 0.1)
        self.points = np.vstack([wall[~is_hole], [0.0, 0.0, 0.2]]).astype(np.float32)
        self.directions = wall[is_hole]
        self.colours = np.arange(self.points.size, dtype=np.uint8).reshape(-1, 3)

    def test_is_what_map_insert_does(self):
        lines = ["ply", "format ascii 1.0", f"element vertex {len(self.points)}"]
        lines += [f"property float {axis}" for axis in "xyz"]
        lines += [f"property uchar {colour}" for colour in ("red", "green", "blue")]
        lines += ["end_header"]
        for point, colour in zip(self.points, self.colours):
            lines.append(" ".join(map(repr, point.tolist())) + " {} {} {}".format(*colour))
        scan, theirs, ours = (self.folder / name for name in ("scan.ply", "theirs.ot", "ours.ot"))
        scan.write_text("\n".join(lines) + "\n")
        pose = "0,0,0.42,-0.5,0.5,-0.5,0.5"  # FORWARD
        told = cli_json(
            "map", "insert", OFFICE, scan, "--pose", pose, "--out", theirs, "--json"
        )
        office = nbvopt.Map(OFFICE)
        before = office.counts()
        done = office.insert(self.points, FORWARD, colours=self.colours)
        for key in (
            *("points_used", "rays_cleared", "points_ignored", "voxels_changed"),
            *("points_too_near", "points_too_far", "no_returns", "points_not_finite"),
        ):
            self.assertEqual(getattr(done, key), told[key], key)
        self.assertEqual(done.points_ignored, 1)
        after = office.counts()
        self.assertAlmostEqual(done.information_gained, after.information - before.information, 6)
        self.assertEqual(
            done.certain_voxels_gained, after.certain_voxels - before.certain_voxels
        )
        self.assertGreater(done.certain_voxels_gained, 100)
        office.save(ours)
        self.assertEqual(ours.read_bytes(), theirs.read_bytes())

    def test_what_returns_nothing_is_clear(self):
        made = nbvopt.Map(resolution_m=0.05)
        self.assertIsNone(made.known_box_m)
        made.insert(self.points, FORWARD)
        free = made.counts().free_voxels
        done = made.insert(np.empty((0, 3)), FORWARD, no_returns=self.directions)
        self.assertEqual((done.points_used, done.rays_cleared), (0, len(self.directions)))
        self.assertGreater(made.counts().free_voxels, free)

    def test_the_robot_says_how_far_it_sees(self):
        near = nbvopt.Robot.parse("sensor: {range_max_m: 1.5}")
        made = nbvopt.Map(resolution_m=0.05)
        self.assertEqual(made.insert(self.points, FORWARD, near).points_used, 0)
        self.assertEqual(made.counts().occupied_voxels, 0)
        planner = nbvopt.Planner(nbvopt.Map(resolution_m=0.05), near)
        self.assertEqual(planner.insert(self.points, FORWARD).points_used, 0)

    def test_the_next_plan_sees_it(self):
        """As it would see the map that was saved, whoever inserted."""
        office = nbvopt.Map(OFFICE)
        planner = nbvopt.Planner(office)
        situation = BASE, JOINTS, 1.0
        before = planner.plan(*situation)
        base = np.array([[0, 0, 1, 1.9], [-1, 0, 0, 2.6], [0, -1, 0, 0.4], [0, 0, 0, 1]])
        for insert in (planner.insert, office.insert):
            insert(self.points, base, colours=self.colours)
            planner.insert(np.empty((0, 3)), before.T_map_sensor, no_returns=[[0.0, 0.0, 1.0]])
            office.save(self.folder / "saved.ot")
            saved = nbvopt.Planner(nbvopt.Map(self.folder / "saved.ot"))
            look, expected = planner.plan(*situation), saved.plan(*situation)
            self.assertEqual(look.joints.tolist(), expected.joints.tolist())
            self.assertEqual(look.gain, expected.gain)
            self.assertNotEqual(look.gain, before.gain)
            self.assertEqual(
                gains_of(planner)(self.poses).tolist(), gains_of(saved)(self.poses).tolist()
            )

    def test_formats_are_those_of_map_convert(self):
        for extension, format in ((".bt", None), (".ply", None), (".ot", "colour-ot")):
            with self.subTest(extension):
                ours, theirs = (self.folder / (name + extension) for name in ("ours", "theirs"))
                options = ["--format", format] if format else []
                run_cli("map", "convert", OFFICE, theirs, *options)
                self.office.save(ours, format)
                self.assertEqual(ours.read_bytes(), theirs.read_bytes())
        self.assert_refused("map.txt: the extension .*", self.office.save, "map.txt")
        self.assert_refused("map format 'octo' .*", self.office.save, "map.ot", "octo")
        self.assert_refused("/no/such/map.ot: .*", self.office.save, "/no/such/map.ot")

    def test_refuses_what_is_no_scan(self):
        office = nbvopt.Map(OFFICE)
        insert = office.insert
        self.assert_refused(r"points has the shape \(3,\), .*", insert, [1, 2, 3], FORWARD)
        self.assert_refused("points must be an array of numbers", insert, "points", FORWARD)
        self.assert_refused(
            r"no_returns has the shape \(0,\), .*", insert, self.points, FORWARD, no_returns=[]
        )
        for colours, message in (
            (self.colours[:-1], ".* colours for .*"),
            (self.colours.astype(float), "colours must be an array of uint8"),
            (self.colours[:, :2], "colours has the shape .*"),
        ):
            self.assert_refused(message, insert, self.points, FORWARD, colours=colours)
        self.assert_refused(r"T_map_sensor has the shape \(3, 3\), .*", insert, [[0, 0, 1]], np.eye(3))
        self.assert_refused("T_map_sensor: .* a rotation", insert, self.points, FORWARD * [2, 2, 2, 1])
        far = FORWARD.copy()
        far[0, 3] = 1e6
        self.assert_refused(".*lattice.*", insert, self.points, far)
        self.assertEqual(office.counts().information, self.office.counts().information)


class RobotTest(BindingsTest):
    def test_default_is_the_papers(self):
        paper = pathlib.Path(OFFICE).parent / "robots" / "paper.yaml"
        self.assertEqual(nbvopt.Robot(paper), nbvopt.Robot())
        self.assertEqual(nbvopt.Robot().range_m, (0.5, 4.0))
        np.testing.assert_allclose(np.degrees(nbvopt.Robot().half_fov_rad), (29.5, 23.0))

    def test_urdf_is_the_papers_mast(self):
        lift = pathlib.Path(OFFICE).parent / "robots" / "lift.urdf"
        link = "camera_depth_optical_frame"
        self.assertEqual(nbvopt.Robot(lift, camera_link=link), nbvopt.Robot())
        self.assertEqual(nbvopt.Robot(lift, camera_link="camera_link"), nbvopt.Robot())
        self.assert_refused(".*lift.urdf: .*give camera_link.*", nbvopt.Robot, lift)
        for wrong in ({"camera_axes": "up"}, {"camera_axes": "body"}):
            with self.assertRaises(ValueError):
                nbvopt.Robot(lift, camera_link=link, **wrong)

    def test_yaml_reads_back(self):
        robot = nbvopt.Robot.parse("sensor: {range_max_m: 3}\nmast: {height_max_m: 1.2}")
        self.assertNotEqual(robot, self.robot)
        self.assertEqual(robot.range_m, (0.5, 3.0))
        self.assertEqual(nbvopt.Robot.parse(robot.to_yaml()), robot)
        self.assertEqual(eval(repr(robot), {"Robot": nbvopt.Robot}), robot)

    def test_refuses_what_it_does_not_know(self):
        self.assert_refused(
            "yaml_text: .*range_max.*did you mean 'range_max_m'.*",
            nbvopt.Robot.parse,
            "sensor: {range_max: 3}",
        )
        self.assert_refused("/no/robot.yaml: .*", nbvopt.Robot, "/no/robot.yaml")


class EvaluateTest(BindingsTest):
    def assert_same_views(self, views: dict, expected: list):
        self.assertEqual(len(expected), len(VIEWS))
        for key in expected[0]:
            self.assertEqual(views[key].tolist(), [case[key] for case in expected], key)

    def test_gains_are_those_of_the_command_line(self):
        expected = cli_evaluate()
        views = nbvopt.Planner(self.office, self.robot).evaluate(self.poses)
        self.assert_same_views(views, expected)
        self.assertGreater(max(views["gain"]), 1000.0)

    def test_paper_code_is_that_of_the_command_line(self):
        planner = nbvopt.Planner(self.office, evaluator="paper-code")
        expected = cli_evaluate("--evaluator", "paper-code")
        self.assert_same_views(planner.evaluate(self.poses), expected)

    def test_the_robot_counts(self):
        near = nbvopt.Robot.parse("sensor: {range_max_m: 2, counting: per_voxel}")
        expected = cli_evaluate(sensor={"range_max_m": 2, "counting": "per_voxel"})
        self.assert_same_views(nbvopt.Planner(self.office, near).evaluate(self.poses), expected)

    def test_any_layout_and_type_of_numbers(self):
        gains = gains_of(nbvopt.Planner(self.office))
        expected = gains(self.poses).tolist()
        for name, poses in (
            ("lists", self.poses.tolist()),
            ("by columns", np.asfortranarray(self.poses)),
            ("strided", np.repeat(self.poses, 2, axis=0)[::2]),
            ("big-endian", self.poses.astype(">f8")),
        ):
            with self.subTest(name):
                self.assertEqual(gains(poses).tolist(), expected)
        rounded = gains(self.poses.astype(np.float32))
        np.testing.assert_allclose(rounded, expected, rtol=0.01, atol=1.0)

    def test_no_views_have_no_gains(self):
        gains = gains_of(nbvopt.Planner(self.office))
        self.assertEqual(gains(np.empty((0, 4, 4))).shape, (0,))
        self.assertEqual(nbvopt.sensor_poses(self.robot, BASE, np.empty((0, 3))).shape, (0, 4, 4))

    def test_refuses_what_is_no_pose(self):
        gains = nbvopt.Planner(self.office).evaluate
        self.assert_refused(r"poses has the shape \(4, 4\), .*", gains, np.eye(4))
        self.assert_refused("poses must be an array of numbers", gains, "poses")
        self.assert_refused("poses must be an array of numbers", gains, [[[1.0], [2.0, 3.0]]])

        def spoilt(change):
            poses = self.poses.copy()
            change(poses[2])
            return poses

        def set_at(index, value):
            return lambda pose: pose.__setitem__(index, value)

        for message, change in (
            ("poses: every number must be finite", set_at((0, 3), np.nan)),
            (r"poses\[2\]: the last row .*", set_at((3, 0), 0.1)),
            (r"poses\[2\]: .* a rotation", set_at((0, 0), 2.0)),
            (r"poses\[2\]: .* a rotation", lambda pose: np.negative(pose[:, 0], out=pose[:, 0])),
            (r"poses\[2\]: the camera is off .*", set_at((0, 3), 1e6)),
        ):
            with self.subTest(message):
                self.assert_refused(message, gains, spoilt(change))
        self.assert_refused(
            "evaluator 'exakt' is not known, .*", nbvopt.Planner, self.office, evaluator="exakt"
        )

    def test_sensor_poses_follow_the_chain_of_frames(self):
        """translation(0, 0, height) Rz(pan) Ry(-tilt) O on a base, written out."""
        x, y, z, yaw, pan, tilt, height = 1.0, -2.0, 0.3, 0.7, 0.4, -0.3, 0.5
        azimuth = yaw + pan
        forward = [np.cos(azimuth) * np.cos(tilt), np.sin(azimuth) * np.cos(tilt), np.sin(tilt)]
        right = [np.sin(azimuth), -np.cos(azimuth), 0.0]
        expected = np.eye(4)
        expected[:3, 0], expected[:3, 2] = right, forward
        expected[:3, 1] = np.cross(forward, right)
        expected[:3, 3] = x, y, z + height
        (pose,) = nbvopt.sensor_poses(self.robot, (x, y, z, yaw), [(pan, tilt, height)])
        np.testing.assert_allclose(pose, expected, atol=1e-15)

    def test_sensor_poses_refuse_wrong_shapes(self):
        poses = nbvopt.sensor_poses
        self.assert_refused(r"base has the shape \(2,\), .*", poses, self.robot, (1, 2), [JOINTS])
        self.assert_refused(r"joints has the shape \(3,\), .*", poses, self.robot, BASE, JOINTS)
        self.assert_refused(
            "joints: every number must be finite", poses, self.robot, BASE, [(0, 0, np.inf)]
        )


class SurrogateTest(BindingsTest):
    def make(self, **options) -> nbvopt.Surrogate:
        return nbvopt.Surrogate(self.office, self.robot, BASE, JOINTS, 1.0, **options)

    def inside(self, surrogate, count: int, margin: float = 0.02) -> np.ndarray:
        low, high = surrogate.box
        share = np.random.default_rng(1).uniform(margin, 1.0 - margin, (count, 3))
        return low + share * (high - low)

    def test_box_is_what_the_joints_reach(self):
        """t = 1 s at pi rad/s, 0.5 rad/s and 0.15 m/s, nothing in the mast's way."""
        expected = [[-np.pi, -0.5, 0.25], [np.pi, 0.5, 0.55]]
        np.testing.assert_allclose(self.make().box, expected, atol=1e-12)

    def test_gain_is_nearly_the_exact_one(self):
        surrogate = self.make()
        joints = self.inside(surrogate, 200, margin=0.0)
        exact = gains_of(nbvopt.Planner(self.office))(
            nbvopt.sensor_poses(self.robot, BASE, joints)
        )
        self.assertGreater(np.corrcoef(surrogate.gains(joints), exact)[0, 1], 0.9995)

    def test_gradient_is_that_of_central_differences(self):
        surrogate = self.make(double_precision=True)
        joints = self.inside(surrogate, 40)
        gains, gradients = surrogate.gains_and_gradients(joints)
        self.assertEqual((gains.shape, gradients.shape), ((40,), (40, 3)))
        self.assertEqual(gains.tolist(), surrogate.gains(joints).tolist())
        h = 1e-5
        differences = np.stack(
            [
                (surrogate.gains(joints + h * axis) - surrogate.gains(joints - h * axis)) / (2 * h)
                for axis in np.eye(3)
            ],
            axis=1,
        )
        error = np.linalg.norm(gradients - differences) / np.linalg.norm(differences)
        self.assertLess(error, 1e-6)
        self.assertGreater(np.linalg.norm(gradients, axis=1).min(), 1.0)

    def test_options_reach_the_panorama(self):
        joints = self.inside(self.make(), 20)
        fine = self.make().gains(joints)
        for options in ({"ray_spacing": 2.0}, {"layer_spacing": 6.0}, {"smoothing": 3.0}):
            with self.subTest(options):
                gains = self.make(**options).gains(joints)
                self.assertFalse(np.array_equal(gains, fine))
                np.testing.assert_allclose(gains, fine, atol=0.1 * fine.max())

    def test_refuses_what_it_cannot_do(self):
        for message, options in (
            (".*ray_spacing.*", {"ray_spacing": 0.0}),
            (".*layer_spacing.*", {"layer_spacing": -1.0}),
            (".*smoothing.*", {"smoothing": float("nan")}),
        ):
            with self.subTest(message):
                self.assert_refused(message, self.make, **options)
        make = nbvopt.Surrogate
        situation = self.office, self.robot
        self.assert_refused("motion_time_s is -1 s, .*", make, *situation, BASE, JOINTS, -1.0)
        self.assert_refused("tilt is 2 rad.*", make, *situation, BASE, (0, 2, 0.4), 1.0)
        self.assert_refused("joints has the shape .*", make, *situation, BASE, [JOINTS], 1.0)
        surrogate = self.make()
        outside = [JOINTS, (0.0, 0.7, 0.4)]
        self.assert_refused(r"joints\[1\] is outside .*", surrogate.gains, outside)
        self.assert_refused(r"joints\[1\] is outside .*", surrogate.gains_and_gradients, outside)


class PlanTest(BindingsTest):
    def plan(self, motion_time_s: float = 1.0, evaluator="exact", **options) -> nbvopt.PlanResult:
        planner = nbvopt.Planner(self.office, self.robot, evaluator)
        return planner.plan(BASE, JOINTS, motion_time_s, **options)

    def assert_same_answer(self, answer: nbvopt.PlanResult, expected: dict):
        joints = [expected["pan"], expected["tilt"], expected["height"]]
        self.assertEqual(answer.joints.tolist(), joints)
        for key in (
            "gain current_gain unknown_gain occupied_gain unknown_rays occupied_rays free_rays "
            "status message evaluations surrogate_evaluations move_time_s solver seed "
            "active_bounds warnings"
        ).split():
            self.assertEqual(getattr(answer, key), expected[key], key)
        self.assertEqual(answer.T_map_sensor[:3, 3].tolist(), expected["pose"]["position"])

    def test_answers_are_those_of_the_command_line(self):
        for arguments, options in (
            ([], {}),
            (["--solver", "grid"], {"solver": "grid"}),
            (
                ["--solver", "grid", "--step-tilt", "0.25", "--step-height", "0.1"],
                {"solver": "grid", "step_tilt_rad": 0.25, "step_height_m": 0.1},
            ),
            (["--solver", "random", "--seed", "7"], {"solver": "random", "seed": 7}),
            (["--max-evals", "20"], {"max_evaluations": 20}),
            (
                ["--global", "none", "--local", "nlopt:slsqp", "--polish", "nlopt:sbplx"],
                {
                    "global_solver": "none",
                    "local_solver": "nlopt:slsqp",
                    "polish_solver": "nlopt:sbplx",
                },
            ),
            (
                ["--evaluator", "paper-code", "--solver", "grid"],
                {"evaluator": "paper-code", "solver": "grid"},
            ),
            (["--base-velocity", "0.2,0,0.3"], {"base_twist": (0.2, 0, 0.3)}),
            (["--min-gain", "5000"], {"min_gain": 5000}),
        ):
            with self.subTest(arguments):
                expected = cli_query("--motion-time", "1", *arguments)
                self.assert_same_answer(self.plan(**options), expected)

    def test_path_of_the_base_leads_to_where_the_view_is_taken(self):
        x, y, yaw = BASE
        path = [(0.0, BASE), (2.0, (x + 0.4, y, yaw))]
        answer = self.plan(1.0, base_path=path)
        np.testing.assert_allclose(answer.T_map_base[:3, 3], (x + 0.2, y, 0.0), atol=1e-12)
        with self.assertRaisesRegex(ValueError, r"base_path\[1\].time_s is 0 s, times must rise"):
            self.plan(1.0, base_path=[path[0], path[0]])

    def test_answer_explains_itself(self):
        answer = self.plan(0.5)
        self.assertEqual(answer.status, "optimal_within_tolerance")
        (pose,) = nbvopt.sensor_poses(self.robot, BASE, [answer.joints])
        np.testing.assert_array_equal(answer.T_map_sensor, pose)
        self.assertEqual(answer.gain, gains_of(nbvopt.Planner(self.office))([pose])[0])
        np.testing.assert_allclose(answer.T_map_base[:3, 3], (1.9, 2.6, 0.0))
        low, high = answer.box
        self.assertTrue((low <= answer.joints).all() and (answer.joints <= high).all())
        self.assertGreater(answer.search_time_ms, 0.0)
        self.assertIn("optimal_within_tolerance", repr(answer))

    def test_trace_lists_every_evaluation(self):
        self.assertEqual(self.plan().trace["joints"].shape, (0, 3))
        answer = self.plan(trace=True)
        trace = answer.trace
        is_exact = trace["kind"] == "exact"
        self.assertEqual(is_exact.sum(), answer.evaluations)
        self.assertEqual((trace["kind"] == "surrogate").sum(), answer.surrogate_evaluations)
        self.assertEqual({len(column) for column in trace.values()}, {len(is_exact)})
        self.assertEqual(trace["best_gain"][-1], answer.gain)
        best = np.argmax(np.where(is_exact, trace["gain"], -1.0))
        self.assertEqual(trace["joints"][best].tolist(), answer.joints.tolist())
        self.assertTrue((np.diff(trace["time_ms"]) >= 0.0).all())

    def test_certifies(self):
        self.assertIsNone(self.plan().upper_bound)
        answer = self.plan(certify=0.3)
        self.assertEqual(answer.status, "certified")
        self.assertGreaterEqual(answer.upper_bound, answer.gain)
        self.assertLessEqual(answer.gap, 0.3)

    def test_limits_end_the_search(self):
        cut = self.plan(max_evaluations=5)
        self.assertEqual(cut.status, "evaluation_limit")
        self.assertEqual(cut.evaluations + cut.surrogate_evaluations, 5)
        self.assertEqual(self.plan(time_limit_ms=1e-6).status, "time_limit")

    def test_refuses_what_it_cannot_do(self):
        for message, options in (
            ("seed is -1, .*", {"seed": -1}),
            ("max_evaluations is 0, .*", {"max_evaluations": 0}),
            ("time_limit_ms is 0, .*", {"time_limit_ms": 0.0}),
            ("motion_time_s is -1 s, .*", {"motion_time_s": -1.0}),
            ("motion_time_s is nan s, .*", {"motion_time_s": float("nan")}),
            ("step_pan_rad is -0.1, .*", {"solver": "grid", "step_pan_rad": -0.1}),
            (r"base_twist has the shape \(2,\), .*", {"base_twist": (0.0, 1.0)}),
            (".*brute.*", {"solver": "brute"}),
            (".*either", {"solver": "auto", "polish_solver": "none"}),
            ("evaluator 'exakt' is not known, .*", {"evaluator": "exakt"}),
        ):
            with self.subTest(message):
                self.assert_refused(message, self.plan, **options)
        plan = nbvopt.Planner(self.office).plan
        self.assert_refused(r"base has the shape \(\), .*", plan, 1.9, JOINTS, 1.0)
        self.assert_refused("tilt is 1.5 rad, .*", plan, BASE, (0, 1.5, 0.4), 1.0)

    def test_query_is_a_plan_of_a_planner_that_is_not_kept(self):
        options = {"evaluator": "paper-code", "solver": "grid", "step_tilt_rad": 0.3}
        answer = nbvopt.query(self.office, self.robot, BASE, JOINTS, 1.0, **options)
        expected = self.plan(**options)
        self.assertEqual((answer.gain, answer.solver), (expected.gain, "grid"))
        self.assertEqual(answer.joints.tolist(), expected.joints.tolist())


class ExplanationTest(BindingsTest):
    """The landscape and the picture, as `nbvopt query` makes them."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.planner = nbvopt.Planner(cls.office)
        cls.look = cls.planner.plan(BASE, JOINTS, 1.0, trace=True)
        files = ["--plot", cls.folder / "theirs.png", "--landscape", cls.folder / "theirs.json"]
        cli_query("--motion-time", "1", *files)

    def test_landscape_is_that_of_the_command_line(self):
        theirs = json.loads((self.folder / "theirs.json").read_text())
        landscape = self.planner.landscape(self.look)
        self.assertEqual(landscape.height_m, theirs["height"])
        self.assertEqual(landscape.pan_rad.tolist(), theirs["pan"])
        self.assertEqual(landscape.tilt_rad.tolist(), theirs["tilt"])
        self.assertEqual(landscape.gain.tolist(), theirs["gain"])

    def test_picture_is_that_of_the_command_line(self):
        """But for the line that says how long the search took."""
        theirs = image_rows((self.folder / "theirs.png").read_bytes())
        ours = image_rows(self.planner.plot(self.look))
        self.assertEqual(len(ours), len(theirs))
        line_with_time = range(2 * 50, 2 * 70)
        different = [i for i in range(len(ours)) if ours[i] != theirs[i]]
        self.assertEqual([i for i in different if i not in line_with_time], [])

    def test_picture_goes_to_a_file(self):
        file = self.folder / "ours.png"
        self.assertIsNone(self.planner.plot(self.look, file))
        self.assertEqual(file.read_bytes(), self.planner.plot(self.look))

    def test_picture_leaves_out_what_it_does_not_know(self):
        full = image_rows(self.planner.plot(self.look))
        bare = self.planner.plan(BASE, JOINTS, 1.0)
        for name, png in (
            ("the search's way", self.planner.plot(bare)),
            ("the paper's pans", self.planner.plot(self.look, step_pan_rad=0.0)),
        ):
            with self.subTest(name):
                rows = image_rows(png)
                self.assertEqual(len(rows), len(full))
                self.assertGreater(sum(a != b for a, b in zip(rows[200:], full[200:])), 10)

    def test_refuses_what_it_cannot_do(self):
        plot = self.planner.plot
        self.assert_refused("/no/such/p.png: .*", plot, self.look, "/no/such/p.png")
        self.assert_refused("step_pan_rad is -1, .*", plot, self.look, step_pan_rad=-1)


class LifetimeTest(BindingsTest):
    def test_what_is_made_of_a_map_keeps_it(self):
        """ctest sets MALLOC_PERTURB_: memory that is given back holds nothing usable."""
        for name, make, views in (
            ("exact", lambda map: gains_of(nbvopt.Planner(map)), self.poses),
            ("paper-code", lambda map: gains_of(nbvopt.Planner(map, evaluator="paper-code")), self.poses),
            (
                "surrogate",
                lambda map: nbvopt.Surrogate(map, self.robot, BASE, JOINTS, 1.0).gains,
                [JOINTS, (2.0, 0.3, 0.3)],
            ),
        ):
            with self.subTest(name):
                expected = make(self.office)(views).tolist()
                office = nbvopt.Map(OFFICE)
                gains = make(office)
                del office
                gc.collect()
                self.assertEqual(gains(views).tolist(), expected)

    def test_arrays_outlive_what_they_came_from(self):
        states = nbvopt.Map(OFFICE).slice(0.4).states
        gc.collect()
        self.assertEqual(states.tolist(), self.office.slice(0.4).states.tolist())

    def test_the_protocol_lives_beside_it(self):
        from nbvopt.v1 import planner_pb2

        self.assertEqual(planner_pb2.PlanRequest().seed, 0)
        self.assertRegex(nbvopt.__version__, r"^\d+\.\d+\.\d+$")
        self.assertTrue(all(hasattr(nbvopt, name) for name in nbvopt.__all__))
        with self.assertRaises(AttributeError):
            nbvopt.no_such_thing


class ThreadTest(BindingsTest):
    def test_other_threads_run_while_views_are_evaluated(self):
        """A worker with the interpreter's lock would let this thread turn once or twice."""
        poses = np.tile(self.poses, (500, 1, 1))
        planner = nbvopt.Planner(self.office, evaluator="paper-code")
        worker = threading.Thread(target=planner.evaluate, args=(poses,))
        turns = 0
        worker.start()
        while worker.is_alive():
            time.sleep(0.001)  # hands the lock over
            turns += 1
        self.assertGreater(turns, 10)

    def test_threads_share_a_fresh_map(self):
        """All begin on an empty grid, so that they fill it together."""
        poses = np.tile(self.poses, (50, 1, 1))
        expected = gains_of(nbvopt.Planner(self.office))(poses).tolist()
        office = nbvopt.Map(OFFICE)
        answers = {}

        def evaluate(name):
            answers[name] = gains_of(nbvopt.Planner(office))(poses).tolist()

        def ask(name):
            answer = nbvopt.query(office, self.robot, BASE, JOINTS, 1.0)
            answers[name] = (answer.joints.tolist(), answer.gain)

        threads = [threading.Thread(target=evaluate, args=(f"views {i}",)) for i in range(2)]
        threads += [threading.Thread(target=ask, args=(f"query {i}",)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        alone = nbvopt.query(self.office, self.robot, BASE, JOINTS, 1.0)
        for i in range(2):
            self.assertEqual(answers[f"views {i}"], expected)
            self.assertEqual(answers[f"query {i}"], (alone.joints.tolist(), alone.gain))


if __name__ == "__main__":
    unittest.main()
