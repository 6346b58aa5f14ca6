#!/usr/bin/env python3
"""What views of the shipped map are worth, derived anew from the paper's equations.

    datasets/make_oracle.py datasets/office_partial.ot datasets/oracle out/optima/references.jsonl

writes the known answers of the tests in tests/oracle. It shares no line with nbvopt: it reads the
octree's bytes itself and does the plainest thing that the definitions allow, a ray and a voxel at a
time. datasets/README.md says what the files hold, and where the references come from.
"""

import json
import math
import struct
import sys
from pathlib import Path

ORIGIN = 1 << 15  # the key of the voxel that starts at 0
DEPTH = 16
FREE, OCCUPIED, UNKNOWN = "free", "occupied", "unknown"

RELEASED_CODE = {
    "focal_distance_m": 1.0,
    "half_fov_horizontal_rad": 0.5148721,
    "half_fov_vertical_rad": 0.401426,
    "horizontal_rays": 48,
    "range_axis": "z_depth",
    "range_max_m": 4.0,
    "range_min_m": 0.5,
    "uncertainty_half_fov_horizontal_rad": 0.52,
    "uncertainty_half_fov_vertical_rad": 0.41,
    "vertical_rays": 36,
}
EXACT = {
    "focal_distance_m": 1.0,
    "half_fov_horizontal_rad": math.radians(59 / 2),
    "half_fov_vertical_rad": math.radians(46 / 2),
    "horizontal_rays": 48,
    "near_blocking": True,
    "range_axis": "euclidean",
    "range_max_m": 4.0,
    "range_min_m": 0.5,
    "ray_pattern": "pixel_centres",
    "vertical_rays": 36,
}
PAN_GRID_STEP_RAD = 0.8
PAN_VELOCITY_RAD_S = math.pi

# Base x, y, yaw; pan, tilt, height. From the drive's start to its end, into what is known and what
# is not, up, down, from above the mast's reach, and from where nothing is known.
VIEWS = [
    (0.7, 0.7, 0.0, 0.0, 0.0, 0.4),
    (3.1, 0.8, 0.3, 1.9, 0.25, 0.63),
    (1.9, 1.4, 1.57, -0.6, -0.35, 0.5),
    (1.9, 2.6, 1.57, 0.0, 0.0, 0.4),
    (1.9, 2.6, 1.57, 2.07, 0.01, 0.54),
    (1.9, 2.6, 1.57, 0.45, -0.6, 0.2),
    (2.3, 4.1, 0.9, 0.3, 0.15, 1.2),
    (4.6, 5.2, -2.2, 0.2, -0.1, 0.35),
]


class Map:
    """The leaves of an octree file: per node the log-odds, three bytes of colour, the uncertainty,
    and a byte that says which children follow."""

    def __init__(self, path: Path):
        head, data = path.read_bytes().split(b"\ndata\n", 1)
        lines = head.decode().splitlines()
        words = dict(line.split(maxsplit=1) for line in lines if not line.startswith("#"))
        if words["id"] != "UncertaintyOcTree":
            raise SystemExit(f"{path}: no UncertaintyOcTree")
        self.resolution_m = float(words["res"])
        self.leaves = [{} for _ in range(DEPTH + 1)]  # by height above the finest voxels, and key
        self.read_node(data, 0, (0, 0, 0), DEPTH)

    def read_node(self, data: bytes, at: int, key: tuple, height: int) -> int:
        log_odds, uncertainty, children = struct.unpack_from("<f3xfB", data, at)
        at += 12
        if children == 0:
            self.leaves[height][key] = (OCCUPIED if log_odds >= 0 else FREE, uncertainty)
        for child in range(8):
            if children >> child & 1:
                child_key = tuple(2 * k + (child >> axis & 1) for axis, k in enumerate(key))
                at = self.read_node(data, at, child_key, height - 1)
        return at

    def voxel(self, key) -> tuple:
        """State and stored uncertainty of the leaf that covers a voxel."""
        for height, leaves in enumerate(self.leaves):
            leaf = leaves.get(tuple(k >> height for k in key)) if leaves else None
            if leaf:
                return leaf
        return UNKNOWN, 1.0

    def counts(self) -> dict:
        """At the finest resolution."""
        counts = {"occupied": 0, "free": 0, "certain": 0, "information": 0.0}
        for height, leaves in enumerate(self.leaves):
            for state, uncertainty in leaves.values():
                counts[state] += 8**height
                if state == OCCUPIED:
                    counts["certain"] += 8**height * (uncertainty < 1)
                    counts["information"] += 8**height * (1 - uncertainty)  # Equations (10), (11)
        return counts


def as_float(value: float) -> float:
    """Rounded to single precision, in which the released code looks points up."""
    return struct.unpack("f", struct.pack("f", value))[0]


def norm(p) -> float:
    return math.sqrt(sum(x * x for x in p))


def uncertainty(sensor: dict, p) -> float:
    """Of a point in the sensor's frame."""
    d_focal = abs(norm(p) - sensor["focal_distance_m"])  # (1)
    u_d = 1 - 2 / (1 + math.exp(d_focal))  # (2)
    u_alpha = 0.0
    for coordinate, axis in zip(p, ("horizontal", "vertical")):
        half = sensor.get(f"uncertainty_half_fov_{axis}_rad", sensor[f"half_fov_{axis}_rad"])
        alpha = math.atan(coordinate / p[2])  # (3), (4)
        u_alpha += min(1.0, abs(alpha) / half) / 2  # (5) to (7)
    return (u_d + u_alpha) / 2  # (8)


def gain(sensor: dict, state: str, u_old: float, p) -> float:
    """Equation (12), for the voxel that decides a ray, seen at a point in the sensor's frame."""
    u_new = uncertainty(sensor, p)
    return 1 - u_new if state == UNKNOWN else max(0.0, u_old - u_new)


def orientation(yaw: float, tilt: float) -> list:
    """Rotation of the optical frame in the map, a column an axis: x right, y down, z forward."""
    c, s = math.cos(yaw), math.sin(yaw)
    forward = (c * math.cos(tilt), s * math.cos(tilt), math.sin(tilt))
    right = (s, -c, 0.0)
    down = (c * math.sin(tilt), s * math.sin(tilt), -math.cos(tilt))
    return [list(row) for row in zip(right, down, forward)]


def rotated(rotation, p) -> list:
    return [sum(r * x for r, x in zip(row, p)) for row in rotation]


def quaternion_xyzw(rotation) -> list:
    """Of a rotation that is no half turn."""
    w = math.sqrt(1 + sum(rotation[i][i] for i in range(3))) / 2
    x = (rotation[2][1] - rotation[1][2]) / (4 * w)
    y = (rotation[0][2] - rotation[2][0]) / (4 * w)
    z = (rotation[1][0] - rotation[0][1]) / (4 * w)
    return [x, y, z, w]


def released_code_view(a_map: Map, position, rotation) -> tuple:
    """Gain and number of unknown rays as the released code has them: rays equally spaced in angle
    from edge to edge, sampled every voxel's length along the optical axis, one look-up a sample."""
    s = RELEASED_CODE
    total, unknown_rays = 0.0, 0
    for row in range(s["vertical_rays"]):
        for column in range(s["horizontal_rays"]):
            ray = released_code_ray(a_map, position, rotation, column, row)
            total += ray["gain"]
            unknown_rays += ray["state"] == UNKNOWN
    return total, unknown_rays


def released_code_ray(a_map: Map, position, rotation, column: int, row: int) -> dict:
    s = RELEASED_CODE
    alpha_h = s["half_fov_horizontal_rad"] * (2 * column / (s["horizontal_rays"] - 1) - 1)
    alpha_v = s["half_fov_vertical_rad"] * (2 * row / (s["vertical_rays"] - 1) - 1)
    sample = 0
    while (r := s["range_min_m"] + sample * a_map.resolution_m) < s["range_max_m"]:
        p = (r * math.tan(alpha_h), r * math.tan(alpha_v), r)
        p_map = [as_float(o + x) for o, x in zip(position, rotated(rotation, p))]
        key = [math.floor(x / a_map.resolution_m) + ORIGIN for x in p_map]
        state, u_old = a_map.voxel(key)
        if state != FREE:
            value = gain(s, state, u_old, p)
            return {"state": state, "sample": sample, "p_map": p_map, "u_old": u_old, "gain": value}
        sample += 1
    return {"state": FREE, "sample": sample, "gain": 0.0}


def exact_view_gain(a_map: Map, position, rotation) -> float:
    """The gain over rays through the pixels' centres that visit every voxel which they pierce."""
    s = EXACT
    total = 0.0
    for row in range(s["vertical_rays"]):
        y = math.tan(s["half_fov_vertical_rad"]) * (2 * (row + 0.5) / s["vertical_rays"] - 1)
        for column in range(s["horizontal_rays"]):
            x = math.tan(s["half_fov_horizontal_rad"])
            x *= 2 * (column + 0.5) / s["horizontal_rays"] - 1
            length = norm((x, y, 1))
            total += exact_ray_gain(a_map, position, rotation, (x / length, y / length, 1 / length))
    return total


def exact_ray_gain(a_map: Map, position, rotation, direction) -> float:
    """Of the first voxel that is not free, among those between all planes that the ray crosses."""
    range_min_m, range_max_m = EXACT["range_min_m"], EXACT["range_max_m"]
    start = [o / a_map.resolution_m for o in position]
    step = [d / a_map.resolution_m for d in rotated(rotation, direction)]
    crossings = [0.0, range_max_m]
    for o, d in zip(start, step):
        low, high = sorted((o, o + d * range_max_m))
        if d != 0:
            planes = range(math.ceil(low), math.floor(high) + 1)
            crossings += [(plane - o) / d for plane in planes]
    crossings.sort()
    for enter, leave in zip(crossings, crossings[1:]):
        middle = (enter + leave) / 2
        key = [math.floor(o + d * middle) + ORIGIN for o, d in zip(start, step)]
        state, u_old = a_map.voxel(key)
        if leave <= range_min_m:
            if state == OCCUPIED:
                return 0.0  # it blocks the ray
        elif state != FREE:
            at = max(enter, range_min_m)
            return gain(EXACT, state, u_old, [at * d for d in direction])
    return 0.0


def case_of(x, y, yaw, pan, tilt, height) -> dict:
    return {"base": {"x": x, "y": y, "yaw": yaw}, "pan": pan, "tilt": tilt, "height": height}


def view_case(a_map: Map, view) -> dict:
    x, y, yaw, pan, tilt, height = view
    position, rotation = [x, y, height], orientation(yaw + pan, tilt)
    value, unknown_rays = released_code_view(a_map, position, rotation)
    return {
        **case_of(*view),
        "position": position,
        "orientation_xyzw": quaternion_xyzw(rotation),
        "gain": value,
        "unknown_rays": unknown_rays,
    }


def optimum_case(a_map: Map, reference: dict) -> dict:
    """A question of the study, what staying and the pan grid are worth, and its best view."""
    x, y, z, yaw = reference["start"]["base"]
    pan, tilt, height = reference["start"]["joints"]
    time_s = reference["motion_time_s"]
    if z != 0:
        raise SystemExit("the base must stand on the floor, z = 0")

    def exact(pan, tilt, height) -> float:
        return exact_view_gain(a_map, [x, y, height], orientation(yaw + pan, tilt))

    reach = min(PAN_VELOCITY_RAD_S * time_s, math.pi)
    steps = math.floor(2 * reach / PAN_GRID_STEP_RAD + 1e-9)
    pans = [pan - reach + step * PAN_GRID_STEP_RAD for step in range(steps + 1)]
    current = exact(pan, tilt, height)
    return {
        **case_of(x, y, yaw, pan, tilt, height),
        "time_budget_s": time_s,
        "current_gain": current,
        "pan_grid_gain": max(current, *(exact(one, tilt, height) for one in pans)),
        "best": dict(zip(("pan", "tilt", "height"), reference["joints"])),
        "best_gain": exact(*reference["joints"]),
    }


def write(path: Path, content: dict):
    path.write_text(json.dumps(content, indent=1, sort_keys=True) + "\n")


def main(map_file: str, folder: str, reference_file: str):
    map_path, out = Path(map_file), Path(folder)
    a_map = Map(map_path)
    common = {"map": map_path.name, "resolution": a_map.resolution_m}
    views = [view_case(a_map, view) for view in VIEWS]
    write(
        out / f"{map_path.stem}.json",
        {**common, "counts": a_map.counts(), "sensor": RELEASED_CODE, "cases": views},
    )
    references = [json.loads(line) for line in Path(reference_file).read_text().splitlines()]
    references.sort(key=lambda reference: (reference["start_index"], reference["motion_time_s"]))
    optima = [optimum_case(a_map, reference) for reference in references]
    write(
        out / f"{map_path.stem}_optima.json",
        {**common, "pan_grid_step_rad": PAN_GRID_STEP_RAD, "sensor": EXACT, "cases": optima},
    )


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
