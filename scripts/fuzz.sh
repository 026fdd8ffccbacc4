#!/usr/bin/env bash
# Usage: scripts/fuzz.sh [SECONDS_PER_READER] [READER...]
# Builds flbc_fuzz (libFuzzer, AddressSanitizer, UndefinedBehaviorSanitizer; preset `fuzz`), lets it
# work on every reader, or on those that are named, for so many seconds each (60), and ends with a
# table. Exit status 1 if there are findings: inputs on which a reader crashes, takes 10 s or 2 GiB,
# throws what is no flbc::Error, or hands back what breaks a promise (tests/fuzz). What it has learnt
# is kept in build/fuzz/corpus, so that the next run goes on from there.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ${1:-} == -* ]]; then
  sed -n '2,7s/^# //p' scripts/fuzz.sh
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
    "scripts/install_dependencies.sh clang libclang-rt-14-dev libomp-14-dev" >&2
  exit 1
fi

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
fuzz=$PWD/build/fuzz/flbc_fuzz
work=$PWD/build/fuzz
mapfile -t known < <("$fuzz" --list)
if [ ${#readers[@]} -eq 0 ]; then readers=("${known[@]%% *}"); fi
rm -rf "$work/seeds"
"$fuzz" --seeds "$work/seeds"

# The last number after KEY in a log, 0 if there is none.
number_in() {
  grep -oE "$2 *[0-9]+" "$1" | tail -1 | grep -oE '[0-9]+$' || echo 0
}

table=()
failed=0
for reader in "${readers[@]}"; do
  file=$(printf '%s\n' "${known[@]}" | sed -n "s/^$reader //p")
  if [ -z "$file" ]; then
    echo "scripts/fuzz.sh: no reader \"$reader\"; there are: ${known[*]%% *}" >&2
    exit 1
  fi
  corpus=$work/corpus/$reader findings=$work/findings/$reader log=$work/$reader.log
  mkdir -p "$corpus" "$findings"
  known_inputs=$work/seeds/$reader
  found_before=()
  if [ -d "tests/fuzz/found/$reader" ]; then found_before=("$PWD/tests/fuzz/found/$reader"); fi
  options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=4096
    -print_final_stats=1 -artifact_prefix="$findings/")
  dictionary=tests/fuzz/dictionaries/${file##*.}.dict
  if [ -f "$dictionary" ]; then options+=(-dict="$dictionary"); fi
  echo "$reader: $seconds s ..."
  status=0
  OMP_NUM_THREADS=1 "$fuzz" "$reader" "${options[@]}" "$corpus" "$known_inputs" \
    "${found_before[@]}" >"$log" 2>&1 || status=$?
  count=$(find "$findings" -type f | wc -l)
  if [ "$status" -ne 0 ]; then
    failed=1
    echo "$reader: a finding; build/fuzz/$reader.log tells" >&2
  fi
  table+=("$(printf '%-14s %12s %10s %8s %9s' "$reader" \
    "$(number_in "$log" 'stat::number_of_executed_units:')" \
    "$(number_in "$log" 'stat::average_exec_per_sec:')" "$(number_in "$log" 'cov:')" "$count")")
done

printf '\n%-14s %12s %10s %8s %9s\n' reader executions "a second" edges findings
printf '%s\n' "${table[@]}"
exit $failed
