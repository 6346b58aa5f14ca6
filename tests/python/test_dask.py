"""Studies and reproductions on a Dask cluster of this machine, against one machine's."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import unittest.mock

try:
    from distributed import Client, LocalCluster
except ImportError:
    print("OK (skipped=1): python3-distributed is not installed")
    sys.exit(0)

from nbvopt_dask import NbvoptError, _give_module, run_reproduction, run_study

NBVOPT = os.environ["NBVOPT_CLI"]
OFFICE = pathlib.Path(__file__).resolve().parents[2] / "datasets" / "office_partial.ot"

SPEC = f"""
maps: [{OFFICE}]
starts: {{sampled: {{count: 3, seed: 7}}}}
motion_times_s: [0.5]
solvers: [{{solver: random}}]
budgets: {{max_evaluations: [20, 60]}}
seeds: %s
"""


# A room of 4 x 3 m, with somebody in it.
BOX = ("<model name='{0}'><static>true</static><pose>{1} 0 0 0</pose><link name='l'><visual "
       "name='v'><geometry><box><size>{2}</size></box></geometry></visual></link></model>")
WORLD = "<?xml version='1.0'?><sdf version='1.6'><world name='room'>" + "".join(
    BOX.format(*box) for box in [
        ("floor", "0 0 -0.05", "4 3 0.1"), ("south", "0 -1.5 0.5", "4 0.1 1"),
        ("north", "0 1.5 0.5", "4 0.1 1"), ("west", "-2 0 0.5", "0.1 3 1"),
        ("east", "2 0 0.5", "0.1 3 1")]) + (
    "<actor name='walker'><script><trajectory id='0' type='walk'>"
    "<waypoint><time>0</time><pose>1 1 0 0 0 0</pose></waypoint>"
    "<waypoint><time>2</time><pose>1 -1 0 0 0 0</pose></waypoint>"
    "</trajectory></script></actor></world></sdf>")
EXPERIMENT = ["--environments", "apartment", "--starts", "1", "--duration-max", "2",
              "--motion-time", "0.5"]


def records(folder):
    """By their unit, without times; each once."""
    found = {}
    for line in (pathlib.Path(folder) / "records.jsonl").read_text().splitlines():
        record = json.loads(line)
        record.pop("times", None)
        record.pop("times_ms", None)
        assert record["unit"] not in found, "recorded twice"
        found[record["unit"]] = record
    return found


class DaskTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cluster = LocalCluster(n_workers=2, threads_per_worker=1, processes=True,
                                   dashboard_address=None, silence_logs=50)
        cls.client = Client(cls.cluster)
        cls.files = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.files.name)

    @classmethod
    def tearDownClass(cls):
        cls.client.close()
        cls.cluster.close()
        cls.files.cleanup()

    def spec(self, seeds):
        file = self.folder / "spec.yaml"
        file.write_text(SPEC % seeds)
        return file

    def run_on_dask(self, spec, out, **options):
        return run_study(self.client, spec, self.folder / out, nbvopt=NBVOPT,
                         worker_nbvopt=NBVOPT, **options)

    def run_here(self, spec, out):
        subprocess.run([NBVOPT, "study", "run", spec, "--out", self.folder / out], check=True,
                       capture_output=True)
        return records(self.folder / out)

    def test_records_are_those_of_one_machine(self):
        spec = self.spec([1, 2])
        told = []
        count = self.run_on_dask(spec, "dask", on_record=told.append)
        here = self.run_here(spec, "here")
        self.assertEqual(count, len(here))
        self.assertEqual(told[-1], count)
        self.assertEqual(records(self.folder / "dask"), here)
        self.assertEqual(self.run_on_dask(spec, "dask"), 0, "all has been done")

    def test_a_lost_worker_costs_nothing(self):
        spec = self.spec([1, 2, 3])
        here = self.run_here(spec, "here_lost")
        killer = threading.Timer(0.2, self.kill_a_worker)
        killer.start()
        self.run_on_dask(spec, "lost", units_a_task=2)
        killer.join()
        self.assertEqual(records(self.folder / "lost"), here)

    def test_gives_its_module_again_when_a_worker_is_lost_meanwhile(self):
        client = unittest.mock.Mock()
        client.upload_file.side_effect = [OSError("reset by peer"), None]
        _give_module(client)
        self.assertEqual(client.upload_file.call_count, 2)
        client.upload_file.side_effect = OSError("reset by peer")
        with self.assertRaises(OSError):
            _give_module(client)

    def kill_a_worker(self):
        worker = next(iter(self.cluster.workers.values()))
        os.kill(worker.process.process.pid, signal.SIGKILL)

    def test_reproduces_without_the_worlds_files(self):
        world = self.folder / "worlds" / "apartment" / "worlds" / "small_house.world"
        world.parent.mkdir(parents=True)
        world.write_text(WORLD)
        command = [NBVOPT, "reproduce", "--worlds", self.folder / "worlds", *EXPERIMENT, "--out"]
        subprocess.run([*command, self.folder / "one"], check=True, capture_output=True)
        one = records(self.folder / "one")
        count = run_reproduction(self.client, self.folder / "worlds", self.folder / "many",
                                 options=EXPERIMENT, nbvopt=NBVOPT, worker_nbvopt=NBVOPT)
        self.assertEqual(count, len(one))
        self.assertEqual(records(self.folder / "many"), one)
        for file in (self.folder / "one" / "units").iterdir():
            twin = self.folder / "many" / "units" / file.name
            self.assertEqual(twin.read_bytes(), file.read_bytes(), file.name)
        subprocess.run([*command, self.folder / "many", "--tables-only"], check=True,
                       capture_output=True)
        self.assertEqual((self.folder / "many" / "table.json").read_bytes(),
                         (self.folder / "one" / "table.json").read_bytes())

    def test_refusals_are_nbvopts(self):
        with self.assertRaisesRegex(NbvoptError, "nowhere.yaml: cannot be opened"):
            self.run_on_dask("nowhere.yaml", "none")

    def test_a_unit_that_takes_too_long_fails(self):
        spec = self.folder / "slow.yaml"
        forever = SPEC.replace("[20, 60]", "[100000000]")
        spec.write_text(forever % [1] + "unit_timeout_s: 0.1\n")
        self.run_on_dask(spec, "slow")
        searches = [r for r in records(self.folder / "slow").values() if r["search"] == "random"]
        self.assertEqual(len(searches), 3)
        for record in searches:
            self.assertIn("watchdog", record["failure"])


if __name__ == "__main__":
    unittest.main()
