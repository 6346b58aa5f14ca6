"""Where should the camera look next? The library nbvopt, in Python.

    import nbvopt

    office = nbvopt.Map("datasets/office_partial.ot")
    planner = nbvopt.Planner(office)  # the paper's robot
    look = planner.plan((1.9, 2.6, 1.57), (0.0, 0.0, 0.4), motion_time_s=1.0)
    print(look.joints, look.gain)

Frames: map (z up), base (the robot, z up), sensor (optical: z forward, x right, y down). `T_a_b`
takes coordinates in frame b to frame a, as a 4 x 4 array. Metres, radians and seconds unless a name
says otherwise. A joint position q is (pan, tilt, height).

A file or a value that cannot be used raises ValueError, in one line that names it. Everything is
safe to share between threads; what takes time lets other threads run meanwhile.

`nbvopt.v1` holds the protocol of the planning server, see nbvopt_client.
"""

import importlib
import importlib.util

_CORE = [
    "InsertResult",
    "Landscape",
    "Map",
    "MapCounts",
    "MapSlice",
    "PlanResult",
    "Planner",
    "Robot",
    "Surrogate",
    "__version__",
    "sensor_poses",
]
_SIM = ["Drive", "Episode", "World", "explore", "simulate"]
_HAS_SIM = importlib.util.find_spec("nbvopt._sim") is not None

__all__ = sorted([*_CORE, "query", *(_SIM if _HAS_SIM else [])])


def query(map, robot, base, joints, motion_time_s, *, evaluator="exact", **search):
    """One plan of a planner that is not kept: Planner(map, robot, evaluator).plan(base, joints,
    motion_time_s, **search)."""
    planner = __getattr__("Planner")(map, robot, evaluator)
    return planner.plan(base, joints, motion_time_s, **search)


def __getattr__(name: str):
    """Loads the library when it is first used: who imports nbvopt.v1 only calls a server."""
    if name in _CORE:
        return getattr(importlib.import_module("nbvopt._core"), name)
    if name in _SIM and _HAS_SIM:
        return getattr(importlib.import_module("nbvopt._sim"), name)
    reason = ": it was built without the simulator" if name in _SIM else ""
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}{reason}")


def __dir__() -> list:
    return __all__
