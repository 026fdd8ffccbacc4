#!/bin/sh
# One static site of README, docs/, the manual pages and the C++ interface, for any browser or web server.
# site.sh [OUTPUT (out/site)]; takes the program of build/release, and builds it if it is not there.
set -eu
cd "$(dirname "$0")/.."
site=${1:-out/site}
scripts/install_dependencies.sh doxygen python3-markdown groff-base
[ -f build/release/CMakeCache.txt ] || cmake --preset release >/dev/null
cmake --build --preset release --target flbc_app
rm -rf "$site"
mkdir -p "$site"
# Debian's Python, which has Debian's modules.
/usr/bin/python3 -B scripts/site/build_site.py . build/release/help "$site"
cmake --preset release >/dev/null
cmake --build --preset release --target docs
cp -r build/release/docs/html "$site/api"
/usr/bin/python3 -B scripts/site/check_links.py "$site"
echo "$site/index.html"
