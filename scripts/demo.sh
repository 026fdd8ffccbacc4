#!/usr/bin/env bash
# Installs what is missing, builds, and computes coordinates of a 2D and a 3D sample: weights at the
# mesh and at the model, deformed models, reports and pictures under out/.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh
cmake --preset release >/dev/null
cmake --build --preset release --target flbc_app
mkdir -p out
flbc=build/release/flbc

# solve_and_draw DIM NAME DOMAIN_EXTENSION CONTROL_POINT VERTICES
solve_and_draw() {
  local cage=meshes/$1/$2_cage.obj out=out/$2
  "$flbc" solve "$cage" -o "$out"_weights.npy --vertices "$5" --save-domain "$out"_domain."$3" \
    --report "$out"_report.json
  "$flbc" solve "$cage" -o "$out"_model_weights.mtx --domain "$out"_domain."$3" \
    --model meshes/"$1"/"$2"_model.obj
  "$flbc" draw "$out"_domain."$3" --weights "$out"_weights.npy --cage "$cage" \
    --control-point "$4" -o "$out".png
  "$flbc" deform meshes/"$1"/"$2"_model.obj --weights "$out"_model_weights.mtx --rest "$cage" \
    --cage meshes/"$1"/"$2"_cage_pose.obj -o "$out"_posed.obj
}
solve_and_draw 2d figure obj 32 10000
solve_and_draw 3d limb mesh 20 4000

# The 2D domain in its pose, coloured by the same weight.
"$flbc" deform out/figure_domain.obj --weights out/figure_weights.npy \
  --rest meshes/2d/figure_cage.obj --cage meshes/2d/figure_cage_pose.obj -o out/figure_domain_posed.obj
"$flbc" draw out/figure_domain_posed.obj --weights out/figure_weights.npy \
  --cage meshes/2d/figure_cage_pose.obj --control-point 32 -o out/figure_posed.png

echo
echo "Weights, reports, deformed models and pictures are in out/; look at out/figure.png, out/limb.png"
echo "and, deformed, out/figure_posed.png and out/limb_posed.obj."
