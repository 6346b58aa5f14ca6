"""Studies on a Dask cluster: its workers need Python and the program nbvopt, and no files.

    python3 -m nbvopt_dask SPEC --out DIR --scheduler tcp://HOST:8786

or, with a client that you have (of Slurm, Kubernetes, SSH ...),

    from nbvopt_dask import run_study
    run_study(client, "spec.yaml", "out/study")

The records are those of `nbvopt study run`, to the digit (times aside); what has a record is not
run again. Maps travel to each worker once, by their content.
"""

import argparse
import atexit
import hashlib
import json
import os
import pathlib
import queue
import subprocess
import tempfile
import threading

from distributed import Client, as_completed, get_worker


class NbvoptError(RuntimeError):
    """What nbvopt refused, in its own words."""


def run_study(client, spec, out, *, references=False, retry_failed=False, nbvopt="nbvopt",
              worker_nbvopt="nbvopt", units_a_task=8, on_record=None):
    """Runs what is left of a study on a cluster; the number of units that were recorded.

    client: a distributed.Client. spec, out: as of `nbvopt study run`, here. nbvopt: the program
    here; worker_nbvopt: the one on the workers. units_a_task: so many units make a task, more where
    they take milliseconds. on_record(count): told how many units have their record.

    A unit that takes longer than its study allows fails, a worker of nbvopt that ends costs its
    unit, one of Dask that is lost costs nothing: Dask runs its tasks elsewhere. Raises NbvoptError.
    """
    kind = ["--references"] if references else []
    options = kind + (["--retry-failed"] if retry_failed else [])
    units = _lines_of([nbvopt, "study", "units", str(spec), "--out", str(out), *options])
    study = json.loads((pathlib.Path(out) / "study.json").read_text())
    timeout_s = study["reference_timeout_s" if references else "unit_timeout_s"]
    robot = (pathlib.Path(out) / "robot.yaml").read_bytes()

    with subprocess.Popen([nbvopt, "study", "record", str(spec), "--out", str(out), *kind],
                          stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True) as recorder:
        tasks = _tasks(client, units, units_a_task, robot, timeout_s, worker_nbvopt)
        count = _record(tasks, recorder, on_record)
        client.cancel(tasks)
        errors = recorder.stderr.read()
    if recorder.returncode != 0:
        raise NbvoptError(errors.strip())
    return count


def _tasks(client, units, units_a_task, robot, timeout_s, program):
    """Futures of the answers to units, some a task."""
    maps, tasks = {}, []
    for first in range(0, len(units), units_a_task):
        batch = units[first : first + units_a_task]
        files = sorted({json.loads(unit)["map"] for unit in batch})
        for file in files:
            if file not in maps:
                # A task, so that a lost worker's copy is made again; one of scattered data is not.
                content = pathlib.Path(file).read_bytes()
                maps[file] = client.submit(bytes, content, pure=False)
        tasks.append(client.submit(_answer, batch, {file: maps[file] for file in files}, robot,
                                   timeout_s, program, pure=False))
    return tasks


def _record(tasks, recorder, on_record):
    """Hands answers on as they come; how many."""
    count = 0
    try:
        for task, answers in as_completed(tasks, with_results=True):
            recorder.stdin.write("".join(answer + "\n" for answer in answers))
            recorder.stdin.flush()
            count += len(answers)
            task.release()
            if on_record:
                on_record(count)
        recorder.stdin.close()
    except BrokenPipeError:
        pass  # the recorder says why
    return count


def _lines_of(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise NbvoptError(done.stderr.strip())
    return done.stdout.splitlines()


class _Solver:
    """A worker of nbvopt, with the files that units name."""

    def __init__(self, program):
        self.program = program
        self.folder = tempfile.TemporaryDirectory(prefix="nbvopt_dask.")
        self.process = None
        self.lines = queue.SimpleQueue()
        atexit.register(self.stop)

    def place(self, content, suffix):
        """A file here with this content, of whatever name."""
        name = hashlib.sha256(content).hexdigest() + suffix
        path = pathlib.Path(self.folder.name, name)
        if not path.exists():
            unfinished = path.with_name(f"{name}.{os.getpid()}.{threading.get_ident()}")
            unfinished.write_bytes(content)
            unfinished.rename(path)
        return str(path)

    def start(self):
        self.process = subprocess.Popen([self.program, "study", "worker"], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
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


def _answer(batch, maps, robot, timeout_s, program):
    """The answers' lines to units' lines, on a worker of Dask; one solver a thread."""
    worker = get_worker()
    solvers = worker.__dict__.setdefault("nbvopt_solvers", {})
    solver = solvers.setdefault(threading.get_ident(), _Solver(program))
    placed = {file: solver.place(content, pathlib.Path(file).suffix)
              for file, content in maps.items()}
    answers = []
    for line in batch:
        unit = json.loads(line)
        unit["map"] = placed[unit["map"]]
        unit["robot"] = solver.place(robot, ".yaml")
        answers.append(solver.ask(unit, timeout_s))
    return answers


def main():
    parser = argparse.ArgumentParser(prog="nbvopt_dask", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("spec")
    parser.add_argument("--out", required=True, metavar="DIR")
    parser.add_argument("--scheduler", required=True, metavar="ADDRESS")
    parser.add_argument("--references", action="store_true", help="of study reference")
    parser.add_argument("--retry-failed", action="store_true")
    parser.add_argument("--nbvopt", default="nbvopt", help="the program, here and on the workers")
    arguments = parser.parse_args()
    with Client(arguments.scheduler) as client:
        try:
            count = run_study(client, arguments.spec, arguments.out,
                              references=arguments.references,
                              retry_failed=arguments.retry_failed, nbvopt=arguments.nbvopt,
                              worker_nbvopt=arguments.nbvopt)
        except NbvoptError as error:
            parser.exit(3, f"{error}\n")
    print(f"{count} units recorded")


if __name__ == "__main__":
    main()
