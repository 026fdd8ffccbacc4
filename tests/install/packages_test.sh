#!/usr/bin/env bash
# Usage: packages_test.sh BUILD SOURCE WORK
# Makes the packages of a build and installs the runtime packages with what they depend on, and
# nothing else, into a Debian of their own, where the program solves and runs on a sample. The other
# packages and a compiler follow; then programs of pkg-config and an example are compiled. Skipped
# (77) where no such Debian can be made.
set -euo pipefail
build=$1 source=$2 work=$3

skip() {
  echo "skipped: $1"
  exit 77
}
[ "$(id -u)" = 0 ] || skip "only root makes a root"
for tool in mmdebstrap dpkg-shlibdeps cpack; do
  command -v $tool >/dev/null || skip "$tool is missing"
done

rm -rf --one-file-system "$work"
mkdir -p "$work/debs"
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work/debs" >"$work/cpack.log" ||
  { cat "$work/cpack.log"; exit 1; }
rm -rf --one-file-system "$work/debs/_CPack_Packages"
packages=("$work"/debs/*.deb)

field() { dpkg-deb -f "$1" "$2"; }
# Dependencies of packages but for each other.
depends_of() {
  local all=""
  for package in "${packages[@]}"; do all+=" $(field "$package" Package) "; done
  for package in "$@"; do field "$package" Depends | tr ',' '\n'; done |
    sed 's/|.*//; s/(.*//; s/ //g' | sort -u | while read -r name; do
    [[ -z $name || $all == *" $name "* ]] || echo "$name"
  done | paste -sd,
}
root=$work/root
install_packages() {
  cp "$@" "$root/debs"
  (cd "$root" && chroot . sh -c 'dpkg -i "$@"' - "${@/#*\//debs/}") >"$work/dpkg.log" 2>&1 ||
    { cat "$work/dpkg.log"; exit 1; }
}

# ---- the program, with what runs alone -----------------------------------------------------------
runtime=()
for package in "${packages[@]}"; do
  [[ $(field "$package" Package) == *-dev ]] || runtime+=("$package")
  chroot_files=$(dpkg-deb -c "$package")
  [[ $chroot_files == *"/copyright"* ]] || { echo "$package has no copyright"; exit 1; }
done
mmdebstrap --quiet --mode=root --variant=apt --dpkgopt=force-unsafe-io --skip=cleanup/apt/lists \
  --include="$(depends_of "${runtime[@]}")" "$(. /etc/os-release && echo "$VERSION_CODENAME")" \
  "$root" >"$work/root.log" 2>&1 || { cat "$work/root.log"; skip "no Debian to be had"; }
mkdir "$root/debs"
install_packages "${runtime[@]}"
cp -r "$source/meshes" "$root/meshes"
use() { chroot "$root" env OMP_WAIT_POLICY=passive "$@"; }
use flbc --version
use flbc solve meshes/2d/letter_cage.obj --model meshes/2d/letter_model.obj -o w.npy
use flbc solve meshes/3d/limb_cage.obj --model meshes/3d/limb_model.obj --vertices 2000 -o v.npy
use flbc check meshes/3d/limb_cage.obj --model meshes/3d/limb_model.obj --weights v.npy
use flbc run meshes/3d/limb_cage.obj meshes/3d/limb_model.obj --vertices 2000 -q -o out
if [[ " ${runtime[*]} " == *python3-flbc* ]]; then
  use python3 -c "import flbc
cage = flbc.read_cage('meshes/3d/limb_cage.obj')
assert flbc.solve(cage, flbc.mesh(cage, vertices=1000)).converged"
fi
[ -s "$root/out/model.glb" ] || { echo "no model.glb"; exit 1; }

# ---- programs of others, with all packages -------------------------------------------------------
cp /etc/resolv.conf "$root/etc"
mapfile -t -d , further < <(printf %s "$(depends_of "${packages[@]}")")
chroot "$root" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
  g++ cmake make pkg-config "${further[@]}" >"$work/apt.log" 2>&1 ||
  { cat "$work/apt.log"; skip "no Debian to be had"; }
install_packages "${packages[@]}"
cp -r "$source/tests/install/consumer" "$root/consumer"
cat >"$root/example.cmake" <<'END'
cmake_minimum_required(VERSION 3.25)
project(example LANGUAGES CXX)
find_package(flbc CONFIG REQUIRED COMPONENTS cgal tetgen openmesh)
add_executable(bind_and_deform /usr/share/doc/flbc/examples/bind_and_deform.cpp)
target_link_libraries(bind_and_deform PRIVATE flbc::openmesh flbc::tetgen flbc::cgal)
END
cat >"$root/compile.sh" <<'END'
set -eu
export OMP_WAIT_POLICY=passive
cd /consumer
for name in use_core use_io; do
  g++ -std=c++17 $name.cpp $(pkg-config --cflags --libs --static flbc) -o $name
  ./$name
done
mkdir /example && mv /example.cmake /example/CMakeLists.txt
cmake -S /example -B /example/build >/dev/null
cmake --build /example/build
cd /meshes/3d
/example/build/bind_and_deform limb_cage.obj limb_model.obj limb_cage_pose.obj /moved.obj
test -s /moved.obj
END
chroot "$root" sh /compile.sh
rm -rf --one-file-system "$root"
