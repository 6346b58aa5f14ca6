#!/usr/bin/env python3
"""Kills experiments at random on each engine, lets them go on, and compares what comes of them.

    bench/kill_engines.py NBVOPT [--kills 20] [--seed 1] [--engines processes mpi dask parts]

A study and a reproduction run on each engine. Again and again, after a random while, a random
process of those that take part is killed (SIGKILL), of the kind that was killed least: a
coordinator, a worker, mpirun or one of its ranks, Dask's client, recorder, scheduler, nanny or
worker. What has ended is started again. Merges of parts are killed five times more.

Every record that was in its file before a kill must still be there after it, and in the end the
records, each once and times aside, must be those of a run without kills.

Prints a row an engine and experiment, with who was killed how often; exit code 1 where a record is
lost or differs. An engine whose package is missing is left out, saying so.
"""
import argparse
import collections
import importlib.util
import json
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
OFFICE = ROOT / "datasets" / "office_partial.ot"
PARTS = 3
LONGEST_START_S = 20.0
LONGEST_WAIT_S = 1.0
MERGES = 5  # that are killed when all parts are done
LONGEST_MERGE_S = 0.05

SPEC = f"""maps: [{OFFICE}]
starts: {{sampled: {{count: 6, seed: 7}}}}
motion_times_s: [0.5]
solvers: [{{solver: auto}}, {{solver: random}}]
budgets: {{max_evaluations: [20, 60]}}
seeds: [1, 2, 3, 4, 5, 6, 7, 8]
"""
BOX = ("<model name='{0}'><static>true</static><pose>{1} 0 0 0</pose><link name='l'><visual "
       "name='v'><geometry><box><size>{2}</size></box></geometry></visual></link></model>")
WORLD = "<?xml version='1.0'?><sdf version='1.6'><world name='room'>" + "".join(
    BOX.format(*box) for box in [
        ("floor", "0 0 -0.05", "20 3 0.1"), ("south", "0 -1.5 0.5", "20 0.1 1"),
        ("north", "0 1.5 0.5", "20 0.1 1"), ("west", "-10 0 0.5", "0.1 3 1"),
        ("east", "10 0 0.5", "0.1 3 1")]) + "</world></sdf>"


class Study:
    name = "study"

    def __init__(self, folder):
        self.spec = folder / "spec.yaml"
        self.spec.write_text(SPEC)

    def run(self, out, workers):
        return ["study", "run", self.spec, "--out", out, "--workers", workers, "--retry-failed"]

    def on_dask(self, out):
        return ["study", self.spec, "--out", out, "--retry-failed"]


class Reproduction:
    name = "reproduction"
    options = ["--environments", "apartment", "--starts", "1", "--duration-max", "2"]

    def __init__(self, folder):
        self.worlds = folder / "worlds"
        world = self.worlds / "apartment" / "worlds" / "small_house.world"
        world.parent.mkdir(parents=True)
        world.write_text(WORLD)

    def run(self, out, workers):
        return ["reproduce", "--worlds", self.worlds, "--out", out, *self.options, "--jobs",
                workers]

    def on_dask(self, out):
        return ["reproduce", "--worlds", self.worlds, "--out", out, *self.options]


class Engine:
    """Commands, each with its folder, that make up a run; those that end badly are run again."""

    def __init__(self, nbvopt, experiment, folder):
        self.nbvopt, self.experiment, self.folder = nbvopt, experiment, folder

    def commands(self):
        return {"whole": [self.nbvopt, *self.experiment.run(self.folder / "whole", 2)]}

    def keep_services(self):
        """What commands need that runs beside them."""

    def services(self):
        return []

    def result(self, randomness, killed):
        """The folder that holds all, once the commands are done; counts who was killed besides."""
        return self.folder / "whole"

    def close(self):
        pass


class Processes(Engine):
    pass


class Mpi(Engine):
    def commands(self):
        return {"whole": ["mpirun", "--oversubscribe", "-n", 3, self.nbvopt,
                          *self.experiment.run(self.folder / "whole", 0)]}


class Parts(Engine):
    def commands(self):
        return {f"part{i}": [self.nbvopt, *self.experiment.run(self.folder / f"part{i}", 1),
                             "--shard", f"{i}/{PARTS}"] for i in range(1, PARTS + 1)}

    def result(self, randomness, killed):
        merged = self.folder / "merged"
        shutil.rmtree(merged, ignore_errors=True)
        command = [self.nbvopt, self.experiment.run("", 0)[0], "merge",
                   *(self.folder / part for part in self.commands()), "--out", merged]
        for _ in range(MERGES):
            merge = start(command)
            time.sleep(randomness.uniform(0.0, LONGEST_MERGE_S))
            kill(merge.pid)
            killed["merge"] += merge.wait() == -signal.SIGKILL
        finish(command)
        return merged


class Dask(Engine):
    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.processes = []
        with socket.socket() as any_port:
            any_port.bind(("127.0.0.1", 0))
            self.port = any_port.getsockname()[1]

    def commands(self):
        return {"whole": [sys.executable, "-m", "nbvopt_dask",
                          *self.experiment.on_dask(self.folder / "whole"), "--nbvopt", self.nbvopt,
                          "--scheduler", f"tcp://127.0.0.1:{self.port}"]}

    def services(self):
        return [process.pid for process in self.processes]

    def keep_services(self):
        if self.processes and all(process.poll() is None for process in self.processes):
            return
        self.close()
        python = [sys.executable, "-m"]
        self.processes = [
            start([*python, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port",
                   self.port, "--no-dashboard"]),
            start([*python, "distributed.cli.dask_worker", f"tcp://127.0.0.1:{self.port}",
                   "--nworkers", 2, "--nthreads", 1, "--no-dashboard", "--local-directory",
                   self.folder])]

    def close(self):
        for process in self.processes:
            for pid in tree(process.pid):
                kill(pid)
            process.wait()
        self.processes = []


ENGINES = {"processes": Processes, "mpi": Mpi, "dask": Dask, "parts": Parts}


def start(command):
    return subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)


def finish(command):
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass  # it was faster


def tree(pid):
    """The process and all below it, which any of its threads may have started."""
    try:
        children = [child for thread in pathlib.Path(f"/proc/{pid}/task").iterdir()
                    for child in (thread / "children").read_text().split()]
    except OSError:
        return []  # it has ended meanwhile
    return [pid, *(below for child in children for below in tree(int(child)))]


def role(pid):
    """Who it is; none: somebody who takes no part."""
    try:
        words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
        environment = pathlib.Path(f"/proc/{pid}/environ").read_bytes().decode(errors="replace")
    except OSError:
        return None
    line = " ".join(words)
    if "worker" in words[1:3]:
        return "worker"
    for word, name in [("mpirun", "mpirun"), ("dask_scheduler", "scheduler"),
                       ("dask_worker", "nanny"), ("resource_tracker", None),
                       ("spawn_main", "dask worker"), ("nbvopt_dask", "client"),
                       (" record ", "recorder"), (" units ", "lister")]:
        if word in line:
            return name
    rank = [v for v in environment.split("\0") if v.startswith("OMPI_COMM_WORLD_RANK=")]
    if rank and not rank[0].endswith("=0"):
        return "rank"
    return "coordinator"


def who_is_there(roots):
    """Processes by their role, in the trees of these."""
    found = collections.defaultdict(list)
    for pid in (pid for root in roots for pid in tree(root)):
        name = role(pid)
        if name:
            found[name].append(pid)
    return found


def wait_for_a_moment(roots, randomness):
    """Mostly one at which units are at work, now and then any."""
    if randomness.random() < 0.8:
        end = time.monotonic() + LONGEST_START_S
        while "worker" not in who_is_there(roots) and time.monotonic() < end:
            time.sleep(0.02)
    time.sleep(randomness.uniform(0.0, LONGEST_WAIT_S))


def acknowledged(folder):
    """The whole lines of its records."""
    file = folder / "records.jsonl"
    lines = file.read_bytes().splitlines(keepends=True) if file.exists() else []
    return [line for line in lines if line.endswith(b"\n")]


def answers(folder):
    """The answers by their unit, without times. Fails on one that is there twice, and on failures
    that were not tried again."""
    found = {}
    for line in acknowledged(folder):
        record = json.loads(line)
        for key in ("times", "times_ms"):
            record.pop(key, None)
        if record["unit"] in found and "failure" not in found[record["unit"]]:
            raise AssertionError(f"{record['unit']} is recorded twice")
        found[record["unit"]] = record
    return found


def torment(engine, kills, randomness, whole):
    """Kills so often; who was killed how often. Raises AssertionError."""
    killed = collections.Counter()
    jobs, done = {}, set()
    seen = {}  # records that were in a file before the last kill
    bad_ends = 0
    while True:
        engine.keep_services()
        commands = engine.commands()
        for name, command in commands.items():
            if name not in jobs and name not in done:
                jobs[name] = start(command)
        if killed.total() < kills:
            roots = [*(job.pid for job in jobs.values()), *engine.services()]
            wait_for_a_moment(roots, randomness)
            seen = {name: acknowledged(engine.folder / name) for name in commands}
            victims = who_is_there(roots)
            if victims:
                least = min(killed[kind] for kind in victims)
                kind = randomness.choice([k for k in sorted(victims) if killed[k] == least])
                kill(randomness.choice(sorted(victims[kind])))
                killed[kind] += 1
        time.sleep(0.05)
        for name in list(jobs):
            if jobs[name].poll() is None:
                continue
            bad_ends = bad_ends + 1 if jobs[name].returncode else 0
            if bad_ends > 50 and killed.total() >= kills:
                raise AssertionError(f"{name} ends with {jobs[name].returncode} again and again")
            if jobs[name].returncode == 0:
                done.add(name)
            del jobs[name]
        for name, before in seen.items():
            if acknowledged(engine.folder / name)[: len(before)] != before:
                raise AssertionError(f"{engine.folder / name} has lost records")
        if done == set(commands):
            if answers(engine.result(randomness, killed)) != whole:
                raise AssertionError("the records differ from those of a run without kills")
            if killed.total() >= kills:
                return killed
            # Once more, from the beginning.
            for name in commands:
                shutil.rmtree(engine.folder / name)
            done, seen = set(), {}


def missing(name):
    if name == "mpi" and shutil.which("mpirun") is None:
        return "there is no mpirun"
    if name == "dask" and importlib.util.find_spec("distributed") is None:
        return "python3-distributed is not installed"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nbvopt")
    parser.add_argument("--kills", type=int, default=20, help="of each engine and experiment")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--engines", nargs="+", choices=ENGINES, default=list(ENGINES))
    parser.add_argument("--experiments", nargs="+", choices=["study", "reproduction"],
                        default=["study", "reproduction"])
    arguments = parser.parse_args()
    nbvopt = pathlib.Path(arguments.nbvopt).resolve()
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                      PYTHONPATH=str(ROOT / "src" / "python"), PYTHONDONTWRITEBYTECODE="1")
    print("| experiment | engine | kills | of whom | records |")
    print("| --- | --- | ---: | --- | ---: |")
    failed = False
    with tempfile.TemporaryDirectory(prefix="nbvopt_kills.") as temporary:
        folder = pathlib.Path(temporary)
        for experiment in [Study(folder), Reproduction(folder)]:
            if experiment.name not in arguments.experiments:
                continue
            reference = folder / f"{experiment.name}-whole"
            finish([nbvopt, *experiment.run(reference, 2)])
            whole = answers(reference)
            for name in arguments.engines:
                if missing(name):
                    print(f"{name} is left out: {missing(name)}", file=sys.stderr)
                    continue
                place = folder / f"{experiment.name}-{name}"
                place.mkdir()
                engine = ENGINES[name](nbvopt, experiment, place)
                try:
                    killed = torment(engine, arguments.kills, random.Random(arguments.seed), whole)
                    who = ", ".join(f"{kind} {count}" for kind, count in sorted(killed.items()))
                    print(f"| {experiment.name} | {name} | {killed.total()} | {who} "
                          f"| {len(whole)}, none lost |", flush=True)
                except AssertionError as error:
                    failed = True
                    print(f"| {experiment.name} | {name} | | {error} | |", flush=True)
                finally:
                    engine.close()
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
