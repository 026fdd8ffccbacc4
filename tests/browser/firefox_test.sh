#!/usr/bin/env bash
# Whether pages of flbc view do in Firefox what flbc deform does:
#   firefox_test.sh PROGRAM MESHES WORK
# PROGRAM: flbc. MESHES: the folder of samples. WORK: a folder for results, made anew; pictures of
# the pages are left there.
# Ends with 77, which CTest counts as skipped, if Node.js, its module, Firefox or a display for it
# is missing: without one it offers no WebGL.
set -euo pipefail

readonly flbc=$1 meshes=$2 work=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here skipped=77

skip() {
  echo "skipped: $1"
  exit $skipped
}
command -v node >/dev/null || skip "Node.js is missing (Debian: nodejs npm)"
firefox=$(command -v firefox-esr || command -v firefox || true)
[ -n "$firefox" ] || skip "there is no Firefox (Debian: firefox-esr)"
command -v xvfb-run >/dev/null || skip "xvfb-run is missing (Debian: xvfb xauth)"
[ -d "$here/node_modules/puppeteer-core" ] ||
  skip "the module puppeteer-core is missing; run npm ci in tests/browser"
rm -rf "$work"
mkdir -p "$work"
cd "$work"
# shellcheck source=tests/browser/sample_pages.sh
. "$here/sample_pages.sh"
sample 2d figure
sample 3d limb
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24" \
  node "$here/firefox_test.mjs" "$firefox" "$flbc" "$meshes" "$work"
