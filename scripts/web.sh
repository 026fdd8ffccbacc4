#!/usr/bin/env bash
# Builds web/dist: the page flbc.html, and the npm package.
#   scripts/web.sh [--fast] [ADDRESS]
# --fast links in a third of the time, for development. ADDRESS: where the source code is, for the
# license notes of the page.
set -euo pipefail
cd "$(dirname "$0")/.."

link=3
if [ "${1:-}" = --fast ]; then
  link=1
  shift
fi
scripts/install_dependencies.sh web
if [ ! -d web/decoders/node_modules ]; then
  npm ci --prefix web/decoders --ignore-scripts --no-audit --no-fund
fi
export NODE_PATH=/usr/share/nodejs  # of the tools that Emscripten calls
emcmake cmake -G Ninja -S web -B build/web -DFLBC_WEB_LINK=$link >/dev/null
cmake --build build/web
node web/build.mjs build/web "$(sed -n 's/set(FLBC_VERSION \(.*\))/\1/p' cmake/version.cmake)" "$@"
ls -l web/dist
