#!/bin/bash
# Runs the small study and reports it: tests/notebooks/small_study.sh NBVOPT OUT
set -euo pipefail
spec=$(dirname "$0")/small_study.yaml
for command in run reference; do "$1" study $command "$spec" --out "$2"; done
"$1" study report "$2"
