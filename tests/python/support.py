"""What the tests of the module nbvopt share: the shipped map, and the command line beside it."""

import json
import os
import pathlib
import subprocess
import unittest

import nbvopt

DATASETS = pathlib.Path(__file__).resolve().parents[2] / "datasets"
OFFICE = str(DATASETS / "office_partial.ot")
BASE = (1.9, 2.6, 1.57)
JOINTS = (0.0, 0.0, 0.4)


def run_cli(*arguments, text: str = "") -> str:
    """What the command line prints."""
    command = [os.environ["NBVOPT_CLI"], *map(str, arguments)]
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout


def cli_json(*arguments, text: str = "") -> dict:
    return json.loads(run_cli(*arguments, text=text))


def gains_of(planner: nbvopt.Planner):
    """The gains of poses, as a function of them."""
    return lambda poses: planner.evaluate(poses)["gain"]


class ModuleTest(unittest.TestCase):
    def assert_refused(self, message: str, call, *arguments, **named):
        """The whole message, one line; a regular expression."""
        with self.assertRaises(ValueError) as caught:
            call(*arguments, **named)
        self.assertRegex(str(caught.exception), f"^{message}$")
