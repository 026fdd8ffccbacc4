#!/usr/bin/env bash
# Installs missing packages, builds, and processes a 2D and a 3D sample: weights, deformed models,
# skins, reports, and pictures in out/.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh
cmake --preset release >/dev/null
cmake --build --preset release --target flbc_app
mkdir -p out
flbc=build/release/flbc

# run DIM NAME OPTIONS
run() {
  "$flbc" run meshes/"$1"/"$2"_cage.obj meshes/"$1"/"$2"_model.obj \
    --pose meshes/"$1"/"$2"_cage_pose.obj -k 8 -o out/"$2" "${@:3}"
}
run 2d figure --control-point 32
run 3d limb --control-point 20 --vertices 4000

echo
echo "Weights, skins, reports, deformed models and pictures are in out/figure and out/limb; look at"
echo "function.png and deformation.png there, and open model.html in a browser to move the cage."
