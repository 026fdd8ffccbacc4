#!/usr/bin/env bash
# Installs what is missing, builds, runs all tests. Options go to ctest, e.g. scripts/test.sh -R solver
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh
cmake --preset release >/dev/null
cmake --build --preset release
# Without them the test of glTF in other programs is skipped.
lock=tests/gltf/package-lock.json
if command -v npm >/dev/null && ! [ tests/gltf/node_modules/.package-lock.json -nt $lock ]; then
  npm ci --prefix tests/gltf --ignore-scripts --no-audit --no-fund --silent ||
    echo "npm ci failed: the test of glTF in other programs will be skipped" >&2
fi
ctest --preset release "$@"
