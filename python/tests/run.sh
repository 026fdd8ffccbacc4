#!/bin/sh
# Runs a file of tests: run.sh PYTHON FILE WORK. Ends with 77, which CTest counts as skipped, where pytest
# is missing or the file needs a module that is not installed.
python=$1 file=$2 work=$3
"$python" -c "import pytest, scipy" 2>/dev/null ||
  { echo "skipped: python3-pytest or python3-scipy is missing"; exit 77; }
"$python" -m pytest -q -p no:cacheprovider -rs --basetemp "$work" "$file"
status=$?
# Nothing was collected, because the whole file was skipped.
[ $status -eq 5 ] && exit 77
exit $status
