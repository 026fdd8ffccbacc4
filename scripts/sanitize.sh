#!/usr/bin/env bash
# Usage: scripts/sanitize.sh [CTEST_OPTIONS]
# Builds everything with AddressSanitizer and UndefinedBehaviorSanitizer (preset `asan`) and runs
# the tests, except those of installed files, browsers, and Blender, which run code without
# sanitizers. Options go to ctest. TARGETS limits the build:
# TARGETS="io_tests fuzz_tests" scripts/sanitize.sh -R 'Weights|Fuzz'
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '2,6s/^# //p' scripts/sanitize.sh
  exit
fi
# Readers are tested with headers that request more memory than available, which the program must
# reject. Stack use after return is not checked, because it moves frames to addresses to which
# instructions for aligned 64-byte vectors cannot write.
export ASAN_OPTIONS="allocator_may_return_null=1:detect_stack_use_after_return=0:${ASAN_OPTIONS:-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"

# Checks that the sanitizers work: an out-of-bounds access and an overflow must end a program.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/net.cpp" <<'END'
#include <climits>
#include <vector>
int main(int count, char**) {
  std::vector<int> numbers(3, INT_MAX);
  if (count == 2) return numbers.data()[count + 1];
  return numbers[0] + (count - 1) > 0 ? 0 : 1;
}
END
flags=$(sed -n 's/.*"CMAKE_CXX_FLAGS": "\(.*address[^"]*\)".*/\1/p' CMakePresets.json)
# shellcheck disable=SC2086
g++ -O1 ${flags/-D_GLIBCXX_ASSERTIONS/} "$folder/net.cpp" -o "$folder/net"
if ! "$folder/net" 2>"$folder/log" || "$folder/net" beyond 2>"$folder/log" ||
  "$folder/net" overflow twice 2>"$folder/log"; then
  cat "$folder/log" >&2
  echo "scripts/sanitize.sh: the sanitizers see nothing here" >&2
  exit 1
fi

cmake --preset asan >/dev/null
# shellcheck disable=SC2086
cmake --build --preset asan ${TARGETS:+--target $TARGETS}
ctest --preset asan --label-exclude 'install|blender' --exclude-regex 'gltf_validator|_in_a_browser|_in_firefox' \
  --timeout 1800 "$@"
