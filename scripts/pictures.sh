#!/usr/bin/env bash
# Makes the pictures of the documents, or those that are named, in docs/images:
#   scripts/pictures.sh [--models FOLDER] [NAME...]
# NAME: hero ring locality view before_after deformation smoothness automatic_cages blender
# FOLDER: the papers' models, for automatic_cages. Working files go to out/pictures.
set -euo pipefail
cd "$(dirname "$0")/.."

models=
if [ "${1:-}" = --models ]; then
  models=$(realpath -- "$2")
  shift 2
fi
names=("$@")
if [ $# -eq 0 ]; then
  names=(hero ring locality view before_after deformation smoothness)
  [ -z "$models" ] || names+=(automatic_cages)
  ! command -v blender >/dev/null || names+=(blender)
fi

packages=(pictures)
command -v npm >/dev/null || packages+=(nodejs npm)
scripts/install_dependencies.sh "${packages[@]}"
[ -f build/release/build.ninja ] || cmake --preset release >/dev/null
cmake --build --preset release --target flbc_app
flbc=build/release/flbc images=docs/images work=out/pictures
mkdir -p "$images" "$work"

# The sample of DIM, in its pose, all the way; once.
run() { # DIM NAME CONTROL_POINT
  [ -f "$work/$2/report.json" ] ||
    "$flbc" run "meshes/$1/$2_cage.obj" "meshes/$1/$2_model.obj" \
      --pose "meshes/$1/$2_cage_pose.obj" --control-point "$3" -o "$work/$2" -q
}

for name in "${names[@]}"; do
  echo "$name"
  case $name in
    hero) scripts/pictures/hero.py "$images/hero.png" "$work/hero" ;;
    ring) scripts/pictures/ring.py "$images/ring.gif" "$work/ring" ;;
    locality) scripts/pictures/locality.py "$images/locality.gif" "$work/locality" ;;
    automatic_cages) scripts/pictures/automatic_cages.py "$images/automatic_cages.png" "$work/cages" "$models" ;;
    smoothness) scripts/pictures/smoothness.py "$images/smoothness.png" "$work/smoothness" ;;
    blender) scripts/pictures/blender.sh "$PWD/$flbc" "$PWD/$images" "$PWD/$work/blender" ;;
    view)
      run 3d limb 20
      [ -d tests/browser/node_modules/puppeteer-core ] || npm --prefix tests/browser ci --silent
      node scripts/pictures/view.mjs "$work/limb/model.html" "$images/view.png" ;;
    deformation)
      run 2d figure 32
      cp "$work/figure/deformation.png" "$images/deformation.png" ;;
    before_after)
      run 3d limb 20
      cp "$work/limb/deformation.png" "$images/before_after.png" ;;
    *)
      echo "pictures.sh: there is no picture '$name'" >&2
      exit 1 ;;
  esac
done
