#!/usr/bin/env bash
# Installs what is missing, builds, runs all tests. Options go to ctest, e.g. scripts/test.sh -R solver
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh
cmake --preset release >/dev/null
cmake --build --preset release
ctest --preset release "$@"
