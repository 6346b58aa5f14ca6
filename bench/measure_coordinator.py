#!/usr/bin/env python3
"""How many units a second a study's coordinator hands out, and its memory.

    bench/measure_coordinator.py NBVOPT [--units 100000 1000000] [--sleep-ms 0 5]
        [--workers 1 2 4] [--ranks 2 3 5]

Workers only sleep. Prints a row a run: of processes of this machine, then under mpirun, which runs
one worker a rank but the first. Of the coordinator it tells the resident memory with its first
records and the most that there was, and the processor time a unit: what it needs of a core however
busy the machine is.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SEARCHES = 10  # five of the spec's and the paper's, two budgets
WORKER = pathlib.Path(__file__).with_name("sleeping_worker.py")
OFFICE = WORKER.parent.parent / "datasets" / "office_partial.ot"


def spec(units):
    starts = 50
    seeds = max(1, units // (starts * SEARCHES))
    return (
        f"maps: [{OFFICE}]\nstarts: {{sampled: {{count: {starts}}}}}\nmotion_times_s: [0.5]\n"
        "solvers: [{solver: random}]\nbudgets: {max_evaluations: [20, 100]}\n"
        f"seeds: [{', '.join(map(str, range(1, seeds + 1)))}]\n"
    )


def measure(nbvopt, units, sleep_ms, start, workers):
    with tempfile.TemporaryDirectory() as folder:
        spec_file = pathlib.Path(folder, "spec.yaml")
        spec_file.write_text(spec(units))
        command = ["study", "run", spec_file, "--out", folder + "/out",
                   "--worker-command", f"{sys.executable} {WORKER} {sleep_ms}"]
        if not start:
            command += ["--workers", str(workers)]
        run = subprocess.Popen([*start, nbvopt, *command], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL, text=True)
        records = pathlib.Path(folder, "out", "records.jsonl")
        coordinator = None if start else run.pid
        memory_mib, busy_s = [], 0.0
        while run.poll() is None:
            # Found once: when the first rank has ended, another one would take its place.
            coordinator = coordinator or first_rank(run.pid)
            used = use_of(coordinator)
            if used and records.exists() and records.stat().st_size > 0:
                memory_mib.append(used[0])
                busy_s = used[1]
            try:
                run.wait(0.2)
            except subprocess.TimeoutExpired:
                pass
        text = run.stdout.read()
    done, seconds = re.search(r"(\d+) units in ([\d.]+) s", text).groups()
    busy = re.search(r"busy for ([\d.]+) %", text).group(1)
    how = f"mpirun, {workers + 1} ranks" if start else "processes"
    rate = int(done) / float(seconds)
    print(f"| {how} | {workers} | {sleep_ms:g} | {int(done):,} | {rate:,.0f} | {busy} % "
          f"| {memory_mib[0]:.0f} to {max(memory_mib):.0f} "
          f"| {1e6 * busy_s / int(done):.0f} |", flush=True)


def first_rank(mpirun):
    """The process of mpirun's first rank; none where it is not there yet."""
    try:
        for child in pathlib.Path(f"/proc/{mpirun}/task/{mpirun}/children").read_text().split():
            environment = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
            if b"OMPI_COMM_WORLD_RANK=0" in environment:
                return int(child)
    except OSError:
        pass
    return None


def use_of(pid):
    """Resident memory, MiB, and processor time, s; none where the process is not there."""
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text()
        ticks = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13]
        return (int(re.search(r"VmRSS:\s+(\d+)", status).group(1)) / 1024,
                sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK"))
    except (OSError, AttributeError):
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nbvopt")
    parser.add_argument("--units", type=int, nargs="+", default=[100_000])
    parser.add_argument("--sleep-ms", type=float, nargs="+", default=[0])
    parser.add_argument("--workers", type=int, nargs="*", default=[1, 2, 4])
    parser.add_argument("--ranks", type=int, nargs="*", default=[2, 3, 5])
    arguments = parser.parse_args()
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    print("| engine | workers | ms a unit | units | units/s | workers busy | coordinator, MiB "
          "| its µs a unit |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for units in arguments.units:
        for sleep_ms in arguments.sleep_ms:
            for workers in arguments.workers:
                measure(arguments.nbvopt, units, sleep_ms, [], workers)
            for ranks in arguments.ranks:
                mpirun = ["mpirun", "--oversubscribe", "-n", str(ranks)]
                measure(arguments.nbvopt, units, sleep_ms, mpirun, ranks - 1)


if __name__ == "__main__":
    main()
