# What the package has once the library is loaded; without the simulator, the names of _sim are not
# there.
from typing import Any

import numpy.typing as npt

from nbvopt._core import InsertResult as InsertResult
from nbvopt._core import Landscape as Landscape
from nbvopt._core import Map as Map
from nbvopt._core import MapCounts as MapCounts
from nbvopt._core import MapSlice as MapSlice
from nbvopt._core import Planner as Planner
from nbvopt._core import PlanResult as PlanResult
from nbvopt._core import Robot as Robot
from nbvopt._core import Surrogate as Surrogate
from nbvopt._core import __version__ as __version__
from nbvopt._core import sensor_poses as sensor_poses
from nbvopt._sim import Drive as Drive
from nbvopt._sim import Episode as Episode
from nbvopt._sim import World as World
from nbvopt._sim import explore as explore
from nbvopt._sim import simulate as simulate

def query(
    map: Map,
    robot: Robot,
    base: npt.ArrayLike,
    joints: npt.ArrayLike,
    motion_time_s: float,
    *,
    evaluator: str = "exact",
    **search: Any,
) -> PlanResult: ...
