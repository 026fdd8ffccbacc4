#!/bin/sh
# Pages are short and plain, and the check of them notices what is wrong.
# prose_test.sh REPOSITORY WORK
set -eu
repository=$1 work=$2
/usr/bin/python3 -B "$repository/scripts/check_prose.py"
mkdir -p "$work"
long=$(seq -s ' ' 1 40)
for text in "A sentence of $long words." "It lies beside the cage." "See \`apps/absent.cpp\`." "It took 3 % longer." \
  "Commit 0123abc is faster." "The solve takes 0.3 s." "It needs 12 MiB." "It is 3 times as long." \
  "It takes about seven seconds." "It is two to three times as fast."; do
  printf '# Title\n\n%s\n' "$text" >"$work/page.md"
  if /usr/bin/python3 -B "$repository/scripts/check_prose.py" "$work/page.md" >/dev/null; then
    echo "not noticed: $text" >&2
    exit 1
  fi
done
printf '# Title\n\nThe solve takes <!--n:race.seconds-->0.3<!--/n--> s, and 60 s at most (default: 60 s).\n' >"$work/page.md"
/usr/bin/python3 -B "$repository/scripts/check_prose.py" "$work/page.md"
rm -rf "$work/chain"
mkdir -p "$work/chain"
printf '# A\n\nNext: [B](b.md)\n' >"$work/chain/index.md"
printf '# B\n\nNext: [A](index.md)\n' >"$work/chain/b.md"
/usr/bin/python3 -B "$repository/scripts/check_prose.py" "$work/chain"
printf '# C\n\nNext: [B](b.md)\n' >"$work/chain/c.md"
/usr/bin/python3 -B "$repository/scripts/check_prose.py" "$work/chain" | grep 'c\.md: the "Next" links' >/dev/null ||
  { echo "a page outside of the chain was not noticed" >&2; exit 1; }
