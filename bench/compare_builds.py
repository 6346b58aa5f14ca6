#!/usr/bin/env python3
"""Do two builds of nbvopt give the same bytes?

    bench/compare_builds.py OLD_NBVOPT NEW_NBVOPT

runs both programs on the same questions and compares all that they print and write, and how they
exit. Times that were measured are masked; every other byte counts. One line a check, the counts
last; the exit code is 1 where anything differs. For refactorings, in which nothing may change.
"""

import argparse
import json
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import zlib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable, Optional

PROJECT = Path(__file__).resolve().parent.parent
OFFICE_MAP = PROJECT / "datasets" / "office_partial.ot"
OFFICE_WORLD = PROJECT / "datasets" / "office.world"
TIMEOUT_S = 900

# What a clock said, in the order in which the patterns are applied.
TIMES = [
    # JSON: keys in ms but for limits that were asked for; a list or an object of times as a whole.
    (re.compile(r'("(?!time_limit_ms")\w*_ms"\s*:\s*)(?:\[[^\]]*\]|\{[^}]*\}|[-+.\deE]+)'), r"\1#"),
    (re.compile(r'("rays_per_second"\s*:\s*)[-+.\deE]+'), r"\1#"),
    # Text for people.
    (re.compile(r"^(?:.*\r)?\S.*? +\d+ %  \[[#.]{20}\].*\n", re.M), ""),  # a bar of progress
    (re.compile(r"^computing: .*$", re.M), lambda line: re.sub(r"\d+(\.\d+)?", "#", line[0])),
    (re.compile(r"\b\d+(\.\d+)? ms\b"), "# ms"),
    (re.compile(r"(\bunits in )\d+(\.\d+)? s\b"), r"\1# s"),
    (re.compile(r"(\bbusy for )\d+(\.\d+)? %"), r"\1# %"),
    # The server's log.
    (re.compile(r"^\d{4}-\d\d-\d\dT\S+", re.M), "#"),
    (re.compile(r"(\b\w*_ms=)\S+"), r"\1#"),
]
TIMED_FILES = {".json", ".jsonl", ".log"}
# The rows of a query's picture with the line that says how long the search took.
TIMED_PICTURE, TIMED_ROWS = "view.png", slice(100, 136)


@dataclass
class Check:
    """Commands that are run one after the other in a folder of their own."""

    name: str
    commands: list
    exit_code: int = 0  # of the last command; the others must succeed
    stdin: str = ""
    prepare: Optional[Callable[[Path], None]] = None  # fills the folder
    is_timed: bool = True  # its outputs hold times
    server: Optional[list] = None  # runs beside the commands, until SIGTERM
    needs: Optional[Path] = None  # skipped where this is missing


@dataclass
class Outcome:
    """All that is compared, by the name of the output."""

    outputs: dict = field(default_factory=dict)
    fault: str = ""  # why the check says nothing


class Build:
    def __init__(self, name: str, program: Path, folder: Path):
        self.program = program
        self.checks = 0
        self.folder = folder / name
        self.environment = {
            **os.environ,
            "XDG_CACHE_HOME": str(folder / f"{name}-cache"),
            "LC_ALL": "C.UTF-8",
        }

    def run(self, check: Check) -> Outcome:
        self.checks += 1
        folder = self.folder / f"{self.checks:03} {check.name.replace('/', '_')[:80]}"
        folder.mkdir(parents=True)
        if check.prepare:
            check.prepare(folder)
        if not check.server:
            return self.run_commands(check, folder)
        with open(folder / "server.log", "wb") as log:
            server = subprocess.Popen(
                [self.program, *check.server],
                cwd=folder,
                env=self.environment,
                stdout=subprocess.PIPE,
                stderr=log,
            )
            try:
                ready = server.stdout.readline()
                if ready:
                    outcome = self.run_commands(check, folder)
                    server.send_signal(signal.SIGTERM)
                else:
                    outcome = Outcome(fault="does not start its server")
                code = server.wait(TIMEOUT_S)
            finally:
                server.kill()  # if need be
        outcome.outputs["server, exit code"] = str(code).encode()
        self.gather_files(check, folder, outcome)
        return outcome

    def run_commands(self, check: Check, folder: Path) -> Outcome:
        outcome = Outcome()
        for number, command in enumerate(check.commands, 1):
            is_last = number == len(check.commands)
            try:
                done = subprocess.run(
                    [self.program, *map(str, command)],
                    cwd=folder,
                    env=self.environment,
                    input=check.stdin.encode(),
                    capture_output=True,
                    timeout=TIMEOUT_S,
                )
            except subprocess.TimeoutExpired:
                return Outcome(fault=f"takes more than {TIMEOUT_S} s for command {number}")
            expected = check.exit_code if is_last else 0
            if done.returncode != expected and not outcome.fault:
                error = done.stderr.decode(errors="replace").strip()[:200]
                outcome.fault = f"exits with {done.returncode}, not {expected}: {error}"
            prefix = f"command {number}, " if len(check.commands) > 1 else ""
            outcome.outputs[prefix + "exit code"] = str(done.returncode).encode()
            outcome.outputs[prefix + "stdout"] = masked(done.stdout, check, folder)
            outcome.outputs[prefix + "stderr"] = masked(done.stderr, check, folder)
        self.gather_files(check, folder, outcome)
        return outcome

    @staticmethod
    def gather_files(check: Check, folder: Path, outcome: Outcome):
        for path in sorted(folder.rglob("*")):
            if not path.is_file():
                continue
            content = path.read_bytes()
            if path.suffix in TIMED_FILES:
                content = masked(content, check, folder)
            elif path.name == TIMED_PICTURE:
                try:
                    content = masked_picture(content)
                except (zlib.error, struct.error, LookupError) as error:
                    outcome.fault = outcome.fault or f"draws what is no picture: {error}"
            outcome.outputs[str(path.relative_to(folder))] = content


def masked(content: bytes, check: Check, folder: Path) -> bytes:
    """The text without the times and without the folder's name."""
    text = content.decode(errors="surrogateescape").replace(str(folder), "FOLDER")
    if check.is_timed:
        for pattern, replacement in TIMES:
            text = pattern.sub(replacement, text)
    return text.encode(errors="surrogateescape")


def masked_picture(png: bytes) -> bytes:
    """The picture's rows without those that show a time, as they are filtered in the file: a row is
    encoded by itself and the one above, so rows elsewhere do not depend on the masked ones."""
    chunks = []
    at = 8
    while at < len(png):
        (length,) = struct.unpack_from(">I", png, at)
        chunks.append((png[at + 4 : at + 8], png[at + 8 : at + 8 + length]))
        at += 12 + length
    header = chunks[0][1]
    width, height, bits, colour = struct.unpack_from(">IIBB", header)
    size = 1 + width * {2: 3, 6: 4}[colour] * bits // 8
    data = zlib.decompress(b"".join(body for kind, body in chunks if kind == b"IDAT"))
    rows = [data[i * size : (i + 1) * size] for i in range(height)]
    del rows[TIMED_ROWS]
    return header + b"".join(rows)


def difference(old: bytes, new: bytes) -> str:
    """Where two outputs part, with what stands there."""
    at = next((i for i, (a, b) in enumerate(zip(old, new)) if a != b), min(len(old), len(new)))
    around = [content[max(0, at - 30) : at + 30] for content in (old, new)]
    if any(b"\0" in part for part in around):
        return f"byte {at} of {len(old)} and {len(new)}"
    line = old.count(b"\n", 0, at) + 1
    shown = [repr(part.decode(errors="replace")) for part in around]
    return f"line {line}: {shown[0]} became {shown[1]}"


def first_difference(old: Outcome, new: Outcome) -> str:
    """Empty when all is equal."""
    for name, outcome in [("old", old), ("new", new)]:
        if outcome.fault:
            return f"{name} {outcome.fault}"
    for name, content in old.outputs.items():
        if name not in new.outputs:
            return f"{name} is missing"
        if content != new.outputs[name]:
            return f"{name}: {difference(content, new.outputs[name])}"
    more = [name for name in new.outputs if name not in old.outputs]
    return f"{more[0]} is new" if more else ""


# --- inputs ---------------------------------------------------------------------------------------

VIEWS = """{
  "sensor": {"range_max_m": 3.0},
  "cases": [
    {"base": {"x": 1.9, "y": 2.6, "yaw": 1.57}, "pan": 0, "tilt": -0.2, "height": 0.4},
    {"base": {"x": 1.9, "y": 2.6, "z": 0.1, "yaw": -2}, "pan": 3, "tilt": 0.5, "height": 1.4},
    {"position": [1.9, 2.6, 0.4], "orientation_xyzw": [-0.5, 0.5, -0.5, 0.5]}
  ]
}
"""

ROBOT = """sensor:
  range_max_m: 3
  counting: per_voxel
mast:
  height_max_m: 1.2
  sensor_offset_m: [0.05, 0, 0.03]
"""

SPEC = """study: small
maps: [office_partial.ot]
starts: {sampled: {count: 2, seed: 1}}
motion_times_s: [0.2, 0.5]
uncertainty_modes: [distance, both]
solvers:
  - solver: auto
  - {solver: random, name: at random}
budgets: {max_evaluations: [20, 60]}
"""

PLY_HEAD = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
"""
SCAN_PLY = PLY_HEAD + "end_header\n0 0 1\n0.1 0 1\n0 0.1 1.2\nnan 0 1\n"
COLOURED_PLY = (
    PLY_HEAD
    + "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
    + "0 0 1 255 0 0\n0.1 0 1 0 255 0\n0 0.1 1.2 0 0 255\n0.3 0.1 2 9 9 9\n"
)
SCAN_PCD = """VERSION .7
FIELDS x y z
SIZE 4 4 4
TYPE F F F
COUNT 1 1 1
WIDTH 3
HEIGHT 1
POINTS 3
DATA ascii
0 0 1
0.2 0 1.5
0.1 -0.1 2
"""


def depth_png(width: int, height: int) -> bytes:
    """A 16-bit depth image of a slanted wall, with a pixel not known and one without return."""
    rows = [[1000 + 20 * x + 5 * y for x in range(width)] for y in range(height)]
    rows[0][0], rows[0][1] = 0, 65535
    data = b"".join(b"\0" + struct.pack(f">{width}H", *row) for row in rows)

    def chunk(kind: bytes, body: bytes) -> bytes:
        checksum = struct.pack(">I", zlib.crc32(kind + body))
        return struct.pack(">I", len(body)) + kind + body + checksum

    header = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(data))
        + chunk(b"IEND", b"")
    )


def with_files(**contents):
    """Lays files into a check's folder; the last _ of a name stands for its dot."""

    def prepare(folder: Path):
        for name, content in contents.items():
            path = folder / ".".join(name.rsplit("_", 1))
            if isinstance(content, Path):
                shutil.copy(content, path)
            else:
                path.write_bytes(content if isinstance(content, bytes) else content.encode())

    return prepare


# --- checks ---------------------------------------------------------------------------------------

SITUATION = {"--base": "1.9,2.6,1.57", "--pan": "0", "--tilt": "0", "--height": "0.4"}
SITUATION["--motion-time"] = "1"


def query(more: str = "", map_file=OFFICE_MAP) -> list:
    """The README's query with these options more or instead."""
    words = more.split()
    options = {**SITUATION, **dict(zip(words[::2], words[1::2]))}
    return ["query", map_file, *(word for option in options.items() for word in option)]


def query_checks():
    yield Check("query", [query()])
    outputs = ["--json", "--json-out", "answer.json", "--trace", "trace.jsonl"]
    outputs += ["--landscape", "landscape.json", "--plot", "view.png"]
    yield Check("query, all outputs", [[*query(), *outputs]])
    yield Check("query --solver grid, all outputs", [[*query("--solver grid"), *outputs]])
    searches = [
        "--solver grid --step-pan 0.4 --step-tilt 0.25 --step-height 0.075",
        "--solver random --seed 7",
        "--solver random --seed 7 --max-evals 50 --threads 1",
        "--solver nlopt:direct-l",
        "--solver nlopt:crs2 --max-evals 200",
        "--solver nlopt:isres --max-evals 200",
        "--solver nlopt:esch --max-evals 200",
        "--solver nlopt:mlsl-lds --max-evals 200",
        "--solver nlopt:ags --max-evals 200",
        "--solver nlopt:bobyqa",
        "--solver nlopt:sbplx",
        "--solver nlopt:cobyla",
        "--global nlopt:crs2 --local ceres:lbfgs --polish nlopt:sbplx",
        "--global nlopt:stogo --local nlopt:slsqp --polish none",
        "--global none --local ceres:lm --polish nlopt:bobyqa",
        "--global random --local none --polish nlopt:cobyla --seed 3",
        "--global nlopt:mlsl-lds --local nlopt:mma",
        "--max-evals 1",
        "--max-evals 100",
        "--threads 1",
        "--counting per_voxel",
        "--counting per_voxel --solver grid",
        "--evaluator paper-code",
        "--evaluator paper-code --solver grid",
        "--evaluator paper-code --solver grid --step-tilt 0.25 --step-height 0.1",
        "--base-velocity 0.2,0,0.3",
        "--base-velocity 0.2,0,0.3 --solver grid",
        "--motion-time 0",
        "--motion-time 0.2 --tilt 0.795",
        "--min-gain 1e9",
        "--base 1.9,2.6,0.3,1.57 --pan 3 --height 0.63",
        "--base 100,100,0",
        "--robot robot.yaml",
        "--robot robot.yaml --base-velocity 0.1,-0.1,-0.4 --counting per_ray",
    ]
    for search in searches:
        prepare = with_files(robot_yaml=ROBOT)
        commands = [[*query(search), "--json", "--trace", "trace.jsonl"], query(search)]
        yield Check(f"query {search}", commands, prepare=prepare)
    carries_none = [["map", "convert", OFFICE_MAP, "office.bt"]]
    for more in ["", "--occupied-uncertainty 0.3"]:
        command = [*query(more, "office.bt"), "--json"]
        yield Check(f"query a .bt {more}".strip(), [*carries_none, command])


def evaluate_checks(shared: Path):
    for more in ["", "--evaluator paper-code", "--counting per_voxel", "--robot robot.yaml"]:
        yield Check(
            f"evaluate {more}".strip(),
            [["evaluate", OFFICE_MAP, "--poses", "views.json", *more.split()]],
            prepare=with_files(views_json=VIEWS, robot_yaml=ROBOT),
        )
    yield Check("evaluate -", [["evaluate", OFFICE_MAP, "--poses", "-"]], stdin=VIEWS)
    shipped = sorted((PROJECT / "datasets" / "oracle").glob("*.json"))
    names = ["ASLAM_lab.json", "apartment_partial.json", "warehouse_partial.json"]
    names += ["ASLAM_lab_optima.json", "apartment_partial_optima.json"]
    for oracle in [*shipped, *(shared / "oracle" / name for name in names)]:
        for evaluator in ["exact", "paper-code"]:
            name = f"evaluate {oracle.name} --evaluator {evaluator}"
            if not oracle.exists():
                yield Check(name, [], needs=oracle)
                continue
            map_name = json.loads(oracle.read_text())["map"]
            maps = [PROJECT / "datasets" / map_name, shared / "maps" / map_name]
            map_file = next((path for path in maps if path.exists()), maps[-1])
            command = ["evaluate", map_file, "--poses", oracle, "--evaluator", evaluator]
            yield Check(name, [command], needs=map_file)


def map_checks(shared: Path):
    for map_file in [OFFICE_MAP, shared / "maps" / "ASLAM_lab.bt"]:
        commands = [["map", "info", map_file], ["map", "info", map_file, "--json"]]
        yield Check(f"map info {map_file.name}", commands, needs=map_file)
    for out in ["o.ot", "o.bt", "o.ply", "o.ot --format colour-ot", "o.ply --json"]:
        yield Check(f"map convert {out}", [["map", "convert", OFFICE_MAP, *out.split()]])
    pose = ["--pose", "0,0,0.4,-0.5,0.5,-0.5,0.5"]
    scans = {
        "scan.ply": [],
        "coloured.ply": ["--robot", "robot.yaml"],
        "scan.pcd": [],
        "depth.png": ["--intrinsics", "40,40,15.5,11.5", "--depth-scale", "0.002"],
    }
    prepare = with_files(
        scan_ply=SCAN_PLY,
        coloured_ply=COLOURED_PLY,
        scan_pcd=SCAN_PCD,
        depth_png=depth_png(32, 24),
        robot_yaml=ROBOT,
        office_ot=OFFICE_MAP,
    )
    for scan, more in scans.items():
        insert = ["map", "insert", "new.ot", scan, *pose, *more]
        into_office = ["map", "insert", "office.ot", scan, *pose, *more, "--json"]
        commands = [[*insert, "--create", "0.05"], insert, [*into_office, "--out", "more.ot"]]
        yield Check(f"map insert {scan}", commands, prepare=prepare)


def simulate_checks(shared: Path):
    start = ["--start", "0.62,0.71,0", "--no-progress"]
    files = ["--metrics", "captures.jsonl", "--map-out", "map.ot", "--summary", "summary.json"]
    files += ["--plot", "episode.png"]
    world = ["simulate", OFFICE_WORLD]
    for mode in ["auto", "grid", "grid-3", "random", "static"]:
        own = ["--duration-max", "15", "--mode", mode, "--trajectory-out", "drive.csv"]
        yield Check(f"simulate --mode {mode}", [[*world, *start, *own, *files]])
    for source in ["odom", "slam"]:
        own = ["--duration-max", "8", "--pose-source", source]
        yield Check(f"simulate --pose-source {source}", [[*world, *start, *own, *files]])
    for explorer in ["3d", "nbv"]:
        own = ["--duration-max", "8", "--explore", explorer, "--explore-only"]
        own += ["--trajectory-out", "drive.csv"]
        yield Check(f"simulate --explore {explorer}", [[*world, *start, *own]])
    yield Check(
        "simulate, options",
        [
            [*world, *start, "--explore-only", "--duration-max", "10"]
            + ["--trajectory-out", "drive.csv", "--seed", "5"],
            [*world, "--trajectory", "drive.csv", "--capture-hz", "5", "--range-noise", "0.01"]
            + ["--seed", "9", "--motion-time", "1", "--resolution", "0.1", "--threads", "1"]
            + ["--robot", "robot.yaml", "--json", "--no-cache", "--no-progress", *files],
            [*world, *start, "--goal", "2,0.7", "--pan", "1", "--tilt", "-0.3", "--height", "0.5"]
            + ["--geometry", "collision", "--explore-only", "--json", "--summary", "goal.json"],
        ],
        prepare=with_files(robot_yaml=ROBOT),
    )
    apartment = shared / "worlds" / "apartment" / "worlds" / "small_house.world"
    own = ["--start", "0,0,0", "--no-progress", "--duration-max", "5", "--mode", "auto"]
    yield Check("simulate apartment", [["simulate", apartment, *own, *files]], needs=apartment)


def fix_times(folder: Path):
    """Puts times into the study's records that follow from its evaluations."""

    def cost_ms(evaluations: float, surrogate_evaluations: float) -> float:
        return 0.05 * evaluations + 0.003 * surrogate_evaluations

    for name in ["records.jsonl", "references.jsonl"]:
        records = [json.loads(line) for line in (folder / name).read_text().splitlines()]
        for record in records:
            surrogate = record.get("surrogate_evaluations", 0)
            record["times"]["search_ms"] = cost_ms(record["evaluations"], surrogate)
            progress = record.get("progress")
            if progress:
                exact = progress["exact_evaluations"]
                both = progress["evaluations"]
                record["times"]["progress_ms"] = [cost_ms(e, b - e) for e, b in zip(exact, both)]
        lines = [json.dumps(record) + "\n" for record in records]
        (folder / name).write_text("".join(lines))


def study_checks(old: Build):
    inputs = with_files(office_partial_ot=OFFICE_MAP, spec_yaml=SPEC)
    out = ["spec.yaml", "--out", "study", "--workers", "1"]
    run = [["study", kind, *out] for kind in ("run", "reference")]
    counts = [[*command, "--dry-run"] for command in run]
    yield Check("study run, reference", [*counts, *run, *run], prepare=inputs)

    # Times decide pictures and tables: both builds report on the same records.
    def prepare(folder: Path):
        inputs(folder)
        for command in run:
            subprocess.run(
                [old.program, *command],
                cwd=folder,
                env=old.environment,
                check=True,
                capture_output=True,
            )
        fix_times(folder / "study")

    yield Check("study report", [["study", "report", "study"]], prepare=prepare, is_timed=False)


def reproduce_checks(shared: Path):
    worlds = shared / "worlds"
    command = ["reproduce", "--worlds", worlds, "--environments", "simple_house", "--starts", "1"]
    command += ["--duration-max", "10", "--out", "reproduction", "--jobs", "1"]
    yield Check(
        "reproduce",
        [[*command, "--dry-run"], command, command],
        needs=worlds / "simple_house",
    )


def server_checks():
    def ask(more: str = "") -> list:
        return ["query", "--server", "unix:socket", *query(more)[2:]]

    commands = [ask()]
    for more in [
        "--solver grid",
        "--solver nlopt:crs2 --max-evals 200 --seed 7",
        "--base-velocity 0.2,0,0.3",
        "--height 3",
    ]:
        commands.append([*ask(more), "--json"])
    server = ["serve", str(OFFICE_MAP), "--listen", "unix:socket", "--snapshot", "snapshot.ot"]
    yield Check("serve and ask", commands, exit_code=3, server=server)


def error_checks():
    prepare = with_files(
        not_a_map_ot="nonsense",
        bad_yaml="sensor:\n  range_max: 3\n",
        bad_json='{"cases": [{"base": {"x": 1}}]}',
        torn_json='{"cases": [\n{"base": ',
        spec_yaml=SPEC.replace("budgets", "budget"),
        scan_ply=SCAN_PLY,
        office_partial_ot=OFFICE_MAP,
    )
    simulate = ["simulate", OFFICE_WORLD]
    for exit_code, command in [
        (2, []),
        (2, ["quarry"]),
        (2, ["query"]),
        (2, ["query", OFFICE_MAP, "--base", "1.9,2.6", "--motion-time", "1"]),
        (2, query("--evaluator none")),
        (2, query("--solver none")),
        (2, query("--solver nlopt:lbfgs")),
        (2, query("--solver grid --global nlopt:crs2")),
        (2, query("--max-evals many")),
        (2, query("--server unix:socket")),
        (3, query("--max-evals 0")),
        (3, query("--tilt 1.5")),
        (3, query("--step-pan -1")),
        (3, query("--motion-time -1")),
        (3, query("--plot /none/view.png")),
        (3, query("--robot bad.yaml")),
        (3, query(map_file="none.ot")),
        (3, query(map_file="not_a_map.ot")),
        (3, ["query", "--server", "unix:socket", *query()[2:]]),
        (2, ["evaluate", OFFICE_MAP]),
        (3, ["evaluate", OFFICE_MAP, "--poses", "bad.json"]),
        (3, ["evaluate", OFFICE_MAP, "--poses", "torn.json"]),
        (2, ["map"]),
        (2, ["map", "convert", OFFICE_MAP, "office.xyz"]),
        (3, ["map", "info", "none.ot"]),
        (3, ["map", "insert", "office_partial.ot", "scan.ply", "--pose", "0,0,0,0,0,0,0"]),
        (2, ["map", "insert", "office_partial.ot", "scan.ply", "--pose", "0,0,0"]),
        (2, simulate),
        (2, [*simulate, "--start", "0.62,0.71,0", "--explore-only", "--map-out", "map.ot"]),
        (3, [*simulate, "--start", "90,90,0"]),
        (2, [*simulate, "--start", "0.62,0.71,0", "--mode", "none"]),
        (3, [*simulate, "--start", "0.62,0.71,0", "--motion-time", "0"]),
        (3, ["simulate", "none.world", "--start", "0,0,0"]),
        (3, ["study", "run", "spec.yaml", "--out", "study"]),
        (3, ["study", "report", "none"]),
        (2, ["study", "run", "spec.yaml"]),
        (2, ["reproduce", "--worlds", "none", "--out", "o", "--environments", "none"]),
        (3, ["reproduce", "--worlds", "none", "--out", "o"]),
        (2, ["serve"]),
        (3, ["serve", "--create", "0"]),
    ]:
        words = " ".join(map(str, command)).replace(f"{PROJECT}/", "")
        words = words.replace(" ".join(query()[2:]), "...")
        yield Check(
            f"refuses nbvopt {words}".strip(),
            [command],
            exit_code=exit_code,
            prepare=prepare,
            is_timed=False,
        )


def help_checks():
    for words in [
        *["", "query", "evaluate", "simulate", "serve", "reproduce"],
        *["map", "map info", "map convert", "map insert", "map build"],
        *["study", "study run", "study reference", "study report", "study worker"],
    ]:
        yield Check(f"{words} --help".strip(), [[*words.split(), "--help"]], is_timed=False)
    yield Check("--version", [["--version"]], is_timed=False)


def all_checks(old: Build, shared: Path):
    yield from help_checks()
    yield from error_checks()
    yield from query_checks()
    yield from evaluate_checks(shared)
    yield from map_checks(shared)
    yield from server_checks()
    yield from study_checks(old)
    yield from simulate_checks(shared)
    yield from reproduce_checks(shared)


def compare(old: Build, new: Build, checks) -> dict:
    counts = {"equal": 0, "DIFFERS": 0, "skipped": 0}

    def tell(verdict: str, name: str, why: str = ""):
        counts[verdict] += 1
        print(f"{verdict:8} {name}" + (f": {why}" if why else ""), flush=True)

    with ThreadPoolExecutor(2) as both:
        for check in checks:
            if check.needs and not check.needs.exists():
                tell("skipped", check.name, f"{check.needs} is not here")
                continue
            outcomes = list(both.map(lambda build: build.run(check), (old, new)))
            why = first_difference(*outcomes)
            tell("DIFFERS" if why else "equal", check.name, why)
    return counts


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("old", type=Path, metavar="OLD_NBVOPT")
    parser.add_argument("new", type=Path, metavar="NEW_NBVOPT")
    parser.add_argument(
        "--shared",
        type=Path,
        default=PROJECT.parent / "shared",
        metavar="DIR",
        help="maps, known answers and worlds that do not ship [../shared]",
    )
    parser.add_argument("--only", default="", metavar="REGEX", help="checks whose name has this")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="keep what was written, in DIR")
    arguments = parser.parse_args()
    for program in (arguments.old, arguments.new):
        if not os.access(program, os.X_OK):
            parser.error(f"{program} is no program")

    with tempfile.TemporaryDirectory(prefix="nbvopt-builds-") as temporary:
        folder = arguments.keep.resolve() if arguments.keep else Path(temporary)
        old = Build("old", arguments.old.resolve(), folder)
        new = Build("new", arguments.new.resolve(), folder)
        checks = all_checks(old, arguments.shared.resolve())
        counts = compare(old, new, (c for c in checks if re.search(arguments.only, c.name)))
    print(f"{counts['equal']} equal, {counts['DIFFERS']} differ, {counts['skipped']} skipped")
    if counts["equal"] + counts["DIFFERS"] == 0:
        return 2  # nothing was compared
    return 1 if counts["DIFFERS"] else 0


if __name__ == "__main__":
    sys.exit(main())
