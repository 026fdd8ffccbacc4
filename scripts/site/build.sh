#!/bin/sh
# Builds the pages of the site, all but the C++ interface.
# build.sh PROGRAM OUTPUT
set -eu
program=$(realpath "$1")
site=$(realpath -m "$2")
cd "$(dirname "$0")/../.."
FLBC_PROGRAM=$program PYTHONDONTWRITEBYTECODE=1 /usr/bin/mkdocs build --clean \
  --config-file scripts/site/mkdocs.yml --site-dir "$site"
