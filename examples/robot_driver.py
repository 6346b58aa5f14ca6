"""A robot looks around: it asks a planning server, again and again, where to look next.

    nbvopt serve --create 0.05 &
    python3 robot_driver.py 127.0.0.1:50051 [STEPS]
"""

import sys

from nbvopt_client import PlannerClient
from simulated_robot import SimulatedRobot

STEP_S = 1.0  # how long the joints move, and the base drives, between two looks


def drive(planner: PlannerClient, robot: SimulatedRobot, steps: int) -> None:
    for step in range(1, steps + 1):
        seen = planner.insert_depth_image(robot.look(), robot.intrinsics, robot.T_map_sensor)
        plan = planner.plan(
            robot.base, robot.joints, STEP_S, base_twist=robot.base_twist, time_limit_ms=500
        )
        robot.move(plan.joints, STEP_S)
        print(
            f"step {step}: gained {seen.information_gained:.1f} in map version {seen.map_version}, "
            f"next look at pan {plan.joints.pan_rad:.2f} rad, tilt {plan.joints.tilt_rad:.2f} rad, "
            f"height {plan.joints.height_m:.2f} m"
        )
    print(f"the map holds {planner.status(with_counts=True).counts.information:.1f}")


if __name__ == "__main__":
    address, steps = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 20
    with PlannerClient(address) as planner:
        drive(planner, SimulatedRobot(), steps)
