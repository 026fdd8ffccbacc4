#!/usr/bin/env bash
# Installs missing Debian packages; returns immediately if all are installed:
#   scripts/install_dependencies.sh [GROUP|PACKAGE...]
# Always those of the program and of the Python module. GROUP: netgen for the second 3D mesher; tests,
# browser, clang, release, or site, which scripts of these names need; openfoam with MPI
# and the headers of OpenFOAM; web, windows, or aarch64 with sources to compile for these systems.
set -euo pipefail

# The Python module is always there, because a build without it cannot be extended by it.
declare -A groups=(
  [program]="g++ cmake ninja-build pkg-config
    libeigen3-dev libsuitesparse-dev libopenblas0-serial libpugixml-dev
    libopenmesh-dev libcgal-dev libtet1.5-dev
    libcli11-dev nlohmann-json3-dev libpng-dev libjpeg-dev libcairo2-dev libgtest-dev
    pybind11-dev python3-dev python3-numpy"
  [netgen]="libnglib-dev"
  [tests]="make poppler-utils librsvg2-bin clang-format codespell mkdocs mkdocs-material
    libjs-katex python3-scipy python3-pytest python3-distributed python3-matplotlib mypy"
  [browser]="chromium fonts-dejavu-core"
  [clang]="clang libclang-rt-dev libomp-dev"
  [release]="dpkg-dev file help2man mmdebstrap patchelf python3-pip python3-setuptools python3-venv
    python3-wheel"
  [site]="doxygen mkdocs mkdocs-material libjs-katex"
  [openfoam]="openfoam openmpi-bin bzip2"
  [web]="emscripten nodejs libboost-dev libfast-float-dev zopfli"
  [windows]="g++-mingw-w64-x86-64-posix wine64 libboost-dev googletest"
  [aarch64]="g++-aarch64-linux-gnu qemu-user libboost-dev googletest"
)
headers=/usr/src/openfoam
needs_headers=
packages=()
sources=()  # source packages
needs_sources() {
  local package
  for package in "$@"; do
    [ -d "/usr/src/$package" ] || sources+=("$package")
  done
}
for name in program "$@"; do
  # shellcheck disable=SC2206
  packages+=(${groups[$name]:-$name})
  case $name in
    openfoam) [ -e $headers/src/dynamicMesh/lnInclude ] || needs_headers=yes ;;
    web)
      needs_sources tetgen pugixml
      command -v npm >/dev/null || packages+=(npm)  # other packages of Node.js have it
      ;;
    windows | aarch64) needs_sources tetgen pugixml zlib libpng1.6 openmesh ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ $((${#missing[@]} + ${#sources[@]})) -gt 0 ] || [ "$needs_headers" ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "These Debian packages are missing; install them as root: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
if [ ${#missing[@]} -gt 0 ]; then
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

# Source packages of the same versions have what the packages lack: headers of OpenFOAM, and sources
# to compile for other systems. A list of our own leaves the lists of the system as they are.
get_sources() {
  mkdir -p "$work/sources" "$work/lists/partial"
  if [ -e /etc/apt/sources.list.d/debian.sources ]; then
    sed 's/^Types:.*/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$work/sources/a.sources"
  else  # as mmdebstrap writes it
    sed -n 's/^deb /deb-src /p' /etc/apt/sources.list >"$work/sources/a.list"
  fi
  local from_sources=(apt-get -qq -o Dir::Etc::sourcelist=/dev/null
    -o Dir::Etc::sourceparts="$work/sources" -o Dir::State::lists="$work/lists"
    -o APT::Sandbox::User=root)
  "${from_sources[@]}" update
  # Of the release itself: only the original archive is used, which updates do not change.
  local release
  release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  "${from_sources[@]}" source --download-only "${@/%//$release}"
}
[ ${#sources[@]} -gt 0 ] || [ "$needs_headers" ] || exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
if [ "$needs_headers" ]; then
  get_sources openfoam
  tar -xf openfoam_*.orig.tar.* --wildcards --strip-components=1 '*/src' '*/wmake'
  for part in OpenFOAM OSspecific/POSIX meshTools finiteVolume dynamicMesh fileFormats surfMesh; do
    wmake/wmakeLnInclude -s "src/$part" 2>/dev/null
  done
  "${as_root[@]}" mkdir -p $headers
  "${as_root[@]}" cp -a src wmake $headers
fi
if [ ${#sources[@]} -gt 0 ]; then
  get_sources "${sources[@]}"
  for package in "${sources[@]}"; do
    "${as_root[@]}" mkdir -p "/usr/src/$package"
    "${as_root[@]}" tar -xf "${package}"_*.orig.tar.* --strip-components=1 -C "/usr/src/$package"
  done
fi
