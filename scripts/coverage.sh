#!/usr/bin/env bash
# Usage: scripts/coverage.sh [CTEST_OPTIONS]
# Builds with GCC coverage counters (preset `coverage`), runs the tests, and prints line coverage of
# the library, file formats, and bindings. At least 90% is required; LEAST=0 disables this. Report
# by file: build/coverage/report/index.html. Options go to ctest. TARGETS limits the build:
# TARGETS=io_tests scripts/coverage.sh -R Weights
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '2,6s/^# //p' scripts/coverage.sh
  exit
fi
scripts/install_dependencies.sh netgen tests gcovr
cmake --preset coverage >/dev/null
# shellcheck disable=SC2086
cmake --build --preset coverage ${TARGETS:+--target $TARGETS}
find build/coverage -name '*.gcda' -delete
status=0
ctest --preset coverage --label-exclude 'install|blender' --timeout 1800 "$@" || status=$?

# gcovr replaces the file of --output, so it must not be a system file such as /dev/null.
mkdir -p build/coverage/report
counters=(--root . --object-directory build/coverage --exclude-directories '.*/CompilerIdCXX')
summary() {
  gcovr "${counters[@]}" "$@" --print-summary 2>build/coverage/report/log | grep '^lines'
}
echo "libflbc: $(summary --filter libflbc/src/ --filter libflbc/include/ --filter libflbc/caging/)"
echo "libflbc/io: $(summary --filter libflbc/io/)"
echo "openmesh_bindings: $(summary --filter openmesh_bindings/)"
gcovr "${counters[@]}" --filter libflbc/ --filter openmesh_bindings/ \
  --html-details build/coverage/report/index.html --fail-under-line "${LEAST:-90}" ||
  { echo "less than ${LEAST:-90} % of the lines are run" >&2; exit 1; }
exit $status
