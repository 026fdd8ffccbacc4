#!/usr/bin/env bash
# Builds flbc.exe by MinGW-w64, and tries it under Wine: build/windows/flbc.exe
#   scripts/windows.sh [--tests]
# --tests: also the tests of the library.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh windows
cmake --preset windows >/dev/null
targets=(flbc_app)
[ "${1:-}" != --tests ] || targets+=(base_tests io_tests meshing_tests solver_tests sparsify_tests)
cmake --build --preset windows --target "${targets[@]}"
# Threads wait for each other by calls to Wine's server: a parallel region of two takes 0.3 ms.
export WINEDEBUG=-all OMP_NUM_THREADS=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
under_wine() { /usr/lib/wine/wine64 "$@"; }
under_wine build/windows/flbc.exe --version
under_wine build/windows/flbc.exe run meshes/3d/limb_cage.obj meshes/3d/limb_model.obj \
  --pose meshes/3d/limb_cage_pose.obj -o "$work/limb"
[ -s "$work/limb/model.glb" ]
for target in "${targets[@]:1}"; do
  under_wine "build/windows/tests/${target%_tests}/$target.exe" --gtest_brief=1
done
