"""The page of nbvopt serve --web in a real browser: the map grows, plans appear, nothing else runs.

    NBVOPT_CLI=PATH/TO/nbvopt PYTHONPATH=BUILD/python python3 test_live.py
"""

import functools
import http.server
import pathlib
import shutil
import socket
import threading
import unittest
import urllib.request

try:
    from selenium.webdriver.common.action_chains import ActionChains
except ImportError:
    pass  # BrowserTest skips
from browser import HOSTILE, BrowserTest
from nbvopt_client import PlannerClient
from served import Server
from simulated_robot import SimulatedRobot

OFFICE = pathlib.Path(__file__).resolve().parents[2] / "datasets/office_partial.ot"
BESIDE_DESK = {"base": (1.9, 2.6, 1.57), "joints": (0.0, 0.0, 0.4), "motion_time_s": 1.0}

# What a page of another server tries; each attempt ends as "refused" or as what it got.
FOREIGN_PAGE = """<!doctype html><title>foreign</title><script>
const server = "SERVER";
const tries = {};
const attempt = (name, promise) => promise.then(
  got => { tries[name] = got; }, () => { tries[name] = "refused"; });
const element = (tag, source) => new Promise((resolve, reject) => {
  const it = document.createElement(tag);
  it.onload = () => resolve("loaded");
  it.onerror = reject;
  it.src = source;
  document.head.append(it);
});
Promise.all([
  attempt("map", fetch(server + "map").then(answer => answer.text())),
  attempt("blind", fetch(server + "metrics", {mode: "no-cors"}).then(answer => answer.type)),
  attempt("post", fetch(server + "map", {method: "POST", body: "x"}).then(answer => answer.text())),
  attempt("script", element("script", server + "map")),
  attempt("picture", element("img", server)),
  attempt("events", new Promise((resolve, reject) => {
    const events = new EventSource(server + "events");
    events.onopen = () => resolve("opened");
    events.onerror = reject;
  })),
]).then(() => { window.tries = tries; });
</script>"""


class QuietFiles(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *arguments):
        pass


def metric(server: Server, name: str) -> float:
    with urllib.request.urlopen(server.web + "metrics", timeout=10) as answer:
        lines = answer.read().decode().splitlines()
    return float(next(line for line in lines if line.startswith(name + " ")).split()[-1])


class LivePageTest(BrowserTest):
    def serve(self, *arguments: str, web: str = "127.0.0.1:0") -> Server:
        try:
            server = Server(*arguments, "--web", web)
        except RuntimeError as error:
            if "no web server" not in str(error):
                raise
            self.skipTest(str(error))
        self.addCleanup(server.stop)
        return server

    def drawn(self) -> int:
        return self.look()["drawn"]

    def first_look(self) -> tuple:
        """What is told and drawn of the map where nobody has turned it."""
        self.browser.find_element("tag name", "body").send_keys("r")
        return self.text("facts"), self.look()

    def test_the_map_grows_and_plans_appear(self):
        server = self.serve()
        self.open(server.web)
        self.assertIn("nothing is known", self.text("notice"))
        self.wait_until(lambda: self.text("live") == "live: map version 1, no plan yet")
        self.assertEqual(self.text("answer"), "")
        empty = self.drawn()
        robot = SimulatedRobot()
        with PlannerClient(server.address) as planner:
            planner.insert_depth_image(robot.look(), robot.intrinsics, robot.T_map_sensor)
            self.wait_until(lambda: self.text("live") == "live: map version 2, no plan yet")
            self.assertFalse(self.browser.find_element("id", "notice").is_displayed())
            self.assertGreater(self.drawn(), empty + 1000)
            plan = planner.plan(robot.base, robot.joints, 1.0)
            self.wait_until(lambda: "plan 1" in self.text("live"))
            self.assertIn(f"{plan.view.gain:.1f}", self.text("answer"))
            self.assertIn(plan.message, self.text("why"))
            planned = self.drawn()
            self.click("show-views")
            self.assertLess(self.drawn(), planned - 300)  # two robots with what they see
            self.click("show-views")
            facts = self.text("facts")
            for _ in range(3):
                robot.move(plan.joints, 1.0)
                planner.insert_depth_image(robot.look(), robot.intrinsics, robot.T_map_sensor)
                plan = planner.plan(robot.base, robot.joints, 1.0)
            self.wait_until(lambda: self.text("live") == "live: map version 5, plan 4")
            self.assertNotEqual(self.text("facts"), facts)
            self.assertIn(f"{plan.view.gain:.1f}", self.text("answer"))
            # What came bit by bit is what another page is told at once.
            grown = self.first_look()
            self.open(server.web)
            self.wait_until(lambda: self.text("live") == "live: map version 5, plan 4")
            self.assertEqual(self.first_look(), grown)
            planner.clear_map()
            self.wait_until(lambda: "nothing is known" in self.text("notice"))
        self.assert_quiet()

    def test_shows_what_views_and_voxels_gain(self):
        server = self.serve(str(OFFICE))
        self.open(server.web)
        self.click("ask-gains")
        self.wait_until(lambda: self.text("gains-facts") == "there is no plan yet")
        with PlannerClient(server.address) as planner:
            near = {**BESIDE_DESK, "motion_time_s": 0.2, "max_evaluations": 50}  # few views to judge
            planner.plan(**near)
            self.wait_until(lambda: "of plan 1, judged on map version 1" in self.text("gains-facts"))
            self.wait_until(lambda: "(dark) to" in self.text("landscape-value"))
            before = self.look()
            landscape = self.browser.find_element("id", "landscape-map")
            ActionChains(self.browser).move_to_element_with_offset(landscape, 60, 10).perform()
            self.assertRegex(self.text("landscape-value"), r"^pan .* rad: gain \d+\.\d$")
            self.assertGreater(self.look()["drawn"], before["drawn"])  # such a view is outlined
            self.assertEqual(self.text("voxel-gains-facts"), "by the gain expected")
            colours = self.look()["colours"]
            self.click("show-gains")
            self.assertNotEqual(self.look()["colours"], colours)
            planner.plan(**near, gain="average_entropy")
            self.wait_until(lambda: "no sum over voxels" in self.text("voxel-gains-facts"))
            self.assertFalse(self.browser.find_element("id", "show-gains").is_enabled())
        self.click("ask-gains")
        self.assertFalse(self.browser.find_element("id", "landscape").is_displayed())
        self.assertEqual(self.text("gains-facts"), "")
        self.assert_quiet()

    def test_runs_no_text_of_a_map(self):
        folder = pathlib.Path(self.folder.name, HOSTILE)  # folders of a path: what ends an element
        folder.mkdir(parents=True)
        head, tail = OFFICE.read_bytes().split(b"\n", 1)
        (folder / "map.ot").write_bytes(head + b"\n# " + HOSTILE.encode() + b"\n" + tail)
        shutil.copy(OFFICE, folder / "second.ot")
        server = self.serve(str(folder / "map.ot"), "--data-dir", self.folder.name)
        self.open(server.web)
        self.assertIn(HOSTILE, self.text("panel"))
        with PlannerClient(server.address) as planner:
            planner.load_map(f"{HOSTILE}/second.ot")
            planner.plan(**BESIDE_DESK)
            self.wait_until(lambda: self.text("live") == "live: map version 2, plan 1")
        self.assert_ran_nothing_of(HOSTILE)
        self.assert_quiet()

    def test_pages_of_other_servers_get_nothing(self):
        server = self.serve()
        page = pathlib.Path(self.folder.name, "foreign.html")
        page.write_text(FOREIGN_PAGE.replace("SERVER", server.web), encoding="utf-8")
        files = functools.partial(QuietFiles, directory=self.folder.name)
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), files) as foreign:
            thread = threading.Thread(target=foreign.serve_forever)
            thread.start()
            # Of another port, and of another name for this machine.
            for name in ("127.0.0.1", "localhost"):
                self.browser.get(f"http://{name}:{foreign.server_port}/foreign.html")
                self.wait_until(lambda: self.run_script("return !!window.tries"))
                tries = ("map", "blind", "post", "script", "picture", "events")
                self.assertEqual(self.run_script("return window.tries"),
                                 dict.fromkeys(tries, "refused"))
            foreign.shutdown()
            thread.join()
        self.assertGreaterEqual(metric(server, "nbvopt_web_forbidden_total"), 12)
        self.assertEqual(metric(server, "nbvopt_web_events_total"), 0)

    def test_says_when_there_is_no_place_for_it(self):
        server = self.serve("--max-web-connections", "6")
        host, port = server.web.removeprefix("http://").strip("/").split(":")
        readers = [socket.create_connection((host, int(port))) for _ in range(3)]
        for reader in readers:
            self.addCleanup(reader.close)
            reader.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
            self.assertTrue(reader.recv(100).startswith(b"HTTP/1.1 200 "))
        self.open(server.web)
        self.wait_until(lambda: "no place for another page" in self.text("live"))

    def test_finds_its_server_again(self):
        server = self.serve()
        self.open(server.web)
        self.wait_until(lambda: self.text("live") == "live: map version 1, no plan yet")
        with PlannerClient(server.address) as planner:
            planner.plan(**BESIDE_DESK)
        self.wait_until(lambda: "plan 1" in self.text("live"))
        server.end()
        self.wait_until(lambda: "the server is away" in self.text("live"))
        self.serve(str(OFFICE), web=server.web.removeprefix("http://").strip("/"))
        self.wait_until(lambda: self.text("live") == "live: map version 1, no plan yet")
        self.assertFalse(self.browser.find_element("id", "notice").is_displayed())
        self.assertIn("voxels of 0.05 m", self.text("facts"))
        self.assertEqual(self.text("answer"), "")  # that of another run


if __name__ == "__main__":
    unittest.main()
