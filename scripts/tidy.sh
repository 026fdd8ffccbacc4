#!/usr/bin/env bash
# Usage: scripts/tidy.sh [REGEX...]
# Runs clang-tidy with the rules of .clang-tidy on all sources, or on those with matching paths:
# scripts/tidy.sh libflbc/io apps/main. A warning is a failure.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '2,4s/^# //p' scripts/tidy.sh
  exit
fi
scripts/install_dependencies.sh netgen clang clang-tidy
# Without unity builds, and with clang++, because clang-tidy cannot read GCC precompiled headers.
cmake --preset clang -B build/tidy -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DFLBC_UNITY_BUILD=OFF \
  -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null

mapfile -t sources < <(git ls-files 'libflbc/*.cpp' 'openmesh_bindings/*.cpp' 'apps/*.cpp' \
  'tests/*.cpp' | grep -vE '^tests/(install/|openmesh_bindings/surface_is_no_domain)')
chosen=()
for source in "${sources[@]}"; do
  [ $# = 0 ] && chosen+=("$source")
  for regex in "$@"; do
    if [[ $source =~ $regex ]]; then
      chosen+=("$source")
      break
    fi
  done
done
echo "${#chosen[@]} of ${#sources[@]} sources"
printf '%s\n' "${chosen[@]}" |
  xargs -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet --warnings-as-errors='*' 2>/dev/null
