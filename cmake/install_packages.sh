#!/bin/sh
# Installs the Debian packages that the given lists name (one a line, # starts a comment); those
# that are installed are left alone, and nothing is asked or printed when none is missing.
set -eu

if ! command -v dpkg-query >/dev/null; then
  echo "Not a Debian system: install the equivalents of the packages in $* yourself." >&2
  exit 0
fi

missing=""
for package in $(sed 's/#.*//' "$@"); do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=""
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  echo "Packages are missing and there is no sudo; as root, run: apt-get install$missing" >&2
  exit 1
fi

echo "Installing$missing"
$as_root apt-get update -qq
$as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -qq -y --no-install-recommends $missing >/dev/null
