#!/usr/bin/env bash
# Makes everything that a release has in dist/, and tries each piece where nothing else is:
#   scripts/release.sh [PIECE...]
# Pieces: source, packages, wheel, addon, windows, web; without an argument all. They are built from
# the source archive of the last commit. Needs Debian 12, and root for the clean installation in
# which the packages are tried. Nothing is published.
#
# The version is that of cmake/version.cmake; the changelog must have a section for it, and the tag
# of the commit must be v and the version. Otherwise the script says that this is a preview.
set -euo pipefail
cd "$(dirname "$0")/.."

pieces=("$@")
[ $# -gt 0 ] || pieces=(source packages wheel addon windows web)
wants() { [[ " ${pieces[*]} " == *" $1 "* ]]; }

version=$(sed -n 's/set(FLBC_VERSION \(.*\))/\1/p' cmake/version.cmake)
for file in CITATION.cff web/package.json blender/local_barycentric_cage/blender_manifest.toml; do
  grep -qE "^ *\"?version\"?(:| =) \"?$version\"?,?$" $file || { echo "$file has another version"; exit 1; }
done
is_release=yes
grep -q "^## $version " CHANGELOG.md || { is_release=; echo "CHANGELOG.md has no section $version"; }
[ "$(git tag --points-at HEAD)" = "v$version" ] || { is_release=; echo "HEAD is not tagged v$version"; }
[ -z "$(git status --porcelain)" ] || { is_release=; echo "There are changes without a commit"; }
python3 -B benchmarks/paper/docs.py --behavior build/release/benchmarks/flbc_bench_paper ||
  { is_release=; echo "docs/results are of another program, or build/release has no flbc_bench_paper"; }
[ $is_release ] || echo "This is a preview of $version, not a release."

root=$PWD dist=$PWD/dist
mkdir -p "$dist"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
step() { echo "---- $*, after $SECONDS s"; }

# An empty folder, in which a piece is tried.
fresh() {
  rm -rf "$work/fresh"
  mkdir "$work/fresh"
  cd "$work/fresh"
}
cage=$root/meshes/3d/limb_cage.obj model=$root/meshes/3d/limb_model.obj
# try_program COMMAND... FLBC
try_program() {
  "$@" --version
  "$@" run "$cage" "$model" --vertices 2000 -q -o out
  [ -s out/model.glb ]
}

step "source archive"
name=libflbc-$version
git archive --prefix="$name/" -o "$dist/$name.tar.gz" HEAD
tar -xf "$dist/$name.tar.gz" -C "$work"
cd "$work/$name"
if wants packages || wants wheel || wants addon; then
  scripts/install_dependencies.sh netgen release
  cmake --preset package >/dev/null
  cmake --build --preset package
  for component in program core meshers; do
    cmake --install build/package --strip --component $component --prefix "$work/installed" >/dev/null
  done
  libraries=$(dirname "$work"/installed/lib/*/libflbc.so.*.*.*)
fi
build=$work/$name/build/package
# With the libraries of this build.
bundle() { LD_LIBRARY_PATH=$libraries /usr/bin/python3 "$root/scripts/release/bundle_libraries.py" "$@"; }

if wants packages; then
  step "Debian packages, in a clean Debian"
  status=0  # a compiler cache is not in the clean Debian
  env -u CMAKE_CXX_COMPILER_LAUNCHER tests/install/packages_test.sh "$build" "$work/$name" "$work/packages" || status=$?
  [ $status = 0 ] || { echo "The packages were not tried: status $status"; exit 1; }
  cp "$work"/packages/debs/*.deb "$dist"
fi

if wants wheel; then
  step "wheel, in a virtual environment"
  (cd "$work/$name/python" && FLBC_BUILD_DIR=$build /usr/bin/python3 -m pip wheel . \
    --no-build-isolation --no-deps --no-index -q -w "$work/wheel")
  bundle --wheel "$work"/wheel/*.whl "$dist"
  fresh
  /usr/bin/python3 -m venv --system-site-packages environment  # NumPy is the system's
  environment/bin/pip install --no-index --no-deps -q "$dist"/flbc-"$version"-*.whl
  environment/bin/python -c "import flbc
cage = flbc.read_cage('$cage')
assert flbc.solve(cage, flbc.mesh(cage, vertices=1000)).converged"
  # Nothing but the libraries that every Linux has comes from this machine.
  if ldd environment/lib/python3*/site-packages/flbc/_core.*.so | grep -v "$PWD" |
    grep -E '=> /' | grep -vE '/lib(c|m|dl|stdc\+\+|gcc_s)\.so'; then
    echo "The wheel needs these libraries of this machine"
    exit 1
  fi
fi

# make_addon SYSTEM BUILD: zips the add-on with the program in its folder bin.
make_addon() {
  cmake --build "$2" --target blender_addon
  fresh
  cmake -E tar xf "$2/blender/local_barycentric_cage.zip"
  cp -r "$work/bin-$1" local_barycentric_cage/bin
  cmake -E tar cf "$dist/local_barycentric_cage-$version-$1.zip" --format=zip local_barycentric_cage
}

if wants addon; then
  step "add-on for Blender on Linux"
  mkdir "$work/bin-linux"
  cp "$work/installed/bin/flbc" "$work/bin-linux"
  bundle "$work/bin-linux/lib" "$work/bin-linux/flbc"
  make_addon linux "$build"
  fresh
  cmake -E tar xf "$dist/local_barycentric_cage-$version-linux.zip"
  try_program env -i ./local_barycentric_cage/bin/flbc
fi

if wants windows; then
  step "flbc.exe, under Wine"
  cd "$work/$name"
  scripts/windows.sh
  mkdir -p "$work/bin-windows"
  cp build/windows/flbc.exe "$work/bin-windows"
  x86_64-w64-mingw32-strip "$work/bin-windows/flbc.exe"
  fresh
  mkdir flbc
  cp "$work/bin-windows/flbc.exe" "$root"/{LICENSE,README.md,CHANGELOG.md} flbc
  cmake -E tar cf "$dist/flbc-$version-windows.zip" --format=zip flbc
  fresh
  cmake -E tar xf "$dist/flbc-$version-windows.zip"
  try_program /usr/lib/wine/wine64 flbc/flbc.exe
  make_addon windows "$work/$name/build/windows"
fi

if wants web; then
  step "page and npm package"
  cd "$work/$name"
  scripts/web.sh
  cp web/dist/flbc.html "$dist/flbc-$version.html"
  npm pack --silent --pack-destination "$dist" ./web >/dev/null
  fresh
  npm init --yes >/dev/null
  npm install --silent --offline --no-audit --no-fund "$dist/flbc-$version.tgz"
  node --input-type=module -e 'import { Flbc } from "flbc"; const flbc = await Flbc.start();
    console.log(await flbc.version()); flbc.end();'
fi

step "checksums"
cd "$dist"
sha256sum -- *"$version"* >SHA256SUMS
cat SHA256SUMS
