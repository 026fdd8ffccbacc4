#!/usr/bin/env bash
# Whether the module for the web does what the program does, in Node.js and in a browser:
#   web_test.sh PROGRAM MESHES WORK node|browser|clone
# WORK: a folder for results, made anew; pictures of the page are left there.
# Ends with 77, which CTest counts as skipped, if the module has not been built, or a program is missing.
set -euo pipefail

readonly flbc=$1 meshes=$2 work=$3 kind=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here root=$here/../..
readonly dist=$root/web/dist

skip() {
  echo "skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "Node.js is missing (Debian: nodejs)"
if [ "$kind" != node ]; then
  browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    skip "there is no browser (Debian: chromium)"
  [ -d "$here/../browser/node_modules/puppeteer-core" ] ||
    skip "the module puppeteer-core is missing; run npm ci in tests/browser"
fi
if [ "$kind" = clone ]; then
  # The page is of the last release. A release has its own.
  version=$(sed -n 's/set(FLBC_VERSION \(.*\))/\1/p' "$root/cmake/version.cmake")
  released=$(sed -n 's/^## \([0-9.]*\) - .*/\1/p' "$root/CHANGELOG.md" | head -1)
  [[ $version = *-dev || $version = "$released" ]] || { echo "CHANGELOG.md has no section $version"; exit 1; }
  exec node "$here/clone_test.mjs" "$browser" "$root/flbc.html" "$released"
fi
[ -e "$dist/flbc.html" ] || skip "the module for the web is missing; run scripts/web.sh"
newer=$(find "$root/libflbc" "$root/apps" "$root/web/"{src,js,page} -type f -newer "$dist/flbc.html" -print -quit)
[ -z "$newer" ] || skip "the module for the web is older than ${newer#"$root/"}; run scripts/web.sh"
rm -rf "$work"
mkdir -p "$work"
if [ "$kind" = node ]; then
  node "$here/isolation.mjs" "$root/build/web"
  node "$here/calls_test.mjs"
  node "$here/node_test.mjs" "$dist/flbc.mjs" "$flbc" "$meshes" "$work"
  node "$here/gltf_test.mjs" "$dist/flbc.mjs" "$flbc" "$work/.." "$work"
  node "$here/core_test.mjs" "$dist/core.mjs"
  # The package as others install it, without anything else.
  command -v npm >/dev/null || exit 0
  (cd "$work" && npm pack --silent "$root/web" >/dev/null && npm init --yes >/dev/null &&
    npm install --silent --offline --no-audit --no-fund ./flbc-*.tgz)
  node "$here/packages_test.mjs" "$work" "$here/../browser/node_modules" \
    "$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)"
else
  node "$here/decoding_test.mjs" "$flbc" "$meshes" "$work"
  node "$here/page_test.mjs" "$browser" "$dist/flbc.html" "$flbc" "$meshes" "$work"
fi
