"""Studies and reproductions on a Dask cluster: its workers need Python and the program nbvopt, and
no files.

    python3 -m nbvopt_dask study SPEC --out DIR --scheduler tcp://HOST:8786
    python3 -m nbvopt_dask reproduce --worlds WORLDS --out DIR --scheduler tcp://HOST:8786

or, with a client that you have (of Slurm, Kubernetes, SSH ...),

    from nbvopt_dask import run_reproduction, run_study
    run_study(client, "spec.yaml", "out/study")

The records are those of `nbvopt study run` and `nbvopt reproduce`, to the digit (times aside); what
has a record is not run again. Maps and worlds travel to each worker once, by their content.
"""

import argparse
import atexit
import concurrent.futures
import copy
import hashlib
import json
import os
import pathlib
import queue
import subprocess
import tempfile
import threading

from distributed import Client, KilledWorker, as_completed, get_worker

# So often a task is submitted anew that Dask has given up since it lost that task's workers. It
# may have been at another one: Dask counts all that was assigned to a worker.
MOST_SUBMISSIONS = 10


class NbvoptError(RuntimeError):
    """What nbvopt refused, in its own words."""


def run_study(client, spec, out, *, references=False, retry_failed=False, nbvopt="nbvopt",
              worker_nbvopt="nbvopt", units_a_task=8, on_record=None):
    """Runs what is left of a study on a cluster; the number of units that were recorded.

    client: a distributed.Client. spec, out: as of `nbvopt study run`, here. nbvopt: the program
    here; worker_nbvopt: the one on the workers. units_a_task: so many units make a task, more where
    they take milliseconds. on_record(count): told how many units have their record in the file.

    A unit that takes longer than its study allows fails, a worker of nbvopt that ends costs its
    unit, one of Dask that is lost costs nothing: Dask runs its tasks elsewhere. Raises NbvoptError.
    """
    arguments = [str(spec), "--out", str(out), *(["--references"] if references else [])]
    lines = _lines_of([nbvopt, "study", "units", *arguments,
                       *(["--retry-failed"] if retry_failed else [])])
    return _Run(client, [worker_nbvopt, "study", "worker"], units_a_task).run(
        lines, [nbvopt, "study", "record", *arguments], on_record)


def run_reproduction(client, worlds, out, *, options=(), nbvopt="nbvopt", worker_nbvopt="nbvopt",
                     on_record=None):
    """Runs what is left of the paper's experiment on a cluster, as run_study() does of a study.

    worlds, out, options: as of `nbvopt reproduce`, here, the options as a list of words such as
    ["--environments", "cafe"]. The same command with `--tables-only` then writes the tables.
    """
    arguments = ["--worlds", str(worlds), "--out", str(out), *map(str, options)]
    lines = _lines_of([nbvopt, "reproduce", "units", *arguments])
    return _Run(client, [worker_nbvopt, "reproduce", "worker"], 1).run(
        lines, [nbvopt, "reproduce", "record", *arguments], on_record)


def _give_module(client):
    """Workers, those to come as well, need not have this module. One that is lost meanwhile breaks
    the call for all: it is made again, to those that are left."""
    for is_last in (False, False, True):
        try:
            return client.upload_file(__file__)
        except OSError:
            if is_last:
                raise


class _Run:
    """Units on their way to workers of Dask and back."""

    def __init__(self, client, worker_command, units_a_task):
        self.client = client
        self.worker_command = worker_command
        self.units_a_task = units_a_task
        self.contents = {}  # of files that units read, on the cluster, by their name here
        self.waiting = {}  # units, by the id of the one that they wait for
        self.tasks = as_completed()
        self.batches = {}  # of tasks, and how often they were submitted
        _give_module(client)

    def run(self, lines, record_command, on_record):
        """How many were recorded."""
        units = [json.loads(line) for line in lines]
        for unit in units:
            if "after" in unit["engine"]:
                self.waiting.setdefault(unit["engine"]["after"], []).append(unit)
        with subprocess.Popen(record_command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as recorder:
            self.submit([unit for unit in units if "after" not in unit["engine"]])
            count = 0
            try:
                for task in self.tasks:
                    for answer, written in self.answers_of(task):
                        self.keep(answer, written, recorder)
                        count += 1
                        if on_record:
                            on_record(count)
                recorder.stdin.close()
            except BrokenPipeError:
                pass  # the recorder says why
            finally:
                self.client.cancel(list(self.batches))
            errors = recorder.stderr.read()
        if recorder.returncode != 0:
            raise NbvoptError(errors.strip())
        return count

    def submit(self, units):
        for first in range(0, len(units), self.units_a_task):
            self.submit_batch(units[first : first + self.units_a_task], 1)

    def submit_batch(self, batch, submission):
        files = sorted({_at(unit, place) for unit in batch for place in unit["engine"]["reads"]})
        contents = {file: self.content(file) for file in files}
        task = self.client.submit(_answer, batch, contents, self.worker_command, pure=False)
        self.batches[task] = batch, submission
        self.tasks.add(task)

    def content(self, file):
        if file not in self.contents:
            # A task, so that a lost worker's copy is made again; one of scattered data is not.
            self.contents[file] = self.client.submit(bytes, pathlib.Path(file).read_bytes(),
                                                     pure=False)
        return self.contents[file]

    def answers_of(self, task):
        """Of each unit its answer's line and what it has written; none where it runs again."""
        batch, submission = self.batches.pop(task)
        try:
            return task.result()
        except KilledWorker:
            if submission == MOST_SUBMISSIONS:
                raise
            self.submit_batch(batch, submission + 1)
            return []
        except concurrent.futures.CancelledError:
            raise NbvoptError("the scheduler is gone; what was recorded stays, and the same call "
                              "goes on from there") from None
        finally:
            task.release()

    def keep(self, answer, written, recorder):
        """The answer is in its file when this returns."""
        for file, content in written.items():
            _write_atomically(pathlib.Path(file), content)
        recorder.stdin.write(answer + "\n")
        recorder.stdin.flush()
        if not recorder.stdout.readline():
            raise BrokenPipeError
        answered = json.loads(answer)
        successors = self.waiting.pop(answered["unit"], [])
        if "failure" not in answered:
            self.submit(successors)


def _at(unit, place):
    """What a JSON pointer points to."""
    for key in place.split("/")[1:]:
        unit = unit[key]
    return unit


def _put(unit, place, value):
    parent, key = place.rsplit("/", 1)
    _at(unit, parent)[key] = value


def _write_atomically(path, content):
    unfinished = path.with_name(f"{path.name}.{os.getpid()}.{threading.get_ident()}")
    unfinished.write_bytes(content)
    unfinished.rename(path)


def _lines_of(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise NbvoptError(done.stderr.strip())
    return done.stdout.splitlines()


class _Solver:
    """A worker of nbvopt, with the files that units name."""

    def __init__(self, command):
        self.command = command
        self.folder = tempfile.TemporaryDirectory(prefix="nbvopt_dask.")
        self.process = None
        self.lines = queue.SimpleQueue()
        atexit.register(self.stop)

    def place(self, content, suffix):
        """A file here with this content, of whatever name."""
        path = pathlib.Path(self.folder.name, hashlib.sha256(content).hexdigest() + suffix)
        if not path.exists():
            _write_atomically(path, content)
        return str(path)

    def start(self):
        self.process = subprocess.Popen(self.command, text=True, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE)
        self.lines = queue.SimpleQueue()
        threading.Thread(target=self.listen, args=(self.process, self.lines), daemon=True).start()
        self.lines.get()  # its first line, or that there is none

    @staticmethod
    def listen(process, lines):
        for line in process.stdout:
            lines.put(line.rstrip("\n"))
        lines.put(None)

    def stop(self):
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process = None

    def run(self, unit, contents):
        """The answer's line, that of a failure where there is none, and the files' contents that
        the unit has written, by their names where it comes from."""
        engine = unit.pop("engine")
        for place in engine["reads"]:
            file = _at(unit, place)
            _put(unit, place, self.place(contents[file], pathlib.Path(file).suffix))
        written = {}
        for place in engine["writes"]:
            file = pathlib.Path(_at(unit, place))
            written[str(file)] = pathlib.Path(self.folder.name, file.name)
            _put(unit, place, str(written[str(file)]))
        answer = self.ask(unit, engine["timeout_s"])
        if "failure" in json.loads(answer):
            return answer, {}
        return answer, {file: here.read_bytes() for file, here in written.items()}

    def ask(self, unit, timeout_s):
        """The answer's line; that of a failure where there is none."""
        for _ in range(2):
            if self.process is None:
                self.start()
            try:
                self.process.stdin.write(json.dumps(unit) + "\n")
                self.process.stdin.flush()
                answer = self.lines.get(timeout=timeout_s)
            except queue.Empty:
                self.stop()
                return _failure(unit, f"stopped by the watchdog after {timeout_s:g} s", timeout_s)
            except BrokenPipeError:
                answer = None
            if answer is not None:
                return answer
            self.stop()
        return _failure(unit, "its worker ended, twice", 0)


def _failure(unit, why, seconds):
    return json.dumps({"unit": unit["unit"], "failure": why, "busy_ms": 1e3 * seconds})


def _answer(batch, contents, command):
    """Of each unit what _Solver.run() gives, on a worker of Dask; one solver a thread."""
    worker = get_worker()
    solvers = worker.__dict__.setdefault("nbvopt_solvers", {})
    key = threading.get_ident(), *command
    if key not in solvers:
        solvers[key] = _Solver(command)
    return [solvers[key].run(copy.deepcopy(unit), contents) for unit in batch]


def main():
    of_both = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    of_both.add_argument("--out", required=True, metavar="DIR")
    of_both.add_argument("--scheduler", required=True, metavar="ADDRESS")
    of_both.add_argument("--nbvopt", default="nbvopt", help="the program, here and on the workers")
    parser = argparse.ArgumentParser(prog="nbvopt_dask", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    study = commands.add_parser("study", parents=[of_both], allow_abbrev=False)
    study.add_argument("spec", metavar="SPEC")
    study.add_argument("--references", action="store_true", help="of study reference")
    study.add_argument("--retry-failed", action="store_true")
    reproduce = commands.add_parser("reproduce", parents=[of_both], allow_abbrev=False,
                                    epilog="Other options are those of nbvopt reproduce.")
    reproduce.add_argument("--worlds", required=True, metavar="DIR")
    arguments, options = parser.parse_known_args()
    programs = {"nbvopt": arguments.nbvopt, "worker_nbvopt": arguments.nbvopt}
    if options and arguments.command == "study":
        parser.error(f"unknown: {' '.join(options)}")
    try:
        with Client(arguments.scheduler) as client:
            if arguments.command == "study":
                count = run_study(client, arguments.spec, arguments.out,
                                  references=arguments.references,
                                  retry_failed=arguments.retry_failed, **programs)
            else:
                count = run_reproduction(client, arguments.worlds, arguments.out, options=options,
                                         **programs)
    except (NbvoptError, OSError) as error:
        parser.exit(3, f"{error}\n")
    print(f"{count} units recorded")


if __name__ == "__main__":
    main()
