#!/usr/bin/env bash
# Whether skins of flbc export are valid. GltfSkinTest and ExportCommand move them as the
# specification says, and blender_test.sh in Blender:
#   gltf_test.sh PROGRAM MESHES WORK
# PROGRAM: flbc. MESHES: the folder of samples. WORK: a folder for results, made anew.
# Ends with 77, which CTest counts as skipped, if Node.js or the validator is missing.
set -euo pipefail

readonly flbc=$1 meshes=$2 work=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here skipped=77

if ! command -v node >/dev/null; then
  echo "skipped: Node.js is missing (Debian: nodejs npm)"
  exit $skipped
fi
if [ ! -d "$here/node_modules/gltf-validator" ]; then
  echo "skipped: the module gltf-validator is missing; run npm ci in tests/gltf"
  exit $skipped
fi
rm -rf "$work"
mkdir -p "$work"
cd "$work"

export_skin() { # NAME MODEL CAGE OUTPUT [OPTIONS]
  "$flbc" export "$2" --weights "$1.npy" --cage "$3" -q -o "$4" "${@:5}"
}

# Samples: still, moving, rounded.
for name in 2d/figure 3d/limb; do
  sample=${name#*/} model=$meshes/${name}_model.obj cage=$meshes/${name}_cage.obj
  "$flbc" solve "$cage" --method harmonic --vertices 1500 -q -o "$sample.npy" --model "$model"
  export_skin "$sample" "$model" "$cage" "$sample.still.glb" -k 4
  for options in "-k 4" "-k 8" "-k 4 --quantize 16" "-k 8 --quantize 8"; do
    # shellcheck disable=SC2086
    export_skin "$sample" "$model" "$cage" "$sample${options// /}.glb" $options \
      --pose "$cage" "$meshes/${name}_cage_pose.obj" --fps 2
  done
done

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

# With a picture, and documents that get a cage once and twice.
printf 'v -2 -2 -2\nv 2 -2 -2\nv -2 2 -2\nv 2 2 -2\nv -2 -2 2\nv 2 -2 2\nv -2 2 2\nv 2 2 2\n%s\n' \
  "f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6" >cube.obj
globe >globe.obj
"$flbc" solve cube.obj --method harmonic --vertices 1000 -q -o globe.npy --model globe.obj
export_skin globe globe.obj cube.obj globe.glb -k 4
base64 -d >dot.png <<<"iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"
printf 'newmtl green\nKd 0 1 0\nd 0.5\nnewmtl dot\nmap_Kd dot.png\n' >look.mtl
{
  echo "mtllib look.mtl"
  grep -v '^f' globe.obj
  grep '^f' globe.obj | awk 'NR == 1 { print "usemtl green" } NR == 60 { print "usemtl dot" } { print }'
} >painted.obj
export_skin globe painted.obj cube.obj painted.glb -k 8
"$flbc" convert painted.obj -q -o source.glb
export_skin globe source.glb cube.obj kept.glb -k 4 --pose cube.obj cube.obj
export_skin globe kept.glb cube.obj again.glb -k 8 --pose cube.obj cube.obj

node "$here/check.mjs" ./*.glb
