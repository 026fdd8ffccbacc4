#!/bin/sh
# Builds one static site of the pages in docs/, the command pages, and the C++ interface. It has search and
# works without a network.
# site.sh [OUTPUT (out/site)]; takes the program of build/release, and builds it if it is not there.
set -eu
cd "$(dirname "$0")/.."
site=${1:-out/site}
scripts/install_dependencies.sh site
[ -f build/release/CMakeCache.txt ] || cmake --preset release >/dev/null
cmake --build --preset release --target flbc_app
scripts/site/build.sh build/release/flbc "$site"
cmake --preset release >/dev/null
cmake --build --preset release --target docs
cp -r build/release/docs/html "$site/api"
# Debian's Python, which has Debian's modules.
/usr/bin/python3 -B scripts/site/check_links.py "$site"
echo "$site/index.html"
