#!/usr/bin/env bash
# Whether Blender moves skins of flbc export as flbc deform moves the model:
#   blender_test.sh PROGRAM MESHES WORK
# PROGRAM: flbc. MESHES: the folder of samples. WORK: a folder for results, made anew.
# Ends with 77, which CTest counts as skipped, if Blender is missing.
set -euo pipefail

readonly flbc=$1 meshes=$2 work=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here skipped=77

if ! command -v blender >/dev/null; then
  echo "skipped: Blender is missing (Debian: blender)"
  exit $skipped
fi
rm -rf "$work"
mkdir -p "$work"
cd "$work"

for name in 2d/figure 3d/limb; do
  cage=$meshes/${name}_cage.obj
  pose=$meshes/${name}_cage_pose.obj
  model=$meshes/${name}_model.obj
  "$flbc" solve "$cage" --method harmonic --vertices 1500 -q -o weights.npy --model "$model"
  "$flbc" sparsify weights.npy --cage "$cage" --points "$model" -k 4 -q -o few.mtx
  "$flbc" deform "$model" --weights few.mtx --pose "$pose" -q -o moved.obj
  "$flbc" export "$model" --weights few.mtx --cage "$cage" -k 4 -q -o skin.glb
  blender --background --factory-startup --python-exit-code 1 --python "$here/blender.py" -- \
    skin.glb "$cage" "$pose" moved.obj
done
