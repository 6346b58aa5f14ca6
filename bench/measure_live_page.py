#!/usr/bin/env python3
"""What pages that watch cost a server: plans and scans with readers and without, in one run.

    PYTHONPATH=BUILD/python /usr/bin/python3 bench/measure_live_page.py NBVOPT [ROUNDS] [READERS]

Two servers take the same scans and plans of the simulated robot in turns, round by round; the
readers of the second are told of every change and fetch the map as the page does. Then the events
that a reader gets while plans come as fast as they can.
"""

import contextlib
import http.client
import json
import multiprocessing
import statistics
import subprocess
import sys
import time

from nbvopt_client import PlannerClient, plan_request
from simulated_robot import SimulatedRobot

STILL = {"base": (3.0, 1.1, 0.0), "joints": (0.0, 0.0, 0.4), "motion_time_s": 1.0}


class Served:
    def __init__(self, nbvopt: str, *what: str):
        """`what` says which map, as serve's arguments; none: an empty one."""
        self._process = subprocess.Popen(
            [nbvopt, "serve", *(what or ("--create", "0.05")), "--listen", "127.0.0.1:0",
             "--web", "127.0.0.1:0"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = self._process.stdout.readline().split()[-1]
        self.web = self._process.stdout.readline().split("//")[-1].strip("/\n")

    @property
    def pid(self) -> int:
        return self._process.pid

    def __enter__(self):
        return self

    def __exit__(self, *error) -> None:
        self._process.terminate()
        self._process.wait()
        self._process.stdout.close()


class Reader(multiprocessing.Process):
    """A page: reads events, and after each the map where it is another."""

    def __init__(self, web: str):
        super().__init__(daemon=True)
        self.web = web
        self.events, self.maps, self.first_bytes, self.bytes = (
            multiprocessing.Value("q") for _ in range(4))
        self.start()

    def run(self) -> None:
        events = http.client.HTTPConnection(self.web)
        events.request("GET", "/events")
        shown = ""
        with contextlib.suppress(OSError, http.client.HTTPException):
            for line in events.getresponse():
                if not line.startswith(b"data:"):
                    continue
                self.events.value += 1
                if line.split(b'"')[3].decode() != shown:
                    shown = self._fetch_map(shown)

    def _fetch_map(self, since: str) -> str:
        """What changed since then; returns what that makes."""
        page = http.client.HTTPConnection(self.web)
        page.request("GET", f"/map?since={since}")
        answer = page.getresponse().read()
        if self.maps.value == 0:
            self.first_bytes.value = len(answer)
        self.bytes.value += len(answer)
        self.maps.value += 1
        return json.loads(answer)["id"]


class Driver:
    """A robot, and how long the server takes for its scans and plans."""

    def __init__(self, address: str):
        self.planner = PlannerClient(address)
        self.robot = SimulatedRobot()
        self.scans_s, self.plans_s = [], []

    def turn(self) -> None:
        image = self.robot.look()
        start = time.perf_counter()
        self.planner.insert_depth_image(image, self.robot.intrinsics, self.robot.T_map_sensor)
        scanned = time.perf_counter()
        plan = self.planner.plan(self.robot.base, self.robot.joints, 1.0)
        self.scans_s.append(scanned - start)
        self.plans_s.append(time.perf_counter() - scanned)
        self.robot.move(plan.joints, 1.0)


def burst(served: Served, seconds: float) -> tuple:
    """Plans a second, and events a second of one reader meanwhile."""
    reader = Reader(served.web)
    end = time.perf_counter() + seconds

    def states():
        while time.perf_counter() < end:
            yield plan_request(**STILL, max_evaluations=10)
            time.sleep(0.001)

    with PlannerClient(served.address) as planner:
        plans = sum(1 for _ in planner.plan_stream(states()))
    reader.terminate()
    return plans / seconds, reader.events.value / seconds


def main(nbvopt: str, rounds: int = 60, readers: int = 4) -> None:
    with Served(nbvopt) as alone, Served(nbvopt) as watched:
        pages = [Reader(watched.web) for _ in range(readers)]
        drivers = [Driver(alone.address), Driver(watched.address)]
        for i in range(rounds):
            for driver in drivers if i % 2 == 0 else drivers[::-1]:
                driver.turn()
        print(f"{rounds} rounds, {readers} readers; medians\n")
        print("| | unwatched, ms | watched, ms | ratio |")
        print("| --- | ---: | ---: | ---: |")
        for name in ("scans_s", "plans_s"):
            a, b = (1e3 * statistics.median(getattr(driver, name)) for driver in drivers)
            print(f"| {name[:-3]} | {a:.1f} | {b:.1f} | {b / a:.2f} |")
        print(f"\neach reader: {statistics.mean(page.events.value for page in pages):.0f} events, "
              f"{statistics.mean(page.maps.value for page in pages):.0f} maps, "
              f"{pages[0].bytes.value / rounds / 1e3:.0f} kB a scan")
        for page in pages:
            page.terminate()
        plans, events = burst(watched, 10.0)
        print(f"burst: {plans:.0f} plans a second, {events:.1f} events a second and reader")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
