#!/usr/bin/env bash
# A compiler launcher: reuse_object.sh HERE BUILT CONSUMER COMPILER [OPTIONS]
# HERE: a build of the consumer with flbc as its subdirectory. BUILT: a build of flbc alone.
# CONSUMER: a build of the consumer alone. Instead of compiling an object that they have, looks only
# for its headers and copies the object. Compiles all others.
set -euo pipefail
here=$1 built=$2 consumer=$3
shift 3
command=("$@")
for ((k = 1; k < ${#command[@]}; ++k)); do
  [ "${command[k - 1]}" = -o ] || continue
  output=${command[k]}
  place=$(realpath -m --relative-to="$here" "$output")
  found=$consumer/$place
  [[ $place == flbc/* ]] && found=$built/${place#flbc/}
  [ -f "$found" ] || break
  command[k]=/dev/null
  # The objects look for the headers of their precompiled header.
  [[ $output == *.gch ]] || "${command[@]}" -E
  exec cp "$found" "$output"
done
exec "$@"
