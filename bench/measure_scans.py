#!/usr/bin/env python3
"""Time and peak memory of reading scans and of building maps from recordings, at sizes 1, 10, 100.

    bench/measure_scans.py NBVOPT

Makes files of its own in a temporary folder and prints a table: a reader's rows are
`nbvopt map insert` into a new map, of which the insertion itself is a part that is told.
"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from functools import partial

POSE = "0,0,0,-0.5,0.5,-0.5,0.5"
CAMERA = "500,500,319.5,239.5"


def run(*command):
    """(seconds, peak megabytes, what was answered) of a command that must succeed."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen([str(word) for word in command], stdout=out)
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.monotonic() - start
        if status != 0:
            sys.exit(f"{command}: failed")
        out.seek(0)
        return seconds, usage.ru_maxrss / 1024, json.load(out)


def point(i):
    """A point of a wall that leans: all of them lie in few voxels."""
    return (i % 997) / 997 - 0.5, (i % 991) / 991 - 0.5, 1.5 + (i % 983) / 983


def encode_points(encode, count):
    return encode([point(i) for i in range(count)])


def ply_header(form, count):
    lines = ["ply", f"format {form} 1.0", f"element vertex {count}"]
    return "\n".join([*lines, *(f"property float {axis}" for axis in "xyz"), "end_header", ""])


def pcd_header(form, count):
    return (
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {count}\nHEIGHT 1\nPOINTS {count}\nDATA {form}\n"
    )


def text(points):
    return "".join(f"{x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points).encode()


def floats(points, order="<"):
    return b"".join(struct.pack(order + "3f", *p) for p in points)


def lzf_literals(data):
    """LZF that compresses nothing."""
    pieces = (data[i : i + 32] for i in range(0, len(data), 32))
    return b"".join(bytes([len(piece) - 1]) + piece for piece in pieces)


def compressed(points):
    columns = b"".join(struct.pack(f"<{len(points)}f", *column) for column in zip(*points))
    packed = lzf_literals(columns)
    return struct.pack("<2I", len(packed), len(columns)) + packed


def depths(width, height):
    return [1500 + (7 * i) % 1000 for i in range(width * height)]


def png(width, height):
    pixels = depths(width, height)
    rows = (pixels[row * width : (row + 1) * width] for row in range(height))
    raw = b"".join(b"\0" + struct.pack(f">{width}H", *row) for row in rows)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    head = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    data = zlib.compress(raw, 1)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def pgm(width, height):
    pixels = depths(width, height)
    return f"P5\n{width} {height}\n65535\n".encode() + struct.pack(f">{len(pixels)}H", *pixels)


CLOUDS = {
    "PLY, ascii": ("ply", lambda p: ply_header("ascii", len(p)).encode() + text(p)),
    "PLY, little-endian": (
        "ply",
        lambda p: ply_header("binary_little_endian", len(p)).encode() + floats(p),
    ),
    "PLY, big-endian": (
        "ply",
        lambda p: ply_header("binary_big_endian", len(p)).encode() + floats(p, ">"),
    ),
    "PCD, ascii": ("pcd", lambda p: pcd_header("ascii", len(p)).encode() + text(p)),
    "PCD, binary": ("pcd", lambda p: pcd_header("binary", len(p)).encode() + floats(p)),
    "PCD, compressed": (
        "pcd",
        lambda p: pcd_header("binary_compressed", len(p)).encode() + compressed(p),
    ),
    "XYZ text": ("xyz", text),
}
IMAGES = {"PNG": png, "PGM": pgm}


def write_apart(file, content):
    """Writes what content() gives in a process of its own: the peak memory of a child is told as at
    least what its parent has when it starts."""
    child = os.fork()
    if child == 0:
        file.write_bytes(content())
        os._exit(0)
    if os.waitpid(child, 0)[1] != 0:
        sys.exit(f"{file}: cannot be written")


def measure_insert(nbvopt, folder, name, content):
    scan = folder / name
    write_apart(scan, content)
    new_map = folder / "new.ot"
    new_map.unlink(missing_ok=True)
    seconds, megabytes, told = run(
        *(nbvopt, "map", "insert", new_map, scan, "--pose", POSE, "--create", "0.05"),
        *("--intrinsics", CAMERA, "--json"),
    )
    scan.unlink()
    inserting = told["insert_ms"] / 1000
    return f"{seconds - inserting:.2f} s + {inserting:.2f} s, {megabytes:.0f} MB"


def measure_build(nbvopt, folder, frames):
    recording = folder / f"recording{frames}"
    (recording / "depth").mkdir(parents=True)
    poses = ""
    image = png(640, 480)
    for i in range(frames):
        (recording / "depth" / f"{i}.png").write_bytes(image)
        poses += f"{i} {i % 10 * 0.02} 0 0 -0.5 0.5 -0.5 0.5\n"
    (recording / "groundtruth.txt").write_text(poses)
    seconds, megabytes, _ = run(
        *(nbvopt, "map", "build", recording, folder / f"built{frames}.ot", "--format", "tum"),
        *("--depth-scale", "0.001", "--json"),
    )
    return f"{seconds:.2f} s, {megabytes:.0f} MB"


def main():
    nbvopt = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def row(what, cells):
            print("| " + " | ".join([what, *cells]) + " |", flush=True)

        for what, (suffix, encode) in CLOUDS.items():
            cells = []
            for count in (30_000, 300_000, 3_000_000):
                content = partial(encode_points, encode, count)
                cells.append(measure_insert(nbvopt, folder, f"scan.{suffix}", content))
            row(what, cells)
        for what, encode in IMAGES.items():
            sizes = ((200, 150), (632, 475), (2000, 1500))
            contents = [partial(encode, *size) for size in sizes]
            row(what, [measure_insert(nbvopt, folder, "scan", content) for content in contents])
        row("`map build`", [measure_build(nbvopt, folder, n) for n in (3, 30, 300)])


if __name__ == "__main__":
    main()
