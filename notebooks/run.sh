#!/bin/bash
# Runs a notebook without a screen: notebooks/run.sh NAME BUILD OUT
#
# NAME: of the notebook, such as 01_one_query. BUILD: a build with the Python module.
# OUT: the folder for its pictures and its copy with outputs.
# Exits with 77 where Debian's jupyter-nbconvert, its kernel or matplotlib is not installed.
set -euo pipefail
name=$1
mkdir -p "$3"
build=$(realpath "$2")
out=$(realpath "$3")
cd "$(dirname "$0")/.."
python=/usr/bin/python3 # the one that the module is built for

if ! $python -c 'import ipykernel, matplotlib, matplotlib_inline, nbconvert' 2>/dev/null; then
  echo "skipped: notebooks need jupyter-nbconvert, python3-ipykernel and python3-matplotlib"
  exit 77
fi

# The files that the notebook reads.
case $name in
  02_solver_study) # reads a report: the study of record's unless another is named
    NBVOPT_STUDY_REPORT=$(realpath "${NBVOPT_STUDY_REPORT:-docs/study/searches}")
    export NBVOPT_STUDY_REPORT
    ;;
  01_one_query | 03_surrogate) ;; # ask the module only
  search_quality)
    [ -f out/search_quality.jsonl ] ||
      { echo "out/search_quality.jsonl is missing: run make bench-search first" >&2; exit 1; }
    ;;
  *)
    echo "notebooks/run.sh does not know the notebook '$name'" >&2
    exit 1
    ;;
esac

# A kernel of our own: another one called python3 may stand before Debian's.
settings=$(mktemp -d)
trap 'rm -rf "$settings"' EXIT
mkdir -p "$settings/kernels/nbvopt"
cat >"$settings/kernels/nbvopt/kernel.json" <<EOF
{"argv": ["$python", "-m", "ipykernel_launcher", "-f", "{connection_file}"],
 "display_name": "nbvopt", "language": "python"}
EOF
export JUPYTER_PATH=$settings JUPYTER_CONFIG_DIR=$settings IPYTHONDIR=$settings
export PYTHONPATH=$build/python PYTHONDONTWRITEBYTECODE=1 PYDEVD_DISABLE_FILE_VALIDATION=1
export NBVOPT_NOTEBOOK_OUT=$out
$python -m nbconvert --log-level=WARN --to notebook --execute \
  --ExecutePreprocessor.kernel_name=nbvopt --output-dir "$out" "notebooks/$name.ipynb"
