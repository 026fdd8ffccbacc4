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

# A cage with 300 control points: a circle, and a wave running round it.
circle() { # HEIGHT
  awk -v h="$1" -v n=300 'BEGIN {
    pi = atan2(0, -1)
    for (k = 0; k < n; ++k) {
      a = 2 * pi * k / n; r = 1 + h * sin(3 * a); print "v", r * cos(a), r * sin(a), 0
    }
    printf "l"; for (k = 0; k <= n; ++k) printf " %d", k % n + 1; print ""
  }'
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

# ---- 3D: a sample, still, moving, rounded --------------------------------------------------------
cage=$meshes/3d/limb_cage.obj
pose=$meshes/3d/limb_cage_pose.obj
model=$meshes/3d/limb_model.obj
"$flbc" solve "$cage" --method harmonic --vertices 1500 -q -o limb.npy --model "$model" \
  --save-domain limb.mesh
check_model limb "$model" "$cage" "$pose" 54

export_skin limb "$model" "$cage" still.glb -k 4
check still.glb --model "$model"
export_skin limb "$model" "$cage" still.usda -k 4
node "$here/usd.mjs" still.usda "$model" 55

# ---- 3D: joints of a rigged cage, with the difference from the deformation by the cage -------------
node "$here/rig.mjs" "$cage" 60 rig.glb bent_cage.obj
"$flbc" deform "$model" --weights limb.npy --rest "$cage" --pose bent_cage.obj -q -o bent.obj
export_skin limb "$model" "$cage" bent.glb -k 4 --skeleton rig.glb --correct
check bent.glb --model "$model" --pose 0 "$model" --pose 1 bent.obj --turns --slots 4

# ---- 3D: the boundary of a mesh, where most vertices have few influences -------------------------
"$flbc" solve "$cage" --method harmonic --domain limb.mesh -q -o domain3.npy
prepare domain3 limb.mesh "$cage" "$pose" 4
export_skin domain3 limb.mesh "$cage" domain3.glb -k 4 --pose "$cage" "$pose" --fps 1
check domain3.glb --model limb.mesh --pose 0 limb.mesh --pose 1 domain3.4.posed.mesh

# ---- 3D: quadrilaterals with colors and a seam --------------------------------------------------
cube 1.5 0 >cube.obj
cube 1.5 0.3 >cube_pose.obj
globe >globe.obj
"$flbc" solve cube.obj --method harmonic --vertices 1000 -q -o globe.npy --model globe.obj
check_model globe globe.obj cube.obj cube_pose.obj 8 --texture

# ---- 3D: z points up. The model turns about the origin, which may be far away: feet stay on y = 0 --
upright() { awk -v CONVFMT=%.17g '$1 == "v" { y = $3; $3 = $4; $4 = -y } { print }' "$1"; }
for x in 5 500; do
  for part in globe cube cube_pose; do
    awk -v CONVFMT=%.17g -v x=$x '$1 == "v" { $2 += x; $4 += 1 } { print }' $part.obj >"standing_$part.obj"
  done
  cp globe.npy standing.npy
  prepare standing standing_globe.obj standing_cube.obj standing_cube_pose.obj 4
  upright standing_globe.obj >upright.obj
  upright standing.4.posed.obj >upright_pose.obj
  export_skin standing standing_globe.obj standing_cube.obj standing.glb -k 4 --up z
  check standing.glb --model upright.obj --texture
  export_skin standing standing_globe.obj standing_cube.obj standing.glb -k 4 --up z --fps 2 \
    --pose standing_cube.obj standing_cube_pose.obj
  check standing.glb --model upright.obj --pose 0 upright.obj --pose 0.5 upright_pose.obj --texture
done

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
node "$here/rig.mjs" cube.obj 60 cube_rig.glb bent_cube.obj
"$flbc" deform cut.obj --weights cut.npy --rest cube.obj --pose bent_cube.obj -q -o bent_cut.obj
export_skin cut globe.glb cube.obj bent_document.glb -k 4 --skeleton cube_rig.glb --correct
check bent_document.glb --model cut.obj --pose 0 cut.obj --pose 1 bent_cut.obj --turns --texture
# The result once more: its second scene shows the model as well.
export_skin cut kept.glb cube.obj again.glb -k 4 --pose cube.obj cube_pose.obj --fps 2
check again.glb --model cut.obj --pose 0 cut.obj --pose 0.5 cut.4.posed.obj --texture
"$flbc" convert painted.obj -q -o source.glb
export_skin globe source.glb cube.obj kept.glb -k 8 --pose cube.obj cube_pose.obj --fps 2
check kept.glb --model painted.obj --pose 0 painted.obj --pose 0.5 globe.8.posed.obj --texture

# ---- 2D: a sample, a mesh, and more joints than a byte can count ---------------------------------
cage=$meshes/2d/figure_cage.obj
pose=$meshes/2d/figure_cage_pose.obj
model=$meshes/2d/figure_model.obj
"$flbc" solve "$cage" --method harmonic --vertices 1500 -q -o figure.npy --model "$model" \
  --save-domain figure.obj
check_model figure "$model" "$cage" "$pose" 40
"$flbc" solve "$cage" --method harmonic --domain figure.obj -q -o domain2.npy
check_model domain2 figure.obj "$cage" "$pose" 40

circle 0 >circle.obj
circle 0.2 >circle_pose.obj
"$flbc" solve circle.obj --method harmonic --vertices 2000 -q -o circle.npy --save-domain disc.obj
check_model circle disc.obj circle.obj circle_pose.obj 300
