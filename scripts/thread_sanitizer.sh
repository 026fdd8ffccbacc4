#!/usr/bin/env bash
# Usage: scripts/thread_sanitizer.sh [GOOGLETEST_OPTIONS]
# Builds the tests of parallel code with ThreadSanitizer (preset `tsan`) and runs them with four
# threads. Options go to the tests, such as --gtest_filter='*Single*'. Needs clang: the GCC OpenMP
# library does not report its barriers to ThreadSanitizer, so everything would be a race; clang
# does, through the tool archer.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '2,6s/^# //p' scripts/thread_sanitizer.sh
  exit
fi
archer=$(dirname "$(readlink -f "$(command -v clang++ || echo /)")")/../lib/libarcher.so
if [ ! -e "$archer" ]; then
  echo "scripts/thread_sanitizer.sh needs clang++ with its runtime libraries:" \
    "scripts/install_dependencies.sh clang" >&2
  exit 1
fi
export OMP_TOOL_LIBRARIES=$archer OMP_NUM_THREADS=4 OMP_WAIT_POLICY=passive
# Ignores libraries without instrumentation, such as CHOLMOD.
export TSAN_OPTIONS="ignore_noninstrumented_modules=1 ${TSAN_OPTIONS:-}"

# Checks that ThreadSanitizer works: it reports a race, and accepts accesses separated by a barrier.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/net.cpp" <<'END'
int main(int count, char**) {
  int numbers[2] = {0, 0};
#pragma omp parallel
  {
#pragma omp for
    for (int k = 0; k < 2; ++k) numbers[k] = k;
#pragma omp for
    for (int k = 0; k < 2; ++k) {
#pragma omp atomic
      numbers[0] += numbers[1];
    }
    if (count > 1) ++numbers[0];
  }
  return 0;
}
END
clang++ -fsanitize=thread -fopenmp -g -O1 "$folder/net.cpp" -o "$folder/net"
if ! "$folder/net" 2>"$folder/log" || "$folder/net" race 2>"$folder/log"; then
  cat "$folder/log" >&2
  echo "scripts/thread_sanitizer.sh: ThreadSanitizer does not understand OpenMP here" >&2
  exit 1
fi

cmake --preset tsan >/dev/null
folders=(base solver linear problem polytope certificate evaluation coordinates sparsify)
cmake --build --preset tsan --target "${folders[@]/%/_tests}"
status=0
for folder in "${folders[@]}"; do
  "build/tsan/tests/$folder/${folder}_tests" "$@" ||
    { status=1 && echo "$folder: not without a race or a failure"; }
done
exit $status
