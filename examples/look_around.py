"""Asks the ROS node, again and again, to look where the most is to be learnt.

    look_around.py [SECONDS [MOTION_TIME]]

Prints a line a look, and at the end how long the answers took.
"""

import sys

import rospy
from octomap_msgs.srv import GetValue
from reconstruction_3d_planner.srv import OptimizeCurrentPose


def look_around(seconds: float, motion_time_s: float) -> None:
    rospy.wait_for_service("/optimize_current_pose")
    look = rospy.ServiceProxy("/optimize_current_pose", OptimizeCurrentPose)
    map_info = rospy.ServiceProxy("/octomap_server/get_map_info", GetValue)
    begin = rospy.get_time()
    looks, failures, answered_ms = 0, 0, []
    while (now := rospy.get_time()) - begin < seconds and not rospy.is_shutdown():
        answer = look(motion_time_s)
        if not answer.success:
            # Until the robot has told where it is.
            failures += 1
            print(f"not yet: {answer.message}" if looks == 0 else answer.message)
            rospy.sleep(0.5)
            continue
        looks += 1
        answered_ms.append(1e3 * (rospy.get_time() - now))
        print(
            f"{now - begin:6.1f} s: pan {answer.pan:6.2f} rad, height "
            f"{answer.pose.position.z:.2f} m, the map holds {map_info().value:.0f}; {answer.message}"
        )
    if answered_ms:
        answered_ms.sort()
        print(
            f"{looks} looks in {seconds:.0f} s, {failures} failed; answered after "
            f"{answered_ms[len(answered_ms) // 2]:.0f} ms (median), {answered_ms[-1]:.0f} ms at most"
        )


if __name__ == "__main__":
    rospy.init_node("look_around", anonymous=True)
    look_around(
        float(sys.argv[1]) if len(sys.argv) > 1 else 60.0,
        float(sys.argv[2]) if len(sys.argv) > 2 else 0.5,
    )
