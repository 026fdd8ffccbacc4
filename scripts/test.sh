#!/usr/bin/env bash
# Installs missing packages, builds, runs all tests, and lists what was skipped. Options go to ctest,
# for example scripts/test.sh -R solver
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh netgen tests
# scripts/demo.sh may have configured the build without it.
cmake --preset release -DFLBC_WITH_NETGEN=ON >/dev/null
cmake --build --preset release
# Without them, tests of glTF in other programs and of pages in a browser are skipped.
if command -v npm >/dev/null; then
  scripts/install_dependencies.sh browser ||
    echo "chromium cannot be installed" >&2
  for folder in tests/gltf tests/browser; do
    lock=$folder/package-lock.json
    [ $folder/node_modules/.package-lock.json -nt $lock ] && continue
    npm ci --prefix $folder --ignore-scripts --no-audit --no-fund --silent ||
      echo "npm ci failed in $folder" >&2
  done
fi
results=$PWD/build/release/tests.xml
rm -f "$results"
status=0
ctest --preset release --output-junit "$results" --test-output-size-passed 100000 "$@" || status=$?
[ ! -f "$results" ] || /usr/bin/python3 scripts/list_skipped.py "$results"
grep -q '^FLBC_WITH_OPENFOAM:BOOL=ON' build/release/CMakeCache.txt ||
  echo "Skipped the tests of the OpenFOAM plugin: OpenFOAM is missing"
exit $status
