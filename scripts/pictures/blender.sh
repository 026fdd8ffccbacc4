#!/usr/bin/env bash
# Pictures of the Blender add-on: blender.sh FLBC IMAGES WORK
# Needs Blender, Xvfb, and libgl1-mesa-dri.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here flbc=$1 images=$2 work=$3

rm -rf "$work"
mkdir -p "$work/scripts/addons"
ln -s "$here/../../blender/local_barycentric_cage" "$work/scripts/addons/"
export BLENDER_USER_CONFIG=$work/config BLENDER_USER_SCRIPTS=$work/scripts PYTHONDONTWRITEBYTECODE=1
take() { # PICTURE [OPTIONS OF BLENDER]
  blender --factory-startup --python-exit-code 1 "${@:2}" --python "$here/blender.py" -- \
    "$flbc" "$here/../../meshes" "$1" "$images/blender_$1.png"
}
take pose --background
export -f take
export here flbc images
xvfb-run -a -s "-screen 0 1200x760x24" bash -c 'take panel --window-geometry 0 0 1200 760'
