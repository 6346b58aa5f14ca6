#!/usr/bin/python3
"""Page size and frames a second of `nbvopt view` for maps of 10^4, 10^5 and 10^6 occupied voxels.

    bench/measure_view.py NBVOPT [MAP ...]

Makes maps of 1, 10 and 100 plots of rough hills at 0.05 m, 5 m wide, no two neighbouring voxels of
one uncertainty, under free space, in a temporary folder, and prints a table; maps that are given
are measured too. Needs
Chromium, chromium-driver and Selenium (packages-ci.txt); pictures are drawn in software at
1280 x 800 (SwiftShader), the eye turning about the map. The median of 7 pictures counts.
"""
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

PLOT = 100  # voxels wide
BLOCK_BITS = 7  # a plot stands in a block of 128 x 128 x 128 voxels, a branch of the octree
DRAW = """
  const gl = page.renderer.getContext(), pixel = new Uint8Array(4), times = [];
  for (let i = 0; i < 8; ++i) {
    page.turn(0.05);
    const start = performance.now();
    page.drawNow();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits for the picture
    times.push(performance.now() - start);
  }
  return times.slice(1).sort((a, b) => a - b)[3];
"""


def hill(x: int, y: int) -> int:
    """The height of the ground, voxels, with a bump on three columns of ten."""
    smooth = 64 + 12 * math.sin(x / 17) * math.cos(y / 23)
    return round(smooth) + (1 if (x * 7919 + y * 104729) % 10 < 3 else 0)


def plot() -> dict:
    """The voxels of a plot: u of each, none of free ones."""
    known = {}
    for x in range(PLOT):
        for y in range(PLOT):
            z = hill(x, y)
            known[x, y, z] = ((x * 31 + y * 17) % 97) / 100
            for above in range(z + 1, z + 4):
                known[x, y, above] = None
    return known


def node(children, value) -> bytes:
    u = 1.0 if value is None else value
    mask = sum(1 << i for i in children)
    return struct.pack("<f3BfB", -2.0 if value is None else 2.0, 255, 255, 255, u, mask)


def joined(level: dict, times: int) -> tuple[dict, int]:
    """The branches so many levels up of branches by their address, each (greatest u, bytes), and how
    many nodes that adds."""
    added = 0
    for _ in range(times):
        parents = {}
        for (x, y, z), child in level.items():
            place = x & 1 | (y & 1) << 1 | (z & 1) << 2
            parents.setdefault((x >> 1, y >> 1, z >> 1), {})[place] = child
        level = {}
        for key, children in parents.items():
            value = max((u for u, _ in children.values() if u is not None), default=None)
            level[key] = (value, node(children, value) + b"".join(children[i][1] for i in sorted(children)))
        added += len(level)
    return level, added


def map_file(plots: int) -> bytes:
    """An .ot of type UncertaintyOcTree of plots side by side."""
    leaves = {key: (u, node((), u)) for key, u in plot().items()}
    blocks, inner = joined(leaves, BLOCK_BITS)
    nodes = len(leaves) + inner
    middle = 1 << 15 - BLOCK_BITS
    side = math.ceil(math.sqrt(plots))
    level = {(middle + i % side, middle + i // side, middle): blocks[0, 0, 0] for i in range(plots)}
    level, added = joined(level, 16 - BLOCK_BITS)
    head = f"# Octomap OcTree file\nid UncertaintyOcTree\nsize {plots * nodes + added}\nres 0.05\ndata\n"
    return head.encode() + level[0, 0, 0][1]


def open_browser(profile: str):
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("--headless", "--no-sandbox", "--disable-quic", "--no-first-run",
                     "--disable-background-networking", "--disable-component-update", "--disable-sync",
                     "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--window-size=1280,800", f"--user-data-dir={profile}"):
        options.add_argument(argument)
    return webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))


def measure(nbvopt: str, browser, name: str, path: pathlib.Path, page: pathlib.Path) -> None:
    start = time.monotonic()
    told = subprocess.run([nbvopt, "view", path, "-o", page], check=True, capture_output=True, text=True).stdout
    made_s = time.monotonic() - start
    faces, rectangles = (told.split(": ")[-1].split()[i] for i in (0, 3))
    start = time.monotonic()
    browser.get(page.as_uri())
    WebDriverWait(browser, 300, 0.05).until(
        lambda b: b.execute_script("return !!page.isReady && page.pictures > 0"))
    ready_s = time.monotonic() - start
    picture_ms = browser.execute_script(DRAW)
    print(f"| {name} | {int(faces):,} | {int(rectangles):,} | {made_s:.2f} s | "
          f"{page.stat().st_size / 1e6:.1f} MB | {ready_s:.1f} s | {1e3 / picture_ms:.0f} |", flush=True)


def main(nbvopt: str, *maps: str) -> None:
    print("| map | faces | rectangles | made in | page | opened in | pictures a second |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        browser = open_browser(f"{folder}/profile")
        page = pathlib.Path(folder, "view.html")
        try:
            for plots in (1, 10, 100):
                path = pathlib.Path(folder, "map.ot")
                path.write_bytes(map_file(plots))
                measure(nbvopt, browser, f"hills, {plots * PLOT * PLOT:,} voxels", path, page)
            for path in maps:
                measure(nbvopt, browser, os.path.basename(path), pathlib.Path(path), page)
        finally:
            browser.quit()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
