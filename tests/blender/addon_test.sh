#!/usr/bin/env bash
# Whether the add-on works in Blender:
#   addon_test.sh PROGRAM ZIP VERSION MESHES WORK
# PROGRAM: flbc. ZIP: the add-on. MESHES: the folder of samples. WORK: a folder for results, made
# anew. Ends with 77, which CTest counts as skipped, if Blender is missing.
set -euo pipefail

readonly program=$1 zip=$2 version=$3 meshes=$4 work=$5
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here skipped=77

if ! command -v blender >/dev/null; then
  echo "skipped: Blender is missing (Debian: blender)"
  exit $skipped
fi
rm -rf "$work"
mkdir -p "$work"
export BLENDER_USER_CONFIG=$work/config BLENDER_USER_SCRIPTS=$work/scripts PYTHONDONTWRITEBYTECODE=1

in_blender() { # SCRIPT [ARGUMENTS]
  blender --background --factory-startup --python-exit-code 1 --python "$here/$1" -- "${@:2}"
}
in_blender install_addon.py "$zip" "$version"
in_blender addon_test.py "$program" "$meshes" "$work"
in_blender without_addon.py "$work"
