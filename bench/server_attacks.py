#!/usr/bin/env python3
"""What a server takes of attacks: resident memory, and how long another client waits for a plan.

    PYTHONPATH=BUILD/python bench/server_attacks.py NBVOPT [SECONDS [PART OF A NAME]]

Each attack runs SECONDS (15) against a server of its own on loopback, which has one planning thread
and one core; it ends when the server takes more than 2 GB.
"""
import contextlib
import pathlib
import subprocess
import sys
import threading
import time

import grpc
from nbvopt_client import PlannerClient, PlannerError, pb, plan_request, rpc
from simulated_robot import SimulatedRobot

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests/python"))
from hostile_http2 import Attack, connect, resident_mib  # noqa: E402

MOST_MIB = 2000
STATE = {"base": (1.0, 1.0, 1.0), "joints": (0.0, 0.0, 0.4), "motion_time_s": 1.0}
INSERT_SCAN = "/nbvopt.v1.Planner/InsertScan"


def get(path: str) -> bytes:
    return f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()


PAGE = get("/")


class Observer:
    """Another client, which asks for a plan again and again, and looks at the server's memory."""

    def __init__(self, nbvopt: str):
        command = ["taskset", "-c", "0", nbvopt, "serve", "--create", "0.05", "--threads", "1"]
        self._process = subprocess.Popen(
            [*command, "--listen", "127.0.0.1:0", "--web", "127.0.0.1:0"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self.address = self._process.stdout.readline().split()[-1]
        self.web = self._process.stdout.readline().split("//")[-1].strip("/\n")
        self.waits_s = []
        self.refused = 0
        self.least_mib = self.most_mib = resident_mib(self._process.pid)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._ask)

    def look(self) -> bool:
        """Whether the server's memory is still within what the attack may take."""
        self.most_mib = max(self.most_mib, resident_mib(self._process.pid))
        return self.most_mib < MOST_MIB

    def _ask(self) -> None:
        with PlannerClient(self.address, timeout_s=20.0) as planner:
            while not self._ended.wait(0.1):
                start = time.monotonic()
                try:
                    planner.plan(**STATE)
                    self.waits_s.append(time.monotonic() - start)
                except PlannerError:
                    self.refused += 1
                self.look()

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *error) -> None:
        self._ended.set()
        self._thread.join()
        self._process.terminate()
        self._process.wait()


def withhold(observer: Observer, seconds: float, connections: int, streams: int) -> None:
    attack = Attack(observer.address, connections, streams, 31 << 20, INSERT_SCAN)
    attack.run(seconds, observer.look)
    attack.close()


def be_silent(observer: Observer, seconds: float, connections: int) -> None:
    silent = [connect(observer.address) for _ in range(connections)]
    time.sleep(seconds)
    for each in silent:
        each.close()


def read_no_plans(observer: Observer, seconds: float, streams: int) -> None:
    end = time.monotonic() + seconds

    def states():
        while time.monotonic() < end:
            yield plan_request(**STATE)
            time.sleep(0.02)

    with grpc.insecure_channel(observer.address) as channel:
        calls = [rpc.PlannerStub(channel).PlanStream(states()) for _ in range(streams)]
        time.sleep(seconds)
        for call in calls:
            call.cancel()


def ask_the_page(observer: Observer, seconds: float, connections: int, request: bytes) -> None:
    """Reads no answer; who is let go comes again."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        asking = []
        for _ in range(connections):
            asking.append(connect(observer.web))
            with contextlib.suppress(OSError):
                asking[-1].sendall(request)
        time.sleep(2.0)
        for each in asking:
            each.close()


def ask_for_a_growing_map(observer: Observer, seconds: float, connections: int) -> None:
    """The same for a map that changes all the time, of which each answer is another."""
    robot = SimulatedRobot()
    ended = threading.Event()

    def grow():
        with PlannerClient(observer.address, timeout_s=20.0) as planner:
            while not ended.is_set():
                with contextlib.suppress(PlannerError):
                    planner.insert_depth_image(robot.look(), robot.intrinsics, robot.T_map_sensor)
                turned = pb.JointPosition(pan_rad=robot.joints[0] + 1.0, height_m=0.4)
                robot.move(turned, 1.0)

    growing = threading.Thread(target=grow)
    growing.start()
    ask_the_page(observer, seconds, connections, get("/map?since=1-1"))
    ended.set()
    growing.join()


def main(nbvopt: str, seconds: float = 15.0, only: str = "") -> None:
    attacks = {
        "none": lambda observer, seconds: time.sleep(seconds),
        "2 connections x 100 scans of 31 MiB, last byte withheld": lambda *on: withhold(*on, 2, 100),
        "120 connections x 1 such scan": lambda *on: withhold(*on, 120, 1),
        "500 connections that say nothing": lambda *on: be_silent(*on, 500),
        "20 PlanStreams whose answers nobody reads": lambda *on: read_no_plans(*on, 20),
        "200 halves of a request to the page": lambda *on: ask_the_page(*on, 200, PAGE[:-2]),
        "200 readers of the page that read nothing": lambda *on: ask_the_page(*on, 200, PAGE),
        "200 readers of a growing map that read nothing": lambda *on: ask_for_a_growing_map(*on, 200),
        "200 readers of gains that read nothing": lambda *on: ask_the_page(*on, 200, get("/gains")),
        "200 endless lines to the page": lambda *on: ask_the_page(*on, 200, b"G" * 10_000_000),
    }
    print("| attack | resident, MiB | plans of another client | refused | median, s | longest, s |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for name, attack in attacks.items():
        if only not in name:
            continue
        with Observer(nbvopt) as observer, contextlib.suppress(ConnectionError):
            time.sleep(1.0)
            attack(observer, seconds)
        waits_s = sorted(observer.waits_s)
        print(
            f"| {name} | {observer.least_mib:.0f} to {observer.most_mib:.0f} | {len(waits_s)} "
            f"| {observer.refused} | {waits_s[len(waits_s) // 2]:.2f} | {waits_s[-1]:.2f} |",
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1], *map(float, sys.argv[2:3]), *sys.argv[3:])
