"""A simulated robot: a base that drives in circles through a room, and a depth camera on a mast.

It stands in for a real robot's driver. Frames, units and kinematics are those of the planning
server with its built-in robot (the paper's platform), so that plans can be followed as they come.
"""

from __future__ import annotations

import math
from typing import Tuple

import numpy as np

from nbvopt_client import Intrinsics

# Boxes as (min, max) corners in the map, metres. The room is seen from inside.
ROOM = ((0.0, 0.0, 0.0), (6.0, 5.0, 2.5))
OBSTACLES = (
    ((2.7, 2.2, 0.0), (3.3, 2.8, 2.5)),  # a pillar, which the base circles
    ((0.0, 0.0, 0.0), (0.9, 1.6, 0.75)),  # a desk
    ((5.6, 1.5, 0.0), (6.0, 3.5, 1.8)),  # a shelf
    ((0.3, 4.5, 0.0), (1.5, 5.0, 1.1)),  # a cupboard
    ((4.6, 4.2, 0.0), (5.2, 4.8, 0.45)),  # a stool
)

WIDTH_PX, HEIGHT_PX = 480, 360
FIELD_OF_VIEW_RAD = np.radians((59.0, 46.0))  # from edge to edge
RANGE_MIN_M, RANGE_MAX_M = 0.5, 4.0  # from the optical centre
NOTHING_IN_RANGE = 65535

JOINT_SPEED = np.array((math.pi, 0.5, 0.15))  # pan rad/s, tilt rad/s, height m/s
JOINT_MIN = np.array((-np.inf, -0.79, 0.18))  # pan turns without end
JOINT_MAX = np.array((np.inf, 0.79, 0.63))

CIRCLE_CENTRE_M = np.array((3.0, 2.5))
CIRCLE_RADIUS_M = 1.4
BASE_SPEED_M_S = 0.25

# Optical axes (z forward, x right, y down) to body axes (x forward, y left, z up).
R_BODY_SENSOR = np.array(((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)))


class SimulatedRobot:
    """Starts on its circle with the camera at rest: level, ahead, and half way up."""

    def __init__(self) -> None:
        self._angle_rad = -math.pi / 2  # on the circle, from the map's x axis
        self._joints = np.array((0.0, 0.0, 0.4))

    @property
    def base(self) -> Tuple[float, float, float]:
        """(x, y, yaw) in the map: on the circle, heading along it."""
        offset = CIRCLE_RADIUS_M * np.array((math.cos(self._angle_rad), math.sin(self._angle_rad)))
        x_m, y_m = CIRCLE_CENTRE_M + offset
        return float(x_m), float(y_m), self._angle_rad + math.pi / 2

    @property
    def base_twist(self) -> Tuple[float, float, float]:
        """(vx, vy, wz) in the base's own frame, which never changes on a circle."""
        return BASE_SPEED_M_S, 0.0, BASE_SPEED_M_S / CIRCLE_RADIUS_M

    @property
    def joints(self) -> Tuple[float, float, float]:
        """(pan, tilt, height); pan is not wrapped."""
        return tuple(self._joints.tolist())

    @property
    def intrinsics(self) -> Intrinsics:
        """A pinhole whose field of view ends at the outer edges of the outermost pixels."""
        fx_px, fy_px = (WIDTH_PX, HEIGHT_PX) / (2.0 * np.tan(FIELD_OF_VIEW_RAD / 2.0))
        return Intrinsics(float(fx_px), float(fy_px), (WIDTH_PX - 1) / 2, (HEIGHT_PX - 1) / 2)

    @property
    def T_map_sensor(self) -> np.ndarray:
        """4 x 4, the camera's optical frame in the map."""
        x_m, y_m, yaw_rad = self.base
        pan_rad, tilt_rad, height_m = self._joints
        T = np.eye(4)
        # Positive tilt looks up, a positive turn about body y (left) looks down.
        T[:3, :3] = _turn_z(yaw_rad) @ _turn_z(pan_rad) @ _turn_y(-tilt_rad) @ R_BODY_SENSOR
        T[:3, 3] = x_m, y_m, height_m  # the mast stands upright on the base
        return T

    def look(self) -> np.ndarray:
        """A depth image: (360, 480) uint16, millimetres along the optical axis.

        0 is a pixel that is too near to be known, 65535 one with nothing in range.
        """
        T = self.T_map_sensor
        rays_sensor = _pixel_rays(self.intrinsics)
        # Rays have length 1 along the optical axis, so that what is along them is depth.
        depth_m = _first_hit(T[:3, 3], rays_sensor @ T[:3, :3].T)
        distance_m = depth_m * np.linalg.norm(rays_sensor, axis=-1)
        depth_mm = np.rint(1000.0 * depth_m).astype(np.uint16)
        depth_mm[distance_m > RANGE_MAX_M] = NOTHING_IN_RANGE
        depth_mm[distance_m < RANGE_MIN_M] = 0
        return depth_mm

    def move(self, joints, seconds: float) -> None:
        """Moves the joints towards a plan's `joints`, and drives on, for so long."""
        target = np.array((joints.pan_rad, joints.tilt_rad, joints.height_m))
        reach = JOINT_SPEED * seconds
        way = np.clip(target - self._joints, -reach, reach)
        self._joints = np.clip(self._joints + way, JOINT_MIN, JOINT_MAX)
        self._angle_rad += BASE_SPEED_M_S / CIRCLE_RADIUS_M * seconds


def _turn_y(angle_rad: float) -> np.ndarray:
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array(((c, 0.0, s), (0.0, 1.0, 0.0), (-s, 0.0, c)))


def _turn_z(angle_rad: float) -> np.ndarray:
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))


def _pixel_rays(camera: Intrinsics) -> np.ndarray:
    """(height, width, 3): a ray through each pixel's centre, in the sensor frame, with z = 1."""
    u, v = np.meshgrid(np.arange(WIDTH_PX), np.arange(HEIGHT_PX))
    x = (u - camera.cx_px) / camera.fx_px
    y = (v - camera.cy_px) / camera.fy_px
    return np.stack((x, y, np.ones_like(x)), axis=-1)


def _first_hit(origin: np.ndarray, rays: np.ndarray) -> np.ndarray:
    """How many of its own lengths each ray (..., 3) goes until it meets the room or an obstacle."""
    hit = _crossing(origin, rays, ROOM)[1]
    for box in OBSTACLES:
        enter, leave = _crossing(origin, rays, box)
        hits = (enter <= leave) & (enter >= 0.0)
        hit = np.where(hits, np.minimum(hit, enter), hit)
    return hit


def _crossing(origin: np.ndarray, rays: np.ndarray, box) -> Tuple[np.ndarray, np.ndarray]:
    """Where the rays enter and leave a box; those that miss it leave before they enter."""
    with np.errstate(divide="ignore"):  # a ray along a face crosses it at infinity
        to_min, to_max = ((np.array(corner) - origin) / rays for corner in box)
    enter = np.minimum(to_min, to_max).max(axis=-1)
    leave = np.maximum(to_min, to_max).min(axis=-1)
    return enter, leave
