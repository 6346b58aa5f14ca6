#!/usr/bin/env python3
"""What the live page costs on large maps: bytes and time from a scan to the page, and what four
readers cost scans and plans.

    PYTHONPATH=BUILD/python /usr/bin/python3 bench/measure_live_map.py NBVOPT[,OLDER] [ROUNDS [PLOTS ...]]

A simulated robot maps its room beneath hills of 10^4, 10^5 and 10^6 occupied voxels (1, 10 and 100
plots of measure_view.py). Two servers take the same scans and plans in turns, one of them read by
four: what a reader is sent, and in the server's processor time, which a busy machine stretches less,
and in medians of milliseconds what readers cost. Then in Chromium, which draws in software at
1280 x 800, the median from the call that sends a scan, its plan included, until the page has drawn
it. More than one program is measured in turns.
"""

import os
import pathlib
import statistics
import sys
import tempfile
import time

from measure_live_page import Driver, Reader, Served
from measure_view import PLOT, map_file, open_browser

READERS = 4


def wait_for(browser, version: int) -> None:
    """Until the page shows this version of the map."""
    script = "return page.isReady && page.pictures > 0 && page.element('live').textContent"
    while not str(browser.execute_script(script)).startswith(f"live: map version {version},"):
        time.sleep(0.005)
    browser.execute_script("page.drawNow()")


def measure_page(nbvopt: str, browser, path: pathlib.Path, rounds: int) -> str:
    """How long a page takes to open, and a scan and a plan to come to it."""
    with Served(nbvopt, str(path)) as served:
        start = time.perf_counter()
        browser.get(f"http://{served.web}/")
        wait_for(browser, 1)
        opened_s = time.perf_counter() - start
        driver = Driver(served.address)
        rounds_s = []
        for i in range(rounds):
            start = time.perf_counter()
            driver.turn()
            wait_for(browser, i + 2)
            rounds_s.append(time.perf_counter() - start)
        browser.get("about:blank")
        return f"{opened_s:.1f} s | {1e3 * statistics.median(rounds_s):.0f} ms"


def processor_s(served: Served) -> float:
    """What its process has taken so far."""
    fields = pathlib.Path(f"/proc/{served.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def measure_server(nbvopt: str, path: pathlib.Path, rounds: int) -> str:
    """What readers are sent, and what that and their scans and plans take with them and without."""
    with Served(nbvopt, str(path)) as alone, Served(nbvopt, str(path)) as watched:
        pages = [Reader(watched.web) for _ in range(READERS)]
        while any(page.maps.value == 0 for page in pages):
            time.sleep(0.05)
        drivers = [Driver(alone.address), Driver(watched.address)]
        before_s = [processor_s(alone), processor_s(watched)]
        for i in range(rounds):
            for driver in drivers if i % 2 == 0 else drivers[::-1]:
                driver.turn()
        time.sleep(1)  # for what is under way
        taken_s = [processor_s(s) - before for s, before in zip((alone, watched), before_s)]
        first, sent = pages[0].first_bytes.value, pages[0].bytes.value
        for page in pages:
            page.terminate()
        cells = [f"{first / 1e6:.2f} MB", f"{(sent - first) / rounds / 1e3:.0f} kB"]
        cells += [f"{1e3 * s / rounds:.0f}" for s in taken_s]
        for name in ("scans_s", "plans_s"):
            cells += [f"{1e3 * statistics.median(getattr(driver, name)):.1f}" for driver in drivers]
        return " | ".join(cells)


def main(programs: str, rounds: int = 12, *plots: int) -> None:
    print("| program | hills, voxels | first sent | sent a scan | processor, ms a scan and plan "
          "| read by four | scan, ms | read by four | plan, ms | read by four | opened in "
          "| scan to page |")
    print("| --- |" + " ---: |" * 11)
    with tempfile.TemporaryDirectory() as folder:
        browser = open_browser(f"{folder}/profile")
        browser.set_script_timeout(300)
        try:
            for count in plots or (1, 10, 100):
                path = pathlib.Path(folder, "map.ot")
                path.write_bytes(map_file(count))
                for nbvopt in programs.split(","):
                    print(f"| {pathlib.Path(nbvopt).name} | {count * PLOT * PLOT:,} "
                          f"| {measure_server(nbvopt, path, rounds)} "
                          f"| {measure_page(nbvopt, browser, path, rounds)} |", flush=True)
        finally:
            browser.quit()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], *map(int, sys.argv[2:]))
