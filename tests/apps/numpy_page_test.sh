#!/usr/bin/env bash
# Whether the lines for NumPy of docs/how-to/weights.md do what flbc deform does:
#   numpy_page_test.sh PROGRAM REPOSITORY WORK
# PROGRAM: flbc. WORK: a folder for results, made anew.
# Ends with 77, which CTest counts as skipped, if Python has no NumPy.
set -euo pipefail

readonly flbc=$1 repository=$2 work=$3 skipped=77

# Debian's own Python has Debian's NumPy, whichever Python comes first.
python=python3
"$python" -c "import numpy" 2>/dev/null || python=/usr/bin/python3
if ! "$python" -c "import numpy" 2>/dev/null; then
  echo "skipped: Python's NumPy is missing (Debian: python3-numpy)"
  exit $skipped
fi
rm -rf "$work"
mkdir -p "$work/limb"
ln -s "$repository/meshes" "$work/meshes"
cd "$work"
"$flbc" solve meshes/3d/limb_cage.obj --method harmonic --vertices 800 -q -o limb/weights.npy \
  --model meshes/3d/limb_model.obj
"$flbc" deform meshes/3d/limb_model.obj --weights limb/weights.npy -q -o deformed.obj \
  --pose meshes/3d/limb_cage_pose.obj
{
  awk '/^```python$/ { inside = 1; next } /^```$/ { inside = 0 } inside' \
    "$repository/docs/how-to/weights.md"
  echo 'rows = [line.split()[1:4] for line in open("deformed.obj") if line.startswith("v ")]'
  echo 'error = abs(moved - np.array(rows, dtype=float)).max()'
  echo 'assert error < 1e-12, error'
} >program.py
"$python" program.py
