"""A robot looks around a simulated office, without a server: capture, insert, plan, move.

    PYTHONPATH=BUILD/python python3 explore.py datasets/office.world [STEPS]
"""

import sys

import numpy as np

import nbvopt

STEP_S = 1.0  # how long the joints move, and the base drives, between two looks
START = (0.617, 0.713, 0.0)  # x, y, yaw: the west end of the corridor


def look_around(world: nbvopt.World, steps: int) -> float:
    """The information in the map (Eq. 11) after so many looks."""
    robot, joints = nbvopt.Robot(), (0.0, 0.0, 0.4)
    planner = nbvopt.Planner(nbvopt.Map(resolution_m=0.1), robot)
    time_s, *columns = nbvopt.explore(world, START, duration_max_s=steps * STEP_S).trajectory.T
    for step in range(steps):
        base = [np.interp(step * STEP_S, time_s, column) for column in columns]  # x, y, z, yaw
        (T_map_sensor,) = nbvopt.sensor_poses(robot, base, [joints])
        points, no_returns = world.capture(robot, T_map_sensor)
        seen = planner.insert(points, T_map_sensor, no_returns=no_returns)
        look = planner.plan(base, joints, motion_time_s=STEP_S)
        print(
            f"step {step + 1}: gained {seen.information_gained:.1f}, next look at "
            "pan {:.2f} rad, tilt {:.2f} rad, height {:.2f} m".format(*look.joints)
        )
        joints = look.joints
    return planner.map.counts().information


if __name__ == "__main__":
    looks = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    print(f"the map holds {look_around(nbvopt.World(sys.argv[1]), looks):.1f}")
