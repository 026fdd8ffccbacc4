#!/usr/bin/env bash
# Makes docs/images/blender_panel.png and blender_moved.png: blender.sh [panel|moved ...]
# Needs Blender, xvfb, xauth, imagemagick, and libgl1-mesa-dri; for the panel of Blender 4.3
#   FLBC=/flbc/build/release/flbc scripts/in_debian.sh trixie scripts/pictures/blender.sh
set -euo pipefail
cd "$(dirname "$0")"
flbc=${FLBC:-$PWD/../../build/release/flbc}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mkdir -p "$work/scripts/addons"
ln -s "$PWD/../../blender/local_barycentric_cage" "$work/scripts/addons/"
export BLENDER_USER_CONFIG=$work/config BLENDER_USER_SCRIPTS=$work/scripts PYTHONDONTWRITEBYTECODE=1
[ $# -gt 0 ] || set -- panel moved
for picture; do
  start=(blender --background)
  [ "$picture" = moved ] ||
    start=(xvfb-run -a -s "-screen 0 1200x760x24" blender --enable-event-simulate --window-geometry 0 0 1200 760)
  "${start[@]}" --factory-startup --python-exit-code 1 --python blender.py -- "$flbc" "$PWD/../../meshes" "$picture" "$work/$picture.png"
  /usr/bin/python3 -B -c 'import sys, common
picture = common.Image.open(sys.argv[1]).convert("RGBA")
white = common.page(*picture.size)[0]
white.alpha_composite(picture)
draw = common.ImageDraw.Draw(white)
for x, title in ((300, "Mesh Deform"), (900, "Local Barycentric Cage")) * (sys.argv[2] == "blender_moved.png"):
    common.write(draw, (x, 22), title, 24, color=(33, 38, 48))
common.save(white.convert("RGB"), sys.argv[2], 256)' "$work/$picture.png" "blender_$picture.png"
done
