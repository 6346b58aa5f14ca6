#!/usr/bin/env python3
"""What a server takes of scans that touch too much and of readers of its map.

    PYTHONPATH=BUILD/python bench/map_attacks.py NBVOPT

Each attack is made on a server of its own on loopback, and ends where that takes more than 6 GB.
"""
import contextlib
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import threading
import time

import grpc
import numpy as np
from nbvopt_client import PlannerClient, PlannerError, pb, rpc

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests/python"))
from hostile_http2 import resident_mib  # noqa: E402

MOST_MIB = 6000
POSE = np.eye(4)


class Server:
    def __init__(self, nbvopt: str, *arguments: str):
        self._process = subprocess.Popen(
            [nbvopt, "serve", *arguments, "--listen", "127.0.0.1:0"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self.address = self._process.stdout.readline().split()[-1]
        self.most_mib = 0.0

    def resident_mib(self) -> float:
        if self.most_mib > MOST_MIB:  # it was killed
            return self.most_mib
        now_mib = resident_mib(self._process.pid)
        self.most_mib = max(self.most_mib, now_mib)
        if now_mib > MOST_MIB:
            self._process.kill()
        return now_mib

    def end(self) -> float:
        """How long it takes to end, s."""
        start = time.monotonic()
        self._process.terminate()
        self._process.wait()
        return time.monotonic() - start

    def __enter__(self):
        return self

    def __exit__(self, *error) -> None:
        self.end()


def node(log_odds: float, u: float, mask: int) -> bytes:
    return struct.pack("<f3BfB", log_odds, 255, 255, 255, u, mask)


def branch(level: int) -> tuple[bytes, int]:
    """A cube of 2^level voxels an axis, of which some are not known, and how many nodes it has."""
    if level == 0:
        return (node(0.85, 0.5, 0) if random.random() < 0.2 else node(-0.4, 1.0, 0)), 1
    known = [i for i in range(8) if level > 2 or i == 0 or random.random() > 0.25]
    below = [branch(level - 1) for _ in known]
    own = node(0.85, 1.0, sum(1 << i for i in known))
    return own + b"".join(each for each, _ in below), 1 + sum(nodes for _, nodes in below)


def write_map(path: pathlib.Path) -> float:
    """A map of 64 times the same cube of 3.2 m; returns its size, MB."""
    random.seed(1)
    tree, nodes = branch(6)
    for _ in range(2):
        tree, nodes = node(0.85, 1.0, 255) + 8 * tree, 8 * nodes + 1
    for depth in range(7, -1, -1):
        tree, nodes = node(0.85, 1.0, 1 << (0 if depth else 7)) + tree, nodes + 1
    header = f"# Octomap OcTree file\nid UncertaintyOcTree\nsize {nodes}\nres 0.05\ndata\n"
    path.write_bytes(header.encode() + tree)
    return len(tree) / 1e6


def touch_too_much(nbvopt: str, folder: pathlib.Path) -> None:
    """A million rays into all directions, at voxels of 1 cm."""
    robot = folder / "robot.yaml"
    robot.write_text("sensor: {range_axis: euclidean}\n")
    rays = np.random.default_rng(1).normal(size=(1_000_000, 3))
    for ends in (False, True):
        with Server(nbvopt, "--create", "0.01", "--robot", str(robot)) as server:
            answers = []

            def insert():
                with PlannerClient(server.address, timeout_s=60.0) as planner:
                    start = time.monotonic()
                    try:
                        planner.insert_points(np.empty((0, 3)), POSE, no_returns=rays)
                        answers.append(f"inserted after {time.monotonic() - start:.1f} s")
                    except PlannerError as error:
                        answers.append(f"{error.code.name} after {time.monotonic() - start:.1f} s")

            thread = threading.Thread(target=insert)
            thread.start()
            end = time.monotonic() + (1.0 if ends else 60.0)
            while thread.is_alive() and time.monotonic() < end:
                server.resident_mib()
                time.sleep(0.02)
            ended_s = server.end()
            thread.join()
            what = f"SIGTERM after 1 s, ended after {ended_s:.1f} s" if ends else answers[0]
            print(f"a million rays: {what}, {server.most_mib:.0f} MiB at most", flush=True)


def read_no_maps(nbvopt: str, map_file: str) -> None:
    with Server(nbvopt, map_file) as server, PlannerClient(server.address) as planner:
        planner.get_map()
        before_mib = server.resident_mib()
        readers = []
        for _ in range(20):
            channel = grpc.insecure_channel(
                server.address, options=[("grpc.use_local_subchannel_pool", 1)]
            )
            readers.append(rpc.PlannerStub(channel).GetMap(pb.GetMapRequest()))
            next(readers[-1])
            planner.insert_points(np.array([[0.0, 0.0, 2.0], [0.1, 0.0, 2.0]]), POSE)
        held_mib = (server.resident_mib() - before_mib) / len(readers)
        time.sleep(12.0)
        let_go = server.resident_mib() - before_mib
        print(f"20 readers that do not read: {held_mib:.1f} MiB each, {let_go:.0f} MiB after 12 s")
        for reader in readers:
            reader.cancel()


def read_and_scan(nbvopt: str, map_file: str, folder: pathlib.Path) -> None:
    snapshot = ["--snapshot", str(folder / "snapshot.ot"), "--snapshot-every", "1"]
    wall = np.array([[0.02 * i, 0.02 * j, 2.0] for i in range(-60, 60) for j in range(-45, 45)])
    with Server(nbvopt, map_file, *snapshot) as server:
        ended = threading.Event()

        def read():
            options = [
                ("grpc.use_local_subchannel_pool", 1),
                ("grpc.max_receive_message_length", -1),
            ]
            with grpc.insecure_channel(server.address, options=options) as channel:
                while not ended.is_set():
                    with contextlib.suppress(grpc.RpcError):
                        for _ in rpc.PlannerStub(channel).GetMap(pb.GetMapRequest()):
                            if ended.is_set():
                                return

        readers = [threading.Thread(target=read) for _ in range(50)]
        for reader in readers:
            reader.start()
        waits_s = []
        with PlannerClient(server.address, timeout_s=60.0) as planner:
            end = time.monotonic() + 14.0
            while time.monotonic() < end:
                start = time.monotonic()
                planner.insert_points(wall, POSE)
                waits_s.append(time.monotonic() - start)
                server.resident_mib()
                time.sleep(max(0.0, 0.1 - waits_s[-1]))
        ended.set()
        for reader in readers:
            reader.join()
        waits_s.sort()
        print(
            f"50 readers, a snapshot a second: {len(waits_s)} scans in 14 s, median "
            f"{1e3 * waits_s[len(waits_s) // 2]:.0f} ms, longest {1e3 * waits_s[-1]:.0f} ms, "
            f"{server.most_mib:.0f} MiB at most"
        )


def main(nbvopt: str) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        touch_too_much(nbvopt, folder)
        map_file = folder / "map.ot"
        print(f"a map of {write_map(map_file):.0f} MB:", flush=True)
        read_no_maps(nbvopt, str(map_file))
        read_and_scan(nbvopt, str(map_file), folder)


if __name__ == "__main__":
    main(sys.argv[1])
