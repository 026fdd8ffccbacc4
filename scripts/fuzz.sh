#!/usr/bin/env bash
# Usage: scripts/fuzz.sh [SECONDS_PER_READER] [READER...]
# Builds flbc_fuzz (libFuzzer, AddressSanitizer, UndefinedBehaviorSanitizer; preset `fuzz`) and
# fuzzes every reader, or the named readers, for the given seconds each (default: 60). It runs one
# reader per core and ends with a table. Exit status 1 if there are findings: inputs on which a
# reader crashes, takes 10 s or 2 GiB, throws anything except flbc::Error, or violates its contract
# (tests/fuzz). The corpus is kept in build/fuzz/corpus, and the next run resumes from it. SEED=1 in
# the environment ignores the corpus and makes runs reproducible. RUNS=N ends after N inputs per
# reader.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ${1:-} == -* ]]; then
  sed -n '2,9s/^# //p' scripts/fuzz.sh
  exit 1
fi
seconds=${1:-60}
readers=("${@:2}")
if ! [[ $seconds =~ ^[1-9][0-9]*$ ]]; then
  echo "scripts/fuzz.sh: \"$seconds\" is no number of seconds" >&2
  exit 1
fi

# \param KIND  of the compiler's runtime libraries
has_runtime() {
  local name="libclang_rt.$1-$(uname -m).a"
  [[ $(clang++ -print-file-name="$name") == /* || -e $(clang++ -print-resource-dir)/lib/linux/$name ]]
}
if ! command -v clang++ >/dev/null || ! has_runtime fuzzer || ! has_runtime asan; then
  echo "scripts/fuzz.sh needs clang++ with its runtime libraries: " \
    "scripts/install_dependencies.sh clang" >&2
  exit 1
fi

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
fuzz=$PWD/build/fuzz/flbc_fuzz
work=$PWD/build/fuzz
mapfile -t known < <("$fuzz" --list)
if [ ${#readers[@]} -eq 0 ]; then readers=("${known[@]}"); fi
rm -rf "$work/seeds"
"$fuzz" --seeds "$work/seeds"

# The last number after KEY in a log, 0 if there is none.
number_in() {
  grep -oE "$2 *[0-9]+" "$1" | tail -1 | grep -oE '[0-9]+$' || echo 0
}

# fuzz_reader READER: fuzzes one reader; see its log and findings for the result.
fuzz_reader() {
  local reader=$1
  local corpus=$work/corpus/$reader findings=$work/findings/$reader
  if [ -n "${SEED:-}" ]; then rm -rf "$corpus"; fi
  mkdir -p "$corpus" "$findings"
  local inputs=("$corpus" "$work/seeds/$reader")
  if [ -d "tests/fuzz/found/$reader" ]; then inputs+=("$PWD/tests/fuzz/found/$reader"); fi
  local options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=4096
    -print_final_stats=1 -artifact_prefix="$findings/" -seed="${SEED:-0}" -runs="${RUNS:--1}"
    -reload=0 -dict="$work/seeds/$reader.dict")
  echo "$reader: $seconds s ..."
  rm -f "$work/$reader.failed"
  OMP_NUM_THREADS=1 "$fuzz" "$reader" "${options[@]}" "${inputs[@]}" >"$work/$reader.log" 2>&1 ||
    touch "$work/$reader.failed"
}

for reader in "${readers[@]}"; do
  if ! printf '%s\n' "${known[@]}" | grep -qxF -- "$reader"; then
    echo "scripts/fuzz.sh: no reader \"$reader\"; there are: ${known[*]}" >&2
    exit 1
  fi
done
for reader in "${readers[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n; done
  fuzz_reader "$reader" &
done
wait

failed=0
printf '\n%-14s %12s %10s %8s %9s\n' reader executions "a second" edges findings
for reader in "${readers[@]}"; do
  log=$work/$reader.log
  printf '%-14s %12s %10s %8s %9s\n' "$reader" \
    "$(number_in "$log" 'stat::number_of_executed_units:')" \
    "$(number_in "$log" 'stat::average_exec_per_sec:')" "$(number_in "$log" 'cov:')" \
    "$(find "$work/findings/$reader" -type f | wc -l)"
  if [ -e "$work/$reader.failed" ]; then
    failed=1
    echo "$reader: a finding; the end of build/fuzz/$reader.log:" >&2
    tail -40 "$log" >&2
  fi
done
exit $failed
