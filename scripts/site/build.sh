#!/bin/sh
# Builds the pages of the site, all but the C++ interface.
# build.sh FOLDER_OF_COMMAND_PAGES OUTPUT
set -eu
help=$(realpath "$1")
site=$(realpath -m "$2")
cd "$(dirname "$0")/../.."
FLBC_HELP=$help PYTHONDONTWRITEBYTECODE=1 /usr/bin/mkdocs build --clean \
  --config-file scripts/site/mkdocs.yml --site-dir "$site"
