#!/bin/sh
# Builds a static site of README, docs/, the manual pages, and the C++ interface.
# site.sh [OUTPUT (out/site)]; uses the program of build/release, and builds it if missing.
set -eu
cd "$(dirname "$0")/.."
site=${1:-out/site}
scripts/install_dependencies.sh doxygen mkdocs mkdocs-material libjs-katex
[ -f build/release/CMakeCache.txt ] || cmake --preset release >/dev/null
cmake --build --preset release --target flbc_app
rm -rf "$site"
mkdir -p "$site"
# The Debian Python, which has the Debian modules.
/usr/bin/python3 -B scripts/site/build_site.py . build/release/help "$site"
cmake --preset release >/dev/null
cmake --build --preset release --target docs
cp -r build/release/docs/html "$site/api"
# Debian's Python, which has Debian's modules.
/usr/bin/python3 -B scripts/site/check_links.py "$site"
echo "$site/index.html"
