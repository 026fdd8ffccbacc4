#!/usr/bin/env bash
# Whether skins of flbc export are valid and move in other programs as flbc deform moves the model:
#   gltf_test.sh PROGRAM MESHES WORK
# PROGRAM: flbc. MESHES: the folder of samples. WORK: a folder for results, made anew.
# Ends with 77, which CTest counts as skipped, if Node.js or its modules are missing.
set -euo pipefail

readonly flbc=$1 meshes=$2 work=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here skipped=77

if ! command -v node >/dev/null; then
  echo "skipped: Node.js is missing (Debian: nodejs npm)"
  exit $skipped
fi
for module in gltf-validator three; do
  if [ ! -d "$here/node_modules/$module" ]; then
    echo "skipped: the module $module is missing; run npm ci in tests/gltf"
    exit $skipped
  fi
done
rm -rf "$work"
mkdir -p "$work"
cd "$work"

# ---- models the samples do not have --------------------------------------------------------------
# A cube, as cage, and moved to a pose.
cube() { # EDGE SHEAR
  awk -v e="$1" -v s="$2" 'BEGIN {
    for (k = 0; k < 8; ++k) {
      x = k % 2 * 2 - 1; y = int(k / 2) % 2 * 2 - 1; z = int(k / 4) * 2 - 1
      print "v", e * x + s * y * z, e * y + s * s * x, e * z * (1 + s * x)
    }
    print "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6"
  }'
}

# A globe of quadrilaterals, triangles at the poles, with colors, and texture coordinates that part
# along a meridian.
globe() {
  awk -v n=12 -v m=16 'BEGIN {
    pi = atan2(0, -1)
    print "v 0 0 1 1 0 0\nv 0 0 -1 0 0 1"
    for (i = 1; i < n; ++i) for (j = 0; j < m; ++j)
      print "v", sin(pi * i / n) * cos(2 * pi * j / m), sin(pi * i / n) * sin(2 * pi * j / m),
        cos(pi * i / n), i / n, j / m, 0.5
    for (i = 0; i <= n; ++i) for (j = 0; j <= m; ++j) print "vt", j / m, 1 - i / n
    for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
      face = "f"
      if (i > 0) face = face corner(i, j)
      face = face corner(i + 1, j)
      if (i < n - 1) face = face corner(i + 1, j + 1)
      print face corner(i, j + 1)
    }
  }
  function corner(i, j) {
    return " " (i == 0 ? 1 : i == n ? 2 : 3 + (i - 1) * m + j % m) "/" (i * (m + 1) + j + 1)
  }'
}

# Two keyframes that lead from a cage to its pose.
keyframes() { # CAGE POSE
  paste -d' ' <(grep '^v ' "$1") <(grep '^v ' "$2") | awk '
    BEGIN { print "k 0.5\nk 2" }
    { print "c 0 0 0 0"; printf "c 1 %.17g %.17g %.17g\n", $6 - $2, $7 - $3, $8 - $4 }'
}

# ---- steps ---------------------------------------------------------------------------------------
# The weights of a model, and the poses in which flbc deform puts it with at most K of them.
prepare() { # NAME MODEL CAGE POSE K
  "$flbc" sparsify "$1.npy" --cage "$3" --points "$2" -k "$5" --pose "$3" --pose "$4" -q -o "$1.$5.mtx"
  "$flbc" deform "$2" --weights "$1.$5.mtx" --rest "$3" --pose "$4" -q -o "$1.$5.posed.${2##*.}"
}

export_skin() { # NAME MODEL CAGE OUTPUT [OPTIONS]
  "$flbc" export "$2" --weights "$1.npy" --cage "$3" -o "$4" "${@:5}"
}

check() { node "$here/check.mjs" "$@"; }

# Everything about a model and a pose, with few influences and with many.
check_model() { # NAME MODEL CAGE POSE JOINTS [OPTIONS OF CHECK]
  local name=$1 model=$2 cage=$3 pose=$4 joints=$5 k
  for k in 4 8; do
    prepare "$name" "$model" "$cage" "$pose" $k
    export_skin "$name" "$model" "$cage" "$name.$k.glb" -k $k --pose "$cage" "$pose" --fps 2
    local moved=$name.$k.posed.${model##*.}
    check "$name.$k.glb" --model "$model" --pose 0 "$model" --pose 0.5 "$moved" --slots $k \
      --joints "$joints" "${@:6}"
  done
}

# ---- 3D: a sample, still, moving -----------------------------------------------------------------
cage=$meshes/3d/limb_cage.obj
pose=$meshes/3d/limb_cage_pose.obj
model=$meshes/3d/limb_model.obj
"$flbc" solve "$cage" --method harmonic --vertices 1500 -q -o limb.npy --model "$model"
check_model limb "$model" "$cage" "$pose" 54

export_skin limb "$model" "$cage" still.glb -k 4
check still.glb --model "$model"

keyframes "$cage" "$pose" >keyframes.txt
export_skin limb "$model" "$cage" keyframes.glb -k 4 --keyframes keyframes.txt
check keyframes.glb --model "$model" --pose 0.5 "$model" --pose 2 limb.4.posed.obj

# ---- 3D: quadrilaterals with colors and a seam --------------------------------------------------
cube 1.5 0 >cube.obj
cube 1.5 0.3 >cube_pose.obj
globe >globe.obj
"$flbc" solve cube.obj --method harmonic --vertices 1000 -q -o globe.npy --model globe.obj
check_model globe globe.obj cube.obj cube_pose.obj 8 --texture

# ---- 3D: two materials and a picture -------------------------------------------------------------
base64 -d >dot.png <<<"iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"
printf 'newmtl green\nKd 0 1 0\nd 0.5\nnewmtl dot\nmap_Kd dot.png\n' >look.mtl
{
  echo "mtllib look.mtl"
  grep -v '^f' globe.obj
  grep '^f' globe.obj | awk 'NR == 1 { print "usemtl green" } NR == 60 { print "usemtl dot" } { print }'
} >painted.obj
# With eight slots, which the viewer does not read: outside browsers it decodes no pictures.
export_skin globe painted.obj cube.obj painted.glb -k 8 --pose cube.obj cube_pose.obj --fps 2
check painted.glb --model painted.obj --pose 0 painted.obj --pose 0.5 globe.8.posed.obj --texture

# ---- 3D: documents that get a cage --------------------------------------------------------------
"$flbc" convert globe.obj -q -o globe.glb
"$flbc" convert globe.glb -q -o cut.obj # of the same triangles, which decide the reduction
cp globe.npy cut.npy
prepare cut cut.obj cube.obj cube_pose.obj 4
export_skin cut globe.glb cube.obj kept.glb -k 4 --pose cube.obj cube_pose.obj --fps 2
check kept.glb --model cut.obj --pose 0 cut.obj --pose 0.5 cut.4.posed.obj --texture
# The result once more: its second scene shows the model as well.
export_skin cut kept.glb cube.obj again.glb -k 4 --pose cube.obj cube_pose.obj --fps 2
check again.glb --model cut.obj --pose 0 cut.obj --pose 0.5 cut.4.posed.obj --texture
"$flbc" convert painted.obj -q -o source.glb
export_skin globe source.glb cube.obj kept.glb -k 8 --pose cube.obj cube_pose.obj --fps 2
check kept.glb --model painted.obj --pose 0 painted.obj --pose 0.5 globe.8.posed.obj --texture

# ---- 2D: a sample ---------------------------------------------------------------------------------
cage=$meshes/2d/figure_cage.obj
pose=$meshes/2d/figure_cage_pose.obj
model=$meshes/2d/figure_model.obj
"$flbc" solve "$cage" --method harmonic --vertices 1500 -q -o figure.npy --model "$model"
check_model figure "$model" "$cage" "$pose" 40
