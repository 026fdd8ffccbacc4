#!/usr/bin/env bash
# Usage: exports_test.sh SOURCE BUILD
# Looks at what the shared libraries of the core and the file formats are called and what they export.
set -euo pipefail
source=$1 work=$2

status=0
fail() {
  echo "$1"
  status=1
}
version=$(sed -n 's/set(FLBC_VERSION \(.*\))/\1/p' "$source/cmake/version.cmake")
version=${version%-dev}
exported() { nm -D --defined-only "$1" | awk '{print $3}'; }
for name in flbc flbc_io; do
  library=$(find "$work" -name "lib$name.so.$version")
  [ -n "$library" ] || { fail "no lib$name.so.$version"; continue; }
  readelf -d "$library" | grep -q "SONAME.*\[lib$name.so.${version%.*}\]" ||
    fail "$library: no soname with major and minor version"
  # Names in flbc, and what the compiler makes for its types: type information, vtables.
  strange=$(exported "$library" | grep -vE '^_Z(N|NK|TIN|TSN|TVN|TTN)4flbc' || true)
  [ -z "$strange" ] || fail "$library exports"$'\n'"$strange"
  # Of the inside only what the components share (cmake/shared.cmake).
  inside=$(exported "$library" |
    grep -E '4flbc(8gradient|9splitting|10active_set|8distance|7compact|9multigrid|5panel)' || true)
  [ -z "$inside" ] || fail "$library exports of its inside"$'\n'"$inside"
done
for symbol in _ZN4flbc5solveILi3EEE _ZN4flbc6SolverILi2EEC1E _ZTIN4flbc10InputErrorE; do
  exported "$(find "$work" -name "libflbc.so.$version")" | grep "^$symbol" >/dev/null ||
    fail "libflbc does not export $symbol"
done
exit $status
