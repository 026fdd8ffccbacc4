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
take() { # PICTURE COMMAND [OPTIONS]
  "${@:2}" --factory-startup --python-exit-code 1 --python "$here/blender.py" -- \
    "$flbc" "$here/../../meshes" "$1" "$work/$1.png"
  /usr/bin/python3 -c 'import sys; from PIL import Image
picture = Image.open(sys.argv[1]).convert("RGBA")
white = Image.new("RGBA", picture.size, "white")
Image.alpha_composite(white, picture).convert("RGB").quantize(128).save(sys.argv[2], optimize=True)' \
    "$work/$1.png" "$images/blender_$1.png"
}
take pose blender --background
take moved blender --background
take panel xvfb-run -a -s "-screen 0 1200x760x24" \
  blender --enable-event-simulate --window-geometry 0 0 1200 760
