#!/bin/sh
# Makes the site of the documentation in build/docs/site. Any warning is an error.
set -eu
cd "$(dirname "$0")/../.."
root=$PWD
out=build/docs
pages=$out/pages

rm -rf "$out"
mkdir -p "$pages"

# The pages are those of the repository, in the same places, with the files that they link to.
for path in README.md LICENSE docs datasets examples notebooks \
            packaging/nbvopt.service.in src/protocol/nbvopt/v1/planner.proto \
            src/ros1/package/config/paper_robot.yaml; do
  mkdir -p "$pages/$(dirname "$path")"
  ln -s "$root/$path" "$pages/$path"
done
ln -s "$root/docs/site/style.css" "$pages/style.css"

doxygen docs/site/Doxyfile
/usr/bin/python3 docs/site/reference.py "$out/xml" include "$pages/reference"
mkdocs build --config-file docs/site/mkdocs.yml
echo "The site is in $out/site/index.html"
