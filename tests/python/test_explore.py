"""Runs the example explore.py for a few looks.

    PYTHONPATH=BUILD/python python3 test_explore.py
"""

import contextlib
import io
import unittest

import nbvopt
from support import DATASETS


@unittest.skipUnless(hasattr(nbvopt, "simulate"), "built without the simulator")
class ExploreTest(unittest.TestCase):
    def test_maps_as_an_episode_does(self):
        import explore

        world = nbvopt.World(DATASETS / "office.world", cache=False)
        told = io.StringIO()
        with contextlib.redirect_stdout(told):
            information = explore.look_around(world, steps=5)
        lines = told.getvalue().splitlines()
        self.assertEqual(len(lines), 5)
        self.assertRegex(lines[0], r"^step 1: gained \d+\.\d, next look at pan -?\d\.\d\d rad, .* m$")
        episode = nbvopt.simulate(
            world, start=explore.START, duration_max_s=5, motion_time_s=explore.STEP_S
        )
        # An episode looks once more when the drive ends.
        expected = episode.captures["information"][4]
        self.assertAlmostEqual(information, expected, delta=0.01 * expected)


if __name__ == "__main__":
    unittest.main()
