#!/usr/bin/env python3
"""Time and peak memory of reading and of exporting maps, at sizes 1, 10, 100.

    bench/measure_maps.py NBVOPT

Makes maps of its own in a temporary folder and prints a table: a reader's row is `nbvopt map info`,
an exporter's `nbvopt map convert` of the .bt, each from its start to its end. The shortest of three
runs counts.
"""
import gzip
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import time

BLOCK_LEVELS = 5  # of 32 voxels an edge
UNKNOWN, FREE, OCCUPIED, INNER = range(4)
LOG_ODDS = {FREE: -0.4, OCCUPIED: 0.85}


def block(rng, levels):
    """A node as nested tuples: INNER and its children, or a leaf's state. The wildest of maps:
    wherever a child is a leaf, its state is drawn."""
    if levels == 0:
        return rng.choice((UNKNOWN, FREE, FREE, OCCUPIED))
    inner = 0.7 if levels > 1 else 1.0
    children = tuple(
        block(rng, levels - 1) if rng.random() < inner else rng.choice((UNKNOWN, FREE))
        for _ in range(8)
    )
    return (INNER, children) if any(children) else UNKNOWN


def tree(nodes):
    """Blocks beside each other, at one corner of the lattice."""
    for _ in range(16 - BLOCK_LEVELS):
        eights = (nodes[i : i + 8] for i in range(0, len(nodes), 8))
        nodes = [(INNER, tuple(eight + [UNKNOWN] * (8 - len(eight)))) for eight in eights]
    return nodes[0]


def state(node):
    return node[0] if isinstance(node, tuple) else node


def binary_nodes(node, out):
    out.append(struct.pack("<H", sum(state(child) << 2 * i for i, child in enumerate(node[1]))))
    for child in node[1]:
        if state(child) == INNER:
            binary_nodes(child, out)


def full_nodes(node, values, out):
    """Appends the nodes and returns the log-odds of the first, an inner node's being the largest
    of its children's."""
    if state(node) != INNER:
        out.append(struct.pack("<f", LOG_ODDS[node]) + values + b"\0")
        return LOG_ODDS[node]
    at = len(out)
    out.append(b"")
    known = [(i, child) for i, child in enumerate(node[1]) if state(child) != UNKNOWN]
    largest = max(full_nodes(child, values, out) for _, child in known)
    out[at] = struct.pack("<f", largest) + values + bytes([sum(1 << i for i, _ in known)])
    return largest


def nodes_of(node):
    return 1 + sum(nodes_of(child) for child in node[1] if child) if state(node) == INNER else 1


def write_maps(folder, root):
    """The map in every format. Returns how many nodes it has."""
    count = nodes_of(root)
    lines = f"size {count}\nres 0.05\ndata\n"
    out = []
    binary_nodes(root, out)
    data = b"".join(out)
    (folder / "message.bin").write_bytes(data)
    data = f"# Octomap OcTree binary file\nid OcTree\n{lines}".encode() + data
    (folder / "a.bt").write_bytes(data)
    (folder / "a.bt.gz").write_bytes(gzip.compress(data))
    for name, values in {
        "OcTree": b"",
        "ColorOcTree": b"rgb",
        "UncertaintyOcTree": b"rgb" + struct.pack("<f", 0.5),
        "OtherTree": b"stamp",
    }.items():
        out = []
        full_nodes(root, values, out)
        data = f"# Octomap OcTree file\nid {name}\n{lines}".encode() + b"".join(out)
        (folder / f"{name}.ot").write_bytes(data)
    return count


def measure(folder, *command):
    start = time.monotonic()
    process = subprocess.Popen(
        command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command}: failed")
    return time.monotonic() - start, usage.ru_maxrss / 1024


READERS = {
    ".bt": ["a.bt"],
    ".bt, gzip": ["a.bt.gz"],
    "message, binary": ["message.bin", "--message", "OcTree,0.05,binary"],
    ".ot, OcTree": ["OcTree.ot"],
    ".ot, ColorOcTree": ["ColorOcTree.ot"],
    ".ot, UncertaintyOcTree": ["UncertaintyOcTree.ot"],
    ".ot, a type that is not known": ["OtherTree.ot"],
}
EXPORTERS = {
    "to .bt": ["out.bt"],
    "to .ot": ["out.ot"],
    "to colour-ot": ["colour.ot", "--format", "colour-ot"],
    "to .ply": ["out.ply"],
    "to .ply, all points": ["all.ply", "--all-points"],
    "to .pcd": ["out.pcd"],
    "to .pgm and .yaml": ["out.pgm"],
}


def main(nbvopt):
    rng = random.Random(1)
    blocks = [block(rng, BLOCK_LEVELS) for _ in range(100)]
    commands = {name: ["info", *words] for name, words in READERS.items()}
    commands |= {name: ["convert", "a.bt", *words] for name, words in EXPORTERS.items()}
    cells = {name: [] for name in commands}
    sizes = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for count in (1, 10, 100):
            sizes.append(write_maps(folder, tree(blocks[:count])))
            for name, words in commands.items():
                runs = [measure(folder, nbvopt, "map", *words) for _ in range(3)]
                seconds, megabytes = min(runs)
                cells[name].append(f"{seconds:.2f} s, {megabytes:.0f} MB")
    print("| nodes | " + " | ".join(f"{size:,}" for size in sizes) + " |")
    print("| --- |" + " ---: |" * len(sizes))
    for name, row in cells.items():
        print(f"| {name} | " + " | ".join(row) + " |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(str(pathlib.Path(sys.argv[1]).resolve()))
