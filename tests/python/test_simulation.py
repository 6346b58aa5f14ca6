"""Tests the simulator's part of the module nbvopt against the command line.

    NBVOPT_CLI=PATH/TO/nbvopt PYTHONPATH=BUILD/python python3 test_simulation.py
"""

import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np

import nbvopt
from support import DATASETS, ModuleTest, cli_json

OFFICE = DATASETS / "office.world"
COARSE = "sensor: {horizontal_pixels: 96, vertical_pixels: 72}"
START = (0.617, 0.713, 0.0)  # the corridor's west end
CLOCKED = ("render_ms", "insert_ms", "grid_ms", "plan_ms")


@unittest.skipUnless(hasattr(nbvopt, "simulate"), "built without the simulator")
class SimulationTest(ModuleTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.robot_file = cls.folder / "robot.yaml"
        cls.robot_file.write_text(COARSE)
        cls.robot = nbvopt.Robot(cls.robot_file)
        cls.world = nbvopt.World(OFFICE, cache=False)


class EpisodeTest(SimulationTest):
    def assert_same_episode(self, episode: nbvopt.Episode, options: list):
        metrics, map_file, plot = (self.folder / name for name in ("m.jsonl", "m.ot", "p.png"))
        files = ["--metrics", metrics, "--map-out", map_file, "--plot", plot]
        told = cli_json("simulate", OFFICE, "--json", "--no-progress", "--no-cache",
                        "--robot", self.robot_file, "--gain", "positive", *options, *files)  # fmt: skip
        summary = episode.summary
        self.assertEqual(summary.pop("times_ms").keys(), told.pop("times_ms").keys())
        self.assertEqual(summary, told)
        lines = [json.loads(line) for line in metrics.read_text().splitlines()]
        self.assertGreater(len(lines), 3)
        captures = episode.captures
        self.assertEqual(captures.keys(), lines[0].keys())
        for key, column in captures.items():
            if key not in CLOCKED:
                expected = np.array([line[key] for line in lines], dtype=column.dtype)
                np.testing.assert_array_equal(column, expected, key)
        saved = self.folder / "ours.ot"
        episode.map.save(saved)
        self.assertEqual(saved.read_bytes(), map_file.read_bytes())
        self.assertEqual(episode.plot(), plot.read_bytes())

    def test_is_that_of_the_command_line(self):
        start = ["--start", ",".join(map(str, START))]
        for options, arguments in (
            ([*start, "--duration-max", "4"], {"start": START, "duration_max_s": 4}),
            (
                [*start, "--goal", "1.3,0.8", "--goal", "1.1,0.7", "--mode", "random",
                 "--motion-time", "0.8", "--seed", "5", "--range-noise", "0.01",
                 "--resolution", "0.05", "--capture-hz", "3", "--lidar-range", "3",
                 "--pan", "0.3", "--tilt", "-0.1", "--height", "0.5",
                 "--pose-source", "slam", "--odometry-noise", "0.5"],
                {"start": START, "goals": [(1.3, 0.8), (1.1, 0.7)], "mode": "random",
                 "motion_time_s": 0.8, "seed": 5, "range_noise_m": 0.01,
                 "resolution_m": 0.05, "capture_hz": 3, "lidar_range_m": 3,
                 "joints": (0.3, -0.1, 0.5), "pose_source": "slam", "odometry_noise": 0.5},
            ),
        ):  # fmt: skip
            with self.subTest(options):
                episode = nbvopt.simulate(self.world, robot=self.robot, **arguments)
                self.assert_same_episode(episode, options)

    def test_replays_a_drive(self):
        drive = nbvopt.explore(self.world, START, duration_max_s=2)
        file = self.folder / "drive.csv"
        drive.save(file)
        options = {"mode": "grid", "robot": self.robot}
        for trajectory in (drive, nbvopt.Drive(file), file, str(file)):
            episode = nbvopt.simulate(OFFICE, trajectory=trajectory, **options)
            self.assertIsNone(episode.drive.status)
            self.assert_same_episode(episode, ["--trajectory", file, "--mode", "grid"])

    def test_its_map_is_one_to_plan_on(self):
        episode = nbvopt.simulate(
            self.world, start=START, duration_max_s=1, mode="static", robot=self.robot
        )
        before = episode.map.counts().certain_voxels
        self.assertEqual(before, episode.summary["voxels"])
        self.assertEqual(before, episode.captures["voxels"][-1])
        planner = nbvopt.Planner(episode.map, self.robot)
        look = planner.plan(START, (0.0, 0.0, 0.4), 1.0)
        points, no_returns = self.world.capture(self.robot, look.T_map_sensor)
        planner.insert(points, look.T_map_sensor, no_returns=no_returns)
        self.assertGreater(episode.map.counts().certain_voxels, before)

    def test_picture_goes_to_a_file(self):
        episode = nbvopt.simulate(
            self.world, start=START, duration_max_s=1, mode="static", robot=self.robot
        )
        self.assertIsNone(episode.plot(self.folder / "plot.png"))
        self.assertEqual((self.folder / "plot.png").read_bytes(), episode.plot())
        self.assert_refused("/no/p.png: .*", episode.plot, "/no/p.png")

    def test_refuses_what_it_cannot_do(self):
        for message, options in (
            ("give a start .*", {}),
            ("trajectory holds the whole drive.*", {"start": START, "trajectory": "d.csv"}),
            ("/no/drive.csv: .*", {"trajectory": "/no/drive.csv"}),
            ("there is no camera mode 'clever'.*", {"start": START, "mode": "clever"}),
            (".*motion time.*", {"start": START, "motion_time_s": 0}),
            (".*resolution.*", {"start": START, "resolution_m": -1}),
            ("height is 3 m.*", {"start": START, "joints": (0, 0, 3)}),
            ("seed is -1, .*", {"start": START, "seed": -1}),
            ("there is no pose source 'gps'.*", {"start": START, "pose_source": "gps"}),
        ):
            with self.subTest(message):
                self.assert_refused(message, nbvopt.simulate, self.world, **options)
        self.assert_refused("/no/w.world: .*", nbvopt.simulate, "/no/w.world", start=START)

    def test_ctrl_c_ends_it(self):
        timer = threading.Timer(1.0, signal.raise_signal, (signal.SIGINT,))
        timer.start()
        self.addCleanup(timer.cancel)
        with self.assertRaises(KeyboardInterrupt):
            nbvopt.simulate(self.world, start=START, mode="static")

    def test_ctrl_c_hands_out_the_map(self):
        drive = nbvopt.explore(self.world, START, duration_max_s=60)
        timer = threading.Timer(0.5, signal.raise_signal, (signal.SIGINT,))
        timer.start()
        self.addCleanup(timer.cancel)
        with self.assertRaises(KeyboardInterrupt) as stopped:
            nbvopt.simulate(self.world, trajectory=drive, mode="static", capture_hz=100)
        self.assertGreater(stopped.exception.map.counts().occupied_voxels, 0)


class ExploreTest(SimulationTest):
    def test_is_that_of_the_command_line(self):
        file = self.folder / "theirs.csv"
        told = cli_json("simulate", OFFICE, "--json", "--no-progress", "--no-cache",
                        "--explore-only", "--start", "0.617,0.713,0", "--duration-max", "4",
                        "--seed", "3", "--trajectory-out", file)  # fmt: skip
        drive = nbvopt.explore(self.world, START, duration_max_s=4, seed=3)
        self.assertEqual(drive.status, told["status"])
        self.assertEqual((drive.duration_s, drive.length_m), (told["duration_s"], told["length_m"]))
        np.testing.assert_array_equal(drive.trajectory, np.loadtxt(file, delimiter=",", skiprows=1))
        drive.save(self.folder / "ours.csv")
        self.assertEqual((self.folder / "ours.csv").read_bytes(), file.read_bytes())
        self.assertIsNone(nbvopt.Drive(file).status)

    def test_refuses_what_it_cannot_do(self):
        explore = nbvopt.explore
        self.assert_refused("start has 2 numbers, .*", explore, self.world, (0, 0))
        self.assert_refused("start: there is no floor .*", explore, self.world, (50, 50, 0))
        self.assert_refused(r"goals has the shape \(2,\), .*", explore, self.world, START, goals=(1, 2))
        self.assert_refused(".*goal.*", explore, self.world, START, goals=[(4.75, 3)])


class WorldTest(SimulationTest):
    def test_captures_what_stands_there(self):
        """The floor, seen from half a metre above it at an angle."""
        (pose,) = nbvopt.sensor_poses(self.robot, START, [(0.0, -0.5, 0.5)])
        points, no_returns = self.world.capture(self.robot, pose)
        self.assertEqual(points.dtype, np.float32)
        self.assertLessEqual(len(points) + len(no_returns), 96 * 72)
        heights = points @ pose[2, :3] + pose[2, 3]
        is_floor = np.abs(heights) < 0.01
        self.assertGreater(is_floor.mean(), 0.5)
        self.assertGreater(heights.min(), -0.01)

    def test_noise_is_the_seeds_and_the_frames(self):
        (pose,) = nbvopt.sensor_poses(self.robot, START, [(0.0, -0.5, 0.5)])

        def ranges(**options):
            return np.linalg.norm(self.world.capture(self.robot, pose, **options)[0], axis=1)

        self.assertEqual(len(ranges()), len(ranges(range_noise_m=0.01)))
        noise = ranges(range_noise_m=0.01) - ranges()
        self.assertAlmostEqual(noise.std(), 0.01, delta=0.002)
        for other in ({"seed": 2}, {"frame": 1}):
            self.assertFalse(np.array_equal(noise, ranges(range_noise_m=0.01, **other) - ranges()))

    def test_knows_its_bounds(self):
        low, high = self.world.bounds_m
        self.assertTrue((high - low > 1.0).all())

    def test_warns_of_what_is_missing(self):
        file = self.folder / "gone.world"
        file.write_text(
            "<sdf version='1.6'><world name='w'><model name='m'><static>true</static>"
            "<link name='l'><visual name='b'><geometry><box><size>1 1 1</size></box></geometry>"
            "</visual><visual name='v'><geometry><mesh><uri>model://gone/gone.dae</uri></mesh>"
            "</geometry></visual></link></model></world></sdf>"
        )
        with self.assertWarnsRegex(UserWarning, "model://gone/gone.dae"):
            nbvopt.World(file, cache=False)
        self.assert_refused(".*gone.dae.*", nbvopt.World, file, strict=True, cache=False)
        self.assert_refused(".*geometry.*", nbvopt.World, file, geometry="collision", cache=False)
        self.assert_refused("geometry is 'solid', .*", nbvopt.World, file, geometry="solid")

    def test_keeps_a_built_world_where_it_is_told(self):
        kept = self.folder / "kept"
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            nbvopt.World(OFFICE, cache=kept)
        self.assertEqual(len(list(kept.iterdir())), 1)


class ImportTest(ModuleTest):
    def test_a_planner_does_not_load_the_simulator(self):
        code = "import sys, nbvopt; nbvopt.Planner; print('nbvopt._sim' in sys.modules)"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, "False\n")

    def test_a_build_without_the_simulator_says_so(self):
        code = (
            "import importlib.util as u; find = u.find_spec\n"
            "u.find_spec = lambda name, *rest: None if name == 'nbvopt._sim' else find(name, *rest)\n"
            "import nbvopt\n"
            "assert 'simulate' not in nbvopt.__all__\n"
            "nbvopt.simulate"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertIn("'simulate': it was built without the simulator", done.stderr)


if __name__ == "__main__":
    unittest.main()
