#!/usr/bin/env bash
# Sources are formatted by clang-format 14, and words are spelled right: format_test.sh REPOSITORY
set -euo pipefail
cd "$1"
command -v codespell >/dev/null || { echo "skipped: codespell is missing"; exit 77; }
codespell
[[ $(clang-format --version 2>/dev/null) == *"version 14."* ]] ||
  { echo "skipped: clang-format 14 is missing"; exit 77; }
find . \( -name build -o -name out -o -name node_modules -o -name '.?*' \) -prune -o -type f \
  -regex '.*\.\(h\|cpp\|inl\)' -print0 | xargs -0 clang-format --dry-run -Werror
