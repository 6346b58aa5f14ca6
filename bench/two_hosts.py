#!/usr/bin/env python3
"""A study and a reproduction on two hosts, which are network namespaces of this machine (as root).

    bench/two_hosts.py NBVOPT

Under mpirun with four ranks, two a host, whose remote shell is `ip netns exec`, once with files that
both hosts see and once where one of them lacks the map; then on Dask, with client and scheduler on
one host and two workers on the other, which sees neither maps, worlds, the folder of results nor the
Python module. Compares the records, times aside, with those of one host.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from kill_engines import ROOT, Reproduction, Study, answers, finish, start, tree

HOSTS = {"10.77.0.1": "nbvopt_a", "10.77.0.2": "nbvopt_b"}
A, B = (["ip", "netns", "exec", host] for host in HOSTS.values())
AGENT = """#!/bin/sh
# HOST COMMAND...: runs the command on the host.
shift
exec ip netns exec nbvopt_b {before} /bin/sh -c "{script} $*"
"""


def connect():
    disconnect()
    for address, host in HOSTS.items():
        link = host.replace("nbvopt", "nbv")
        subprocess.run(["ip", "netns", "add", host], check=True)
        if address == "10.77.0.1":
            subprocess.run(["ip", "link", "add", "nbv_a", "type", "veth", "peer", "name", "nbv_b"],
                           check=True)
        subprocess.run(["ip", "link", "set", link, "netns", host], check=True)
        for what in (["addr", "add", f"{address}/24", "dev", link], ["link", "set", link, "up"],
                     ["link", "set", "lo", "up"]):
            subprocess.run(["ip", "-n", host, *what], check=True)


def disconnect():
    for host in HOSTS.values():
        subprocess.run(["ip", "netns", "delete", host], check=False, stderr=subprocess.DEVNULL)


def mpirun(folder, hides=()):
    """The command's first words; the other host lacks what is hidden."""
    agent = folder / "agent"
    agent.write_text(AGENT.format(
        before="unshare --mount" if hides else "",
        script="".join(f"mount -t tmpfs none {place}; " for place in hides)))
    agent.chmod(0o755)
    network = "10.77.0.0/24"
    options = {"plm_rsh_agent": agent, "orte_keep_fqdn_hostnames": 1, "btl": "tcp,self",
               "btl_tcp_if_include": network, "oob_tcp_if_include": network}
    return [*A, "mpirun", "--host", ",".join(f"{address}:2" for address in HOSTS), "-n", 4,
            "--map-by", "node",
            *(word for name, value in options.items() for word in ("--mca", name, value))]


def start_dask(folder):
    address, port = next(iter(HOSTS)), 8786
    hide = "; ".join(f"mount -t tmpfs none {place}"
                     for place in (folder, ROOT / "datasets", ROOT / "src"))
    python = f"{sys.executable} -m distributed.cli."
    services = [start([*A, *python.split()[:2], "distributed.cli.dask_scheduler", "--host", address,
                       "--port", port, "--no-dashboard"])]
    for _ in range(2):
        services.append(start([
            *B, "unshare", "--mount", "/bin/sh", "-c",
            f"{hide}; cd {folder}; exec env -u PYTHONPATH TMPDIR={folder} {python}dask_worker "
            f"tcp://{address}:{port} --host 10.77.0.2 --nthreads 1 --no-dashboard "
            f"--local-directory {folder}"]))
    return services, f"tcp://{address}:{port}"


def compare(how, folder, whole):
    is_same = answers(folder) == whole
    print(f"| {how} | {len(whole)} | {'the same' if is_same else 'OTHERS'} |", flush=True)
    return is_same


def run(nbvopt, folder):
    experiments = [Study(folder), Reproduction(folder)]
    wholes = []
    for experiment in experiments:
        finish([nbvopt, *experiment.run(folder / f"{experiment.name}-one", 2)])
        wholes.append(answers(folder / f"{experiment.name}-one"))
    print("| on two hosts | records | compared with those of one |\n| --- | ---: | --- |")
    good = True
    for experiment, whole in zip(experiments, wholes):
        out = folder / f"{experiment.name}-mpi"
        finish([*mpirun(folder), nbvopt, *experiment.run(out, 0)])
        good &= compare(f"mpirun, {experiment.name}", out, whole)
    refused = subprocess.run(
        [str(word) for word in [*mpirun(folder, [ROOT / "datasets"]), nbvopt,
                                *experiments[0].run(folder / "refused", 0)]],
        capture_output=True, text=True, check=False)
    told = [line for line in refused.stderr.splitlines() if "cannot be read on" in line]
    print(f"| mpirun, a host lacks the map | | {told[0] if told else 'NOTHING TOLD'} |", flush=True)
    good &= bool(told)
    services, address = start_dask(folder)
    time.sleep(5)
    try:
        for experiment, whole in zip(experiments, wholes):
            out = folder / f"{experiment.name}-dask"
            finish([*A, sys.executable, "-m", "nbvopt_dask", *experiment.on_dask(out), "--nbvopt",
                    nbvopt, "--scheduler", address])
            good &= compare(f"Dask, {experiment.name}", out, whole)
    finally:
        for service in services:
            for pid in tree(service.pid):
                os.kill(pid, 9)
            service.wait()
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nbvopt")
    nbvopt = pathlib.Path(parser.parse_args().nbvopt).resolve()
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                      PYTHONPATH=str(ROOT / "src" / "python"), PYTHONDONTWRITEBYTECODE="1")
    connect()
    try:
        with tempfile.TemporaryDirectory(prefix="nbvopt_hosts.") as folder:
            good = run(nbvopt, pathlib.Path(folder))
    finally:
        disconnect()
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
