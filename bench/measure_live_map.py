#!/usr/bin/env python3
"""What the live page costs on large maps: bytes and time from a scan to the page, and what four
readers cost scans and plans.

    PYTHONPATH=BUILD/python /usr/bin/python3 bench/measure_live_map.py NBVOPT[,OLDER] [ROUNDS [PLOTS ...]]

A simulated robot maps its room beneath hills of 10^4, 10^5 and 10^6 occupied voxels (1, 10 and 100
plots of measure_view.py). In Chromium, drawing in software at 1280 x 800, a round lasts from the call that
sends a scan until the page has drawn it; how much of that the page takes is told by what the scan
and its plan take with nobody watching. Then two servers take the same scans and plans in turns, one
of them read by four. Medians count.
"""

import pathlib
import statistics
import sys
import tempfile
import time

from measure_live_page import Driver, Reader, Served
from measure_view import PLOT, map_file, open_browser

READERS = 4
SENT = """return performance.getEntriesByType("resource").filter(r => /\\/map/.test(r.name))
  .map(r => r.encodedBodySize)"""


def wait_for(browser, version: int) -> None:
    """Until the page shows this version of the map."""
    script = "return page.isReady && page.pictures > 0 && page.element('live').textContent"
    while not str(browser.execute_script(script)).startswith(f"live: map version {version},"):
        time.sleep(0.005)
    browser.execute_script("page.drawNow()")


def measure_page(nbvopt: str, browser, path: pathlib.Path, rounds: int) -> str:
    with Served(nbvopt, str(path)) as served:
        start = time.perf_counter()
        browser.get(f"http://{served.web}/")
        wait_for(browser, 1)
        opened_s = time.perf_counter() - start
        first = browser.execute_script(SENT)[0]
        driver = Driver(served.address)
        scans_s, sent = [], []
        for i in range(rounds):
            before = len(browser.execute_script(SENT))
            start = time.perf_counter()
            driver.turn()
            wait_for(browser, i + 2)
            scans_s.append(time.perf_counter() - start)
            sent.append(sum(browser.execute_script(SENT)[before:]))
        return (f"{first / 1e6:.2f} MB | {opened_s:.1f} s | {statistics.median(sent) / 1e3:.0f} kB | "
                f"{1e3 * statistics.median(scans_s):.0f} ms")


def measure_server(nbvopt: str, path: pathlib.Path, rounds: int) -> str:
    with Served(nbvopt, str(path)) as alone, Served(nbvopt, str(path)) as watched:
        pages = [Reader(watched.web) for _ in range(READERS)]
        while any(page.maps.value == 0 for page in pages):
            time.sleep(0.05)
        drivers = [Driver(alone.address), Driver(watched.address)]
        for i in range(rounds):
            for driver in drivers if i % 2 == 0 else drivers[::-1]:
                driver.turn()
        for page in pages:
            page.terminate()
        cells = []
        for name in ("scans_s", "plans_s"):
            cells += [f"{1e3 * statistics.median(getattr(driver, name)):.1f}" for driver in drivers]
        return " | ".join(cells)


def main(programs: str, rounds: int = 12, *plots: int) -> None:
    print("| program | hills, voxels | first sent | opened in | sent a scan | scan to page | scan alone, ms "
          "| read by four | plan alone, ms | read by four |")
    print("| --- |" + " ---: |" * 9)
    with tempfile.TemporaryDirectory() as folder:
        browser = open_browser(f"{folder}/profile")
        browser.set_script_timeout(300)
        try:
            for count in plots or (1, 10, 100):
                path = pathlib.Path(folder, "map.ot")
                path.write_bytes(map_file(count))
                for nbvopt in programs.split(","):
                    page = measure_page(nbvopt, browser, path, rounds)
                    browser.get("about:blank")
                    print(f"| {pathlib.Path(nbvopt).name} | {count * PLOT * PLOT:,} | {page} | "
                          f"{measure_server(nbvopt, path, rounds)} |", flush=True)
        finally:
            browser.quit()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], *map(int, sys.argv[2:]))
