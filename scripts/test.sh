#!/usr/bin/env bash
# Installs missing packages, builds, and runs all tests. Options go to ctest, for example
# scripts/test.sh -R solver
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh
cmake --preset release >/dev/null
cmake --build --preset release
# Without them, tests of glTF in other programs and of pages in a browser are skipped.
if command -v npm >/dev/null; then
  scripts/install_dependencies.sh chromium fonts-dejavu-core ||
    echo "no browser: the test of pages in one will be skipped" >&2
  for folder in tests/gltf tests/browser; do
    lock=$folder/package-lock.json
    [ $folder/node_modules/.package-lock.json -nt $lock ] && continue
    npm ci --prefix $folder --ignore-scripts --no-audit --no-fund --silent ||
      echo "npm ci failed: the test in $folder will be skipped" >&2
  done
fi
ctest --preset release "$@"
