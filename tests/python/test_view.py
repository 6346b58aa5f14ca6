"""The page of nbvopt view in a real browser: it draws, its switches work, it runs no text."""

import json
import os
import pathlib
import shutil
import subprocess
import unittest

from browser import HOSTILE, BrowserTest

try:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    pass  # BrowserTest skips

DATASETS = pathlib.Path(__file__).resolve().parents[2] / "datasets"
OFFICE = str(DATASETS / "office_partial.ot")
QUERY = "--base 1.9,2.6,1.57 --pan 0 --tilt 0 --height 0.4 --motion-time 1 --max-evals 50".split()


def run_cli(*arguments: str) -> None:
    subprocess.run([os.environ["NBVOPT_CLI"], *arguments], capture_output=True, check=True)


class ViewTest(BrowserTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.answer = f"{cls.folder.name}/answer.json"
        cls.page = f"file://{cls.folder.name}/view.html"
        run_cli("query", OFFICE, *QUERY, "--json-out", cls.answer)
        run_cli("view", OFFICE, "--answer", cls.answer, "-o", f"{cls.folder.name}/view.html")

    def test_draws_the_map_and_heeds_its_switches(self):
        self.open(self.page)
        everything = self.look()
        self.assertGreater(everything["drawn"], 4000)
        self.assertGreater(everything["colours"], 500)
        self.click("show-views")
        without_views = self.look()
        self.assertLess(without_views["drawn"], everything["drawn"] - 500)
        self.click("show-unknown")
        self.assertGreater(self.look()["drawn"], without_views["drawn"] + 500)
        self.click("show-unknown")
        self.click("show-seen")
        self.assertLess(self.look()["colours"], without_views["colours"] / 2)  # the grid is left
        self.assert_quiet()

    def test_colours_by_what_is_chosen(self):
        self.open(self.page)
        self.assertIn("uncertainty", self.text("ramp-name"))
        by_uncertainty = self.look()
        self.browser.find_element(By.CSS_SELECTOR, "[value=height]").click()
        self.assertIn("height", self.text("ramp-name"))
        self.assertNotEqual(self.look()["colours"], by_uncertainty["colours"])
        self.run_script(
            "const cut = page.element('cut'); cut.value = 100; cut.dispatchEvent(new Event('input'))")
        self.assertIn(" m", self.text("cut-height"))
        self.assertLess(self.look()["drawn"], by_uncertainty["drawn"])
        self.assert_quiet()

    def test_tells_the_answer(self):
        self.open(self.page)
        with open(self.answer, encoding="utf-8") as file:
            answer = json.load(file)
        self.assertIn(f"{answer['gain']:.1f}", self.text("answer"))
        self.assertIn(f"{answer['tilt']:.3f} rad", self.text("answer"))
        self.assertIn(answer["message"], self.text("why"))
        self.assert_quiet()

    def test_shows_what_each_voxel_gains(self):
        self.open(self.page)
        colours = self.look()["colours"]
        self.click("show-gains")
        self.assertNotEqual(self.look()["colours"], colours)
        # The pointer goes through the middle of the chosen view, from where the camera is.
        self.browser.find_element(By.TAG_NAME, "body").send_keys("c")
        scene = self.browser.find_element(By.ID, "scene")
        x = 316 // 2  # what the panel covers
        ActionChains(self.browser).move_to_element_with_offset(scene, x, 0).perform()
        self.wait_until(lambda: self.text("tip") != "")
        self.assertRegex(self.text("tip"), r"^gain \d+\.\d\d of at most .*\nfrom the unknown$")
        self.assert_quiet()

    def test_tells_by_which_gain_or_why_not(self):
        for gain, told in (("occlusion_aware", "by the gain occlusion_aware"),
                           ("average_entropy", "the gain average_entropy is no sum over voxels: "
                                               "none has a part in it")):
            page = f"{self.folder.name}/{gain}.html"
            run_cli("view", OFFICE, "--answer", self.answer, "--gain", gain, "-o", page)
            self.open(f"file://{page}")
            self.assertEqual(self.text("voxel-gains-facts"), told)
            self.assertEqual(self.browser.find_element(By.ID, "show-gains").is_enabled(),
                             told.startswith("by"))
            self.assert_quiet()

    def test_folds_its_settings_where_the_window_is_narrow(self):
        self.browser.set_window_size(500, 800)
        self.addCleanup(self.browser.set_window_size, 1000, 800)
        self.open(self.page)
        settings = self.browser.find_element(By.ID, "show-seen")
        self.assertFalse(settings.is_displayed())
        self.click("fold")
        self.assertTrue(settings.is_displayed())
        self.assert_quiet()

    def test_tells_the_gain_under_the_pointer(self):
        self.open(self.page)
        self.assertRegex(self.text("landscape-value"), r"^gain 0.0 \(dark\) to \d+\.\d;")
        landscape = self.browser.find_element(By.ID, "landscape-map")
        before = self.look()
        ActionChains(self.browser).move_to_element_with_offset(landscape, 60, 10).perform()
        self.assertRegex(self.text("landscape-value"),
                         r"^pan \d+\.\d\d, tilt -?\d+\.\d\d rad: gain \d+\.\d$")
        self.assertGreater(self.look()["drawn"], before["drawn"])  # such a view is outlined
        self.assert_quiet()

    def test_draws_the_mast_where_its_pan_axis_stands(self):
        robot = pathlib.Path(self.folder.name, "robot.yaml")
        robot.write_text("mast: {pan_axis_x_m: 0.5, pan_axis_y_m: -0.25}\n", encoding="utf-8")
        answer, page = f"{self.folder.name}/beside.json", f"{self.folder.name}/beside.html"
        run_cli("query", OFFICE, *QUERY, "--robot", str(robot), "--json-out", answer)
        run_cli("view", OFFICE, "--answer", answer, "--robot", str(robot), "-o", page)
        self.open(f"file://{page}")
        # The mast's foot and the camera of this mast, which has no offset, stand above one another.
        beside_m = self.run_script("""
          const {current} = page.data.answer;
          const foot = views.mastOn(current.T_map_base).elements;
          return Math.hypot(...[12, 13].map(i => foot[i] - current.T_map_sensor[i]));""")
        self.assertLess(beside_m, 1e-9)
        before = self.look()
        landscape = self.browser.find_element(By.ID, "landscape-map")
        ActionChains(self.browser).move_to_element_with_offset(landscape, 60, 10).perform()
        self.assertGreater(self.look()["drawn"], before["drawn"])  # such a view is outlined
        self.assert_quiet()

    def test_goes_through_an_episode(self):
        captures = [{"time_s": 0.5 * i, "base": [1.9, 2.6, 0, 1.57], "pan": 0.7 * i, "tilt": 0,
                     "height": 0.4, "information": 100 * (i + 1), "predicted_gain": None,
                     "realised_gain": None} for i in range(3)]
        metrics = pathlib.Path(self.folder.name, "metrics.jsonl")
        metrics.write_text("".join(json.dumps(c) + "\n" for c in captures), encoding="utf-8")
        page = f"{self.folder.name}/episode.html"
        run_cli("view", OFFICE, "--episode", str(metrics), "-o", page)
        self.open(f"file://{page}")
        self.click("show-drive")
        self.assertIn("capture 3 of 3, 1.0 s: information 300", self.text("capture-facts"))
        drawn = [self.look()["drawn"]]
        slider = self.browser.find_element(By.ID, "capture")
        for number in (2, 1):
            slider.send_keys(Keys.ARROW_LEFT)
            self.assertIn(f"capture {number} of 3", self.text("capture-facts"))
            drawn.append(self.look()["drawn"])
        self.assertGreater(drawn[0], drawn[1] + 50)  # the map was smaller
        self.assertGreater(drawn[1], drawn[2] + 50)
        self.click("play")
        self.wait_until(lambda: "capture 3 of 3" in self.text("capture-facts"))
        self.assert_quiet()

    def test_runs_no_text(self):
        with open(self.answer, encoding="utf-8") as file:
            answer = json.load(file)
        answer["message"] = HOSTILE
        # Folders of a path: the name holds what ends an element.
        folder = pathlib.Path(self.folder.name, HOSTILE)
        folder.mkdir(parents=True)
        shutil.copy(OFFICE, folder / "map.ot")
        answer_file = folder / "answer.json"
        answer_file.write_text(json.dumps(answer), encoding="utf-8")
        page = f"{self.folder.name}/hostile.html"
        run_cli("view", str(folder / "map.ot"), "--answer", str(answer_file), "-o", page)
        self.open(f"file://{page}")
        self.assertIn(HOSTILE, self.text("why"))
        self.assert_ran_nothing_of(HOSTILE)
        self.assert_quiet()
        # Were a text to become markup after all, the policy would keep it from running.
        self.run_script(
            "const script = document.createElement('script'); script.textContent = 'window.hacked = 1';"
            "document.body.append(script)")
        self.assert_ran_nothing_of("a script that was added")


if __name__ == "__main__":
    unittest.main()
