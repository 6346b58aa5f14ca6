#!/bin/bash
# Tries the packages of `make deb` on a bare Debian 12: installs them with what they depend on, asks
# the README's query, and removes them, which must leave nothing. Needs root, debootstrap and
# Debian's archive; takes minutes, most of them for downloads.
#
#     packaging/try_packages.sh [PACKAGES_DIR [WORK_DIR]]
#
# A WORK_DIR that is named is kept, and its bare system used again.
set -euo pipefail
cd "$(dirname "$0")/.."
packages=${1:-build/deb/packages}
work=${2:-$(mktemp -d)}
mirror=${MIRROR:-http://deb.debian.org/debian}
root=$work/root

clean_up() {
  mountpoint -q "$root/proc" && umount "$root/proc"
  rm -rf "$root"
  [ -n "${named:-}" ] || rm -rf "$work"
}
named=${2:-}
trap clean_up EXIT

inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive "$@"
}
install() { inside apt-get install -qq -y --no-install-recommends "$@" >>"$work/apt.log" 2>&1; }
# All files but users', apt's and dpkg's own books and what programs keep to be faster.
files() {
  inside find / -xdev -not -path '/proc/*' -not -path '/packages*' -not -path '/var/lib/apt/*' \
    -not -path '/var/lib/dpkg/*' -not -path '/var/cache/*' -not -path '/var/log/*' \
    -not -path '/tmp/*' -not -path '/root/*' -not -path '*/__pycache__*' | sort
}
say() { echo "$SECONDS s: $*"; }

mkdir -p "$work"
if [ ! -d "$work/bare" ]; then
  debootstrap --variant=minbase bookworm "$work/bare.partial" "$mirror" >"$work/debootstrap.log"
  mv "$work/bare.partial" "$work/bare"
fi
rm -rf "$root"
cp -a "$work/bare" "$root"
mount -t proc proc "$root/proc"
echo 127.0.0.1 localhost >"$root/etc/hosts"  # roslaunch looks for it
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages"
inside apt-get update -qq
names=$(inside sh -c 'for f in /packages/*.deb; do dpkg-deb -f $f Package; done')
has_ros() { grep -qx nbvopt-ros <<<"$names"; }  # where roscpp was installed when they were built
say "a bare Debian $(cat "$root/etc/debian_version") stands"

# What they depend on comes first and stays, so that the files before and after can be compared.
inside sh -c 'for f in /packages/*.deb; do dpkg-deb -f $f Depends; done' |
  tr ',\n' '\n\n' | sed 's/(.*//;s/|.*//;s/ //g;/^$/d' | sort -u >"$work/depends"
# shellcheck disable=SC2046
install man-db $(has_ros && echo python3-rosservice) $(cat "$work/depends")
files >"$work/before"
say "their $(wc -l <"$work/depends") dependencies are installed"

inside sh -c 'dpkg -i /packages/*.deb' >>"$work/apt.log"
# shellcheck disable=SC2086
say "installed: $(inside dpkg-query -W -f '${Package} ${Version}, ${Installed-Size} kB; ' $names)"
datasets=/usr/share/nbvopt/datasets
inside nbvopt query $datasets/office_partial.ot --base 1.9,2.6,1.57 --pan 0 --tilt 0 --height 0.4 \
  --motion-time 1 --plot /tmp/view.png | grep '^look    pan 2.093 rad'
test -s "$root/tmp/view.png"
inside nbvopt robot show $datasets/robots/lift.urdf --camera-link camera_link | grep '^height'
inside nbvopt simulate $datasets/office.world --start 0.62,0.71,0 --duration-max 2 --no-progress \
  --motion-time 0.5 --metrics /tmp/office.jsonl >/dev/null
inside python3 -c "import nbvopt
office = nbvopt.Map('$datasets/office_partial.ot')
look = nbvopt.Planner(office).plan((1.9, 2.6, 1.57), (0.0, 0.0, 0.4), motion_time_s=1.0)
assert abs(look.joints[0] - 2.093) < 1e-3, look.joints
nbvopt.World('$datasets/office.world')"
inside man nbvopt-map-build | grep -q 'nbvopt map build'
inside test -e /lib/systemd/system/nbvopt.service
say "query, robot, simulation, Python, manual: as they should be"

# A master, the node and a simulated robot. The first calls may come before the robot has told where
# it is.
if has_ros; then
  cat >"$root/tmp/try_ros.sh" <<EOF
set -e
export ROS_MASTER_URI=http://127.0.0.1:11397 ROS_IP=127.0.0.1
nbvopt simulate $datasets/office.world --start 0.62,0.71,0 --duration-max 5 --explore-only \
  --no-progress --trajectory-out /tmp/drive.csv >/dev/null
roslaunch -p 11397 nbvopt simulation.launch world:=$datasets/office.world \
  trajectory:=/tmp/drive.csv >/tmp/ros.log 2>&1 &
launch=\$!
trap 'kill -INT \$launch; wait \$launch || true' EXIT
for try in \$(seq 60); do
  sleep 1
  rosservice call /optimize_current_pose "time: 0.5" >/tmp/answer 2>&1 || continue
  if grep -q 'success: True' /tmp/answer; then exit 0; fi
done
cat /tmp/answer /tmp/ros.log
exit 1
EOF
  inside bash /tmp/try_ros.sh
  say "the ROS node moved the camera: $(grep ^pan "$root/tmp/answer")"
fi

# shellcheck disable=SC2086
inside apt-get remove -qq -y $names >>"$work/apt.log" 2>&1
files >"$work/after"
diff "$work/before" "$work/after"
say "removed, nothing is left"

if [ -n "${WITH_CONSUMER:-}" ]; then  # a compiler and all that is recommended: a gigabyte
  install g++ cmake ninja-build
  inside sh -c 'apt-get install -qq -y /packages/libnbvopt-dev_*.deb' >>"$work/apt.log" 2>&1
  cp -r examples/consumer "$root/root/consumer"
  inside sh -c 'cmake -S /root/consumer -B /root/build -G Ninja -DCOMPONENTS="planner;sim;client" &&
    cmake --build /root/build && /root/build/planner_consumer && /root/build/sim_consumer' \
    >>"$work/apt.log"
  say "a C++ project finds, builds and runs the library"
fi
