#!/usr/bin/env bash
# Whether the add-on works in a window of Blender, on a display without a screen:
#   window_test.sh PROGRAM ZIP MESHES WORK
# PROGRAM: flbc. ZIP: the add-on. MESHES: the folder of samples. WORK: a folder for results, made
# anew. Ends with 77, which CTest counts as skipped, if Blender or Xvfb is missing.
set -euo pipefail

readonly program=$1 zip=$2 meshes=$3 work=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here skipped=77

for needed in blender xvfb-run; do
  if ! command -v $needed >/dev/null; then
    echo "skipped: $needed is missing (Debian: blender xvfb libgl1-mesa-dri)"
    exit $skipped
  fi
done
rm -rf "$work"
mkdir -p "$work/scripts/addons"
export BLENDER_USER_CONFIG=$work/config BLENDER_USER_SCRIPTS=$work/scripts PYTHONDONTWRITEBYTECODE=1
(cd "$work/scripts/addons" && cmake -E tar xf "$zip")
xvfb-run -a -s "-screen 0 1280x800x24" timeout 240 \
  blender --factory-startup --enable-event-simulate --python "$here/window_test.py" -- "$program" "$meshes" "$work/done" \
  2>&1 | tee "$work/log"
[ -e "$work/done" ]
if grep -q Traceback "$work/log"; then
  echo "an error while the panel was drawn"
  exit 1
fi
