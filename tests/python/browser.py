"""Pages of nbvopt in a real browser, headless and without a graphics card."""

import shutil
import tempfile
import unittest

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    webdriver = None

HOSTILE = "</script><script>window.hacked = 1</script><img src=x onerror='window.hacked = 1'>"

# What the picture shows: how many pixels are not of its most frequent colour, and how many colours
# there are. Read in the task that draws it, before the browser takes the picture.
LOOK = """
  page.drawNow();
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [320, 200];
  const brush = copy.getContext("2d");
  brush.drawImage(page.element("scene"), 0, 0, copy.width, copy.height);
  const pixels = new Uint32Array(brush.getImageData(0, 0, copy.width, copy.height).data.buffer);
  const counts = new Map();
  for (const p of pixels) counts.set(p, (counts.get(p) || 0) + 1);
  return {drawn: pixels.length - Math.max(...counts.values()), colours: counts.size};
"""


@unittest.skipUnless(webdriver and shutil.which("chromium") and shutil.which("chromedriver"),
                     "needs chromium, chromium-driver and python3-selenium")
class BrowserTest(unittest.TestCase):
    """`browser`, and `folder` for files, which last as long as the class."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for argument in ("--headless", "--no-sandbox", "--disable-quic", "--no-first-run",
                         "--disable-background-networking", "--disable-component-update",
                         "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader",
                         "--enable-unsafe-swiftshader", "--window-size=1000,800",
                         f"--user-data-dir={cls.folder.name}/profile"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(options=options,
                                       service=Service(shutil.which("chromedriver")))

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    def open(self, url: str) -> None:
        self.browser.get_log("browser")  # what earlier pages left there
        self.browser.get(url)
        self.wait_until(lambda: self.run_script("return !!page.isReady && page.pictures > 0"))

    def wait_until(self, is_so, seconds: float = 60) -> None:
        WebDriverWait(self.browser, seconds, 0.05).until(lambda _: is_so())

    def run_script(self, script: str):
        return self.browser.execute_script(script)

    def look(self) -> dict:
        return self.run_script(LOOK)

    def click(self, name: str) -> None:
        self.browser.find_element(By.ID, name).click()

    def text(self, name: str) -> str:
        return self.browser.find_element(By.ID, name).text

    def assert_quiet(self) -> None:
        """No error and no warning in the console."""
        self.assertEqual(self.browser.get_log("browser"), [])

    def assert_ran_nothing_of(self, hostile: str) -> None:
        self.assertNotIn("hacked", self.run_script("return Object.keys(window)"), hostile)
        self.assertEqual(self.browser.find_elements(By.TAG_NAME, "img"), [])
