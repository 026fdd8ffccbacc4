#!/usr/bin/env bash
# Whether pages of flbc view do in a browser what flbc deform does:
#   browser_test.sh PROGRAM MESHES WORK [firefox]
# PROGRAM: flbc. MESHES: the folder of samples. WORK: a folder for results, made anew; pictures of
# the pages are left there. In Firefox, only dragging is tested.
# Ends with 77, which CTest counts as skipped, if Node.js, its module or a browser is missing.
set -euo pipefail

readonly flbc=$1 meshes=$2 work=$3 kind=${4:-chromium}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here

skip() {
  echo "skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "Node.js is missing (Debian: nodejs npm)"
if [ "$kind" = firefox ]; then
  browser=$(command -v firefox-esr || command -v firefox) ||
    skip "there is no Firefox (Debian: firefox-esr)"
  command -v xvfb-run >/dev/null || skip "xvfb-run is missing (Debian: xvfb xauth)"
else
  node --test "$here/modules_test.mjs" >/dev/null || { node --test "$here/modules_test.mjs"; exit 1; }
  browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    skip "there is no browser (Debian: chromium)"
fi
[ -d "$here/node_modules/puppeteer-core" ] ||
  skip "the module puppeteer-core is missing; run npm ci in tests/browser"
rm -rf "$work"
mkdir -p "$work"
cd "$work"

# Few influences; weights of any kind would do.
for name in 2d/figure 3d/limb; do
  cage=$meshes/${name}_cage.obj model=$meshes/${name}_model.obj out=${name#*/}
  "$flbc" solve "$cage" --method harmonic --vertices 1000 -q -o "$out.npy" --model "$model"
  "$flbc" sparsify "$out.npy" --cage "$cage" --points "$model" -k 8 -q -o "$out.mtx"
  "$flbc" view "$model" --weights "$out.mtx" --cage "$cage" --pose "$meshes/${name}_cage_pose.obj" \
    -q -o "$out.html"
  "$flbc" view "$model" --weights "$out.mtx" --cage "$cage" -q -o "${out}_rest.html"
done
if [ "$kind" = firefox ]; then
  # Without a display it offers no WebGL.
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24" \
    node "$here/page_test.mjs" "$browser" "$flbc" "$meshes" "$work"
  exit
fi

# A square with texture coordinates in a square whose bilinear weights are known, far from the
# origin.
awk -v OFMT=%.17g 'BEGIN {
  for (k = 0; k < 4; ++k) print "v", 1000 + (k == 1 || k == 2), 500 + (k > 1) }' >square_cage.obj
awk -v OFMT=%.17g 'BEGIN {
  n = 9
  print "mtllib square.mtl\nusemtl picture" > "square_model.obj"
  for (j = 0; j < n; ++j) for (i = 0; i < n; ++i) {
    x = i / (n - 1); y = j / (n - 1)
    print "v", 1000 + x, 500 + y, 0 > "square_model.obj"
    print "vt", x, y > "square_model.obj"
    print (1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y > "square.rows"
  }
  for (j = 0; j + 1 < n; ++j) for (i = 0; i + 1 < n; ++i) {
    a = j * n + i + 1
    printf "f %d/%d %d/%d %d/%d %d/%d\n", a, a, a + 1, a + 1, a + n + 1, a + n + 1, a + n, a + n \
      > "square_model.obj"
  } }'
awk 'BEGIN { print "%%MatrixMarket matrix coordinate real general\n81 4 324" }
  { for (k = 1; k <= 4; ++k) print NR, k, $k }' square.rows >square.mtx
printf 'newmtl picture\nmap_Kd deformation.png\n' >square.mtl
cp "$here/../../docs/images/deformation.png" .
"$flbc" view square_model.obj --weights square.mtx --cage square_cage.obj -q -o square.html

# The example for engines.
mkdir engine
cp "$here"/../../engines/* engine
cp limb.mtx engine/sparse_weights.mtx
cp "$meshes/3d/limb_cage.obj" engine/cage.obj
cp "$meshes/3d/limb_cage_pose.obj" engine/pose.obj
cp "$meshes/3d/limb_model.obj" engine/model.obj
"$flbc" deform engine/model.obj --weights limb.mtx --pose engine/pose.obj -q -o engine/moved.obj
node "$here/engine_test.mjs" "$browser" engine

node "$here/page_test.mjs" "$browser" "$flbc" "$meshes" "$work"
