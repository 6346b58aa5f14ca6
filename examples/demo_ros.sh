#!/bin/bash
# The ROS node moves the camera of a simulated robot that drives through the office that ships, and
# the map's information grows. `make demo-ros` builds what it needs.
#
#     examples/demo_ros.sh BUILD OUT [SECONDS [roslaunch's arguments]]
#
# With `rviz:=true` the map is to be seen in RViz, where that is installed, without the ceiling.
set -euo pipefail
build=$(realpath "$1") out=$(realpath "$2") seconds=${3:-60}
root=$(realpath "$(dirname "$0")/..")
shift $(($# < 3 ? $# : 3))

export ROS_PACKAGE_PATH=$build/ros/share PYTHONPATH=$build/ros/python
export ROS_HOME=${ROS_HOME:-$out/ros} ROS_MASTER_URI=${ROS_MASTER_URI:-http://127.0.0.1:11399}
export ROS_IP=${ROS_IP:-127.0.0.1}

drive=$out/office_drive.csv
"$build/cli/nbvopt" simulate "$root/datasets/office.world" --start 0.62,0.71,0 \
  --duration-max "$seconds" --explore-only --trajectory-out "$drive"
roslaunch -p "${ROS_MASTER_URI##*:}" nbvopt simulation.launch \
  world:="$root/datasets/office.world" trajectory:="$drive" occupancy_max_z:=2.4 "$@" >"$out/demo_ros.log" 2>&1 &
launch=$!
trap 'kill -INT $launch; wait $launch || true' EXIT
/usr/bin/python3 "$root/examples/look_around.py" "$seconds"
