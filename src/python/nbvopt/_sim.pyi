# The types of the simulator's module; its docstrings tell shapes, units and errors.
import os
from collections.abc import Sequence
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from nbvopt._core import Map, Robot

_Path = Union[str, os.PathLike[str]]

class Drive:
    def __init__(self, path: _Path) -> None: ...
    def save(self, path: _Path) -> None: ...
    @property
    def trajectory(self) -> npt.NDArray[np.float64]: ...
    @property
    def status(self) -> Optional[str]: ...
    @property
    def duration_s(self) -> float: ...
    @property
    def length_m(self) -> float: ...

class Episode:
    @property
    def captures(self) -> dict[str, npt.NDArray[Any]]: ...
    @property
    def summary(self) -> dict[str, Any]: ...
    @property
    def map(self) -> Map: ...
    @property
    def drive(self) -> Drive: ...
    def plot(self, path: Optional[_Path] = None) -> Optional[bytes]: ...

class World:
    def __init__(
        self,
        path: _Path,
        *,
        model_paths: Sequence[_Path] = ...,
        geometry: str = "visual",
        strict: bool = False,
        unit_m: float = 1.0,
        cache: Union[bool, _Path] = True,
    ) -> None: ...
    def capture(
        self,
        robot: Robot,
        T_map_sensor: npt.ArrayLike,
        *,
        frame: int = 0,
        range_noise_m: float = 0.0,
        seed: int = 1,
    ) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]: ...
    @property
    def bounds_m(self) -> npt.NDArray[np.float64]: ...

def explore(
    world: Union[World, _Path],
    start: npt.ArrayLike,
    *,
    goals: Optional[npt.ArrayLike] = None,
    lidar_range_m: float = 4.0,
    duration_max_s: float = 7200.0,
    seed: int = 1,
    region: Optional[npt.ArrayLike] = None,
) -> Drive: ...
def simulate(
    world: Union[World, _Path],
    *,
    start: Optional[npt.ArrayLike] = None,
    goals: Optional[npt.ArrayLike] = None,
    trajectory: Optional[Union[Drive, _Path]] = None,
    lidar_range_m: float = 4.0,
    duration_max_s: float = 7200.0,
    mode: str = "auto",
    motion_time_s: float = 0.5,
    joints: npt.ArrayLike = (0.0, 0.0, 0.4),
    robot: Robot = ...,
    capture_hz: Optional[float] = None,
    charge_computing: bool = False,
    range_noise_m: float = 0.0,
    resolution_m: float = 0.1,
    seed: int = 1,
    region: Optional[npt.ArrayLike] = None,
    pose_source: str = "truth",
    odometry_noise: float = 1.0,
    score_map: bool = False,
    people: bool = True,
) -> Episode: ...
