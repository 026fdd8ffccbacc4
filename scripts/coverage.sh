#!/usr/bin/env bash
# Usage: scripts/coverage.sh [CTEST_OPTIONS]
# Builds with GCC's counters (preset `coverage`), runs the tests, and prints which part of the lines
# of the library, of its file formats and of the bindings they run; at least 90 % are wanted. The
# report by file is build/coverage/report/index.html. Options go to ctest; with TARGETS only these
# are built: TARGETS=weights_test scripts/coverage.sh -R Weights. LEAST=0 wants nothing.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '2,6s/^# //p' scripts/coverage.sh
  exit
fi
scripts/install_dependencies.sh gcovr
cmake --preset coverage >/dev/null
# shellcheck disable=SC2086
cmake --build --preset coverage ${TARGETS:+--target $TARGETS}
find build/coverage -name '*.gcda' -delete
status=0
ctest --preset coverage --label-exclude 'install|blender' --timeout 1800 "$@" || status=$?

# gcovr replaces the file that --output names: it must be none of the system's, as /dev/null.
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
