#!/usr/bin/env python3
"""Time and peak memory of reading worlds at sizes 1, 10, 100, 1,000.

    bench/measure_worlds.py NBVOPT

Makes worlds of its own in a temporary folder and prints a table of `nbvopt world info`, which
reads a world and looks for floors in it. The shortest of three runs counts.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

MODELS = 30


def link(shape):
    visual = f"<visual name='v'><geometry>{shape}</geometry></visual>"
    return f"<link name='l'>{visual}</link>"


def box(size):
    return f"<box><size>{size}</size></box>"


def place(i):
    return f"<pose>{i % 50} {3 + i // 50} 0.5 0 0 0</pose>"


def model(name, body):
    return f"<model name='{name}'>{body}</model>"


def boxes(i):
    return model(f"m{i}", place(i) + link(box("0.2 0.2 1")))


def includes(i):
    return f"<include><uri>model://crate</uri><name>m{i}</name>{place(i)}</include>"


def write_world(file, one, count):
    ground = model("ground", link(box("60 60 0.02")))
    body = "".join(one(i) for i in range(count))
    file.write_text(f"<sdf version='1.6'><world name='w'>{ground}{body}</world></sdf>")


def measure(nbvopt, world):
    start = time.monotonic()
    command = [nbvopt, "world", "info", str(world), "--no-cache"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command}: failed")
    return time.monotonic() - start, usage.ru_maxrss / 1024


def main(nbvopt):
    sizes = [1, 10, 100, 1000]
    print("| | " + " | ".join(f"{size:,}" for size in sizes) + " |")
    print("| --- |" + " ---: |" * len(sizes))
    with tempfile.TemporaryDirectory() as folder:
        world = pathlib.Path(folder) / "a.world"
        crate = world.parent / "models" / "crate" / "model.sdf"
        crate.parent.mkdir(parents=True)
        crate.write_text(f"<sdf version='1.6'>{model('crate', link(box('0.2 0.2 1')))}</sdf>")
        for name, one in {"boxes": boxes, "includes of one model": includes}.items():
            cells = []
            for size in sizes:
                write_world(world, one, MODELS * size)
                kilobytes = world.stat().st_size / 1000
                seconds, megabytes = min(measure(nbvopt, world) for _ in range(3))
                cells.append(f"{kilobytes:,.0f} kB: {seconds:.2f} s, {megabytes:.0f} MB")
            print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
