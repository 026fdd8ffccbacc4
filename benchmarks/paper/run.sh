#!/usr/bin/env bash
# Regenerates the paper's tables and figures: numbers, then pictures. See README.md beside it.
#
#   benchmarks/paper/run.sh MODELS_FOLDER|samples OUT_FOLDER [--quick] [--busy] [--only NAME,...] [--models A,B,...] [--threads T]
set -euo pipefail

if [[ $# -lt 2 || $1 == -* || $2 == -* ]]; then
  sed -n '2,4s/^# \{0,1\}//p' "$0" >&2
  exit 1
fi
models=$1
out=$(realpath -m -- "$2")
shift 2
if [[ $models == samples ]]; then
  models=$(dirname "$0")/../../meshes
  set -- --only samples "$@"
fi
models=$(realpath -- "$models")
cd "$(dirname "$0")/../.."
if ! compgen -G "$models/2d/*.obj" >/dev/null && ! compgen -G "$models/3d/*.obj" >/dev/null; then
  echo "run.sh: $models has no cages in 2d/ or 3d/; benchmarks/paper/README.md says where they come from" >&2
  exit 1
fi

[[ -f build/release/build.ninja ]] || cmake --preset release
cmake --build --preset release --target flbc_bench_paper

# A case that failed must not keep the others from being drawn.
status=0
bench=build/release/benchmarks/flbc_bench_paper
origin="commit $(git describe --always --dirty 2>/dev/null || echo unknown-dirty); $($bench --behavior)"
$bench "$models" "$out" --origin "$origin" "$@" || status=$?
[[ -d $out ]] || exit "$status"
/usr/bin/python3 -B benchmarks/paper/plots.py "$out" || status=$?
exit "$status"
