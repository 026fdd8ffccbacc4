#!/bin/sh
# Pages are short and plain, and the check of them notices what is wrong.
# prose_test.sh REPOSITORY WORK
set -eu
repository=$1 work=$2
/usr/bin/python3 -B "$repository/scripts/check_prose.py"
mkdir -p "$work"
long=$(seq -s ' ' 1 40)
for text in "A sentence of $long words." "It lies beside the cage." "See \`apps/absent.cpp\`." "It took 3 % longer."; do
  printf '# Title\n\n%s\n' "$text" >"$work/page.md"
  if /usr/bin/python3 -B "$repository/scripts/check_prose.py" "$work/page.md" >/dev/null; then
    echo "not noticed: $text" >&2
    exit 1
  fi
done
