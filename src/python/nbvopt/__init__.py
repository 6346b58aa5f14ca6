"""Where should the camera look next? The library nbvopt, in Python.

    import nbvopt

    office = nbvopt.Map("datasets/office_partial.ot")
    robot = nbvopt.Robot()  # the paper's
    answer = nbvopt.query(office, robot, (1.9, 2.6, 1.57), (0.0, 0.0, 0.4), motion_time_s=1.0)
    print(answer.joints, answer.gain)

Frames: map (z up), base (the robot, z up), sensor (optical: z forward, x right, y down). `T_a_b`
takes coordinates in frame b to frame a, as a 4 x 4 array. Metres, radians and seconds unless a name
says otherwise. A joint position q is (pan, tilt, height).

A file or a value that cannot be used raises ValueError, in one line that names it. Everything is
safe to share between threads; what takes time lets other threads run meanwhile.

`nbvopt.v1` holds the protocol of the planning server, see nbvopt_client.
"""

import importlib

__all__ = [
    "Evaluator",
    "Map",
    "MapCounts",
    "MapSlice",
    "PlanResult",
    "Robot",
    "Surrogate",
    "__version__",
    "query",
    "sensor_poses",
]


def __getattr__(name: str):
    """Loads the library when it is first used: who imports nbvopt.v1 only calls a server."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module("nbvopt._core"), name)


def __dir__() -> list:
    return __all__
