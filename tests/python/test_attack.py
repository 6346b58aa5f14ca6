"""Attacks a server as a hostile or broken client would, and asks it in the meantime.

    NBVOPT_CLI=PATH/TO/nbvopt PYTHONPATH=BUILD/python python3 test_attack.py

On loopback only, and bounded: an attack ends after seconds, or when the server has taken more
memory than it may.
"""

import threading
import unittest

from hostile_http2 import Attack, connect
from nbvopt_client import PlannerClient, PlannerError, grpc
from served import Server

INSERT_SCAN = "/nbvopt.v1.Planner/InsertScan"
HEALTH = "/grpc.health.v1.Health/Check"
ATTACK_S = 2.5
CALLS_AT_A_TIME = 32  # of a connection, by the server's limit


def plan(planner: PlannerClient) -> None:
    planner.plan(base=(1.0, 1.0, 1.0), joints=(0.0, 0.0, 0.4), motion_time_s=1.0)


class OtherClient:
    """Somebody who asks for plans all the time, and again where that is refused."""

    def __init__(self, address: str):
        self.answers = 0
        self.refusals = []
        self._ended = threading.Event()
        self._address = address
        self._thread = threading.Thread(target=self._ask)

    def _ask(self) -> None:
        with PlannerClient(self._address, timeout_s=10.0) as planner:
            while not self._ended.wait(0.05):
                try:
                    plan(planner)
                    self.answers += 1
                except PlannerError as error:
                    self.refusals.append(error.code)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *error) -> None:
        self._ended.set()
        self._thread.join()


class SilentConnectionsTest(unittest.TestCase):
    """More of them than the server has descriptors."""

    def attack(self, listen: str) -> None:
        server = Server("--snapshot", "DATA/map.ot", "--snapshot-every", "0.05", listen=listen,
                        max_files=128)
        self.addCleanup(server.stop)
        with PlannerClient(server.address) as early:
            plan(early)
            silent = [connect(server.address) for _ in range(400)]
            plan(early)
            with PlannerClient(server.address) as late:
                plan(late)
                version = late.clear_map(0.05).map_version
                while late.status().durable_version < version:  # or the test's timeout
                    pass
            for each in silent:
                each.close()
            with PlannerClient(server.address) as last:
                plan(last)
                self.assertGreater(last.status().connections_silent, 200)

    def test_over_a_socket(self):
        self.attack(listen="")

    def test_over_tcp(self):
        self.attack(listen="127.0.0.1:0")


class MessagesWithoutAnEndTest(unittest.TestCase):
    """Large messages of which the last byte never comes."""

    BUFFERED_MIB = 64

    def setUp(self):
        self.server = Server(
            "--max-buffered-mib", str(self.BUFFERED_MIB), "--max-receive", "1", listen="127.0.0.1:0"
        )
        self.addCleanup(self.server.stop)
        self.before_mib = self.server.memory_mib()

    def grown_mib(self) -> float:
        return self.server.memory_mib() - self.before_mib

    def attack(self, connections: int, streams: int, method: str) -> Attack:
        message_mib = 31
        # gRPC looks at what it holds when that has come, so that a fast sender is ahead of it by
        # some messages: for moments, on a busy machine, by half of those that may be on their way.
        most_mib = 0.75 * connections * min(streams, CALLS_AT_A_TIME) * message_mib
        attack = Attack(self.server.address, connections, streams, message_mib << 20, method)
        self.addCleanup(attack.close)
        with OtherClient(self.server.address) as other:
            attack.run(ATTACK_S, lambda: self.grown_mib() < most_mib)
        self.assertLess(self.grown_mib(), most_mib)
        self.assertGreater(attack.refused, 0)
        self.assertGreater(other.answers, 0)
        # What is refused for lack of memory may be anybody's, and says that it may be tried again.
        again = {grpc.StatusCode.RESOURCE_EXHAUSTED, grpc.StatusCode.UNAVAILABLE}
        self.assertLessEqual(set(other.refusals), again)
        return attack

    def failed_scans(self) -> int:
        with PlannerClient(self.server.address) as planner:
            (scans,) = (each for each in planner.status().latencies if each.method == "InsertScan")
            return scans.failed

    def test_many_streams(self):
        attack = self.attack(2, 100, INSERT_SCAN)
        # Those that memory was left for have come to the end of their time.
        self.assertEqual(attack.refused, 200)
        self.assertGreater(self.failed_scans(), 0)

    def test_many_connections(self):
        self.attack(60, 1, INSERT_SCAN)

    def test_of_another_service(self):
        self.attack(2, 20, HEALTH)


if __name__ == "__main__":
    unittest.main()
