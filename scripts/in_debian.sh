#!/usr/bin/env bash
# Usage: scripts/in_debian.sh SUITE COMMAND...
# Runs a command in a Debian of its own, for example
#   scripts/in_debian.sh trixie scripts/test.sh -R solver
# It has the files of this folder, in /flbc, and its own build folder there. mmdebstrap makes it once,
# in ~/.cache/flbc/SUITE; delete that folder to start over. Needs root.
set -euo pipefail
cd "$(dirname "$0")/.."

[ $# -ge 2 ] || { sed -n '2,7s/^# //p' scripts/in_debian.sh; exit 2; }
suite=$1
shift
root=${XDG_CACHE_HOME:-$HOME/.cache}/flbc/$suite
command -v mmdebstrap >/dev/null || scripts/install_dependencies.sh mmdebstrap
if [ ! -e "$root/made" ]; then
  rm -rf --one-file-system "$root"
  mkdir -p "$root"
  mmdebstrap --quiet --mode=root --variant=apt --include=ca-certificates,git "$suite" "$root"
  touch "$root/made"
fi
cp /etc/resolv.conf "$root/etc"
# Files keep their times, so that a second build compiles what has changed.
mkdir -p "$root/flbc"
find "$root/flbc" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
{ printf '.git\0' && git ls-files -co --exclude-standard -z; } |
  tar -c --null --ignore-failed-read -T - 2>/dev/null | tar -x -C "$root/flbc" --no-same-owner
# shellcheck disable=SC2016
exec unshare --mount sh -euc '
  mount --rbind /dev "$0/dev"
  mount -t proc proc "$0/proc"
  exec chroot "$0" env -i HOME=/root LANG=C.UTF-8 TERM="${TERM:-dumb}" \
    PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "cd /flbc && exec \"\$@\"" sh "$@"' "$root" "$@"
