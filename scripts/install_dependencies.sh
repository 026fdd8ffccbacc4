#!/usr/bin/env bash
# Installs missing Debian packages, and the named ones. Returns immediately if all are installed.
# "openfoam" also brings MPI and the headers of OpenFOAM. "web", "windows", and "aarch64" bring what
# scripts/web.sh and these presets need.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libeigen3-dev libsuitesparse-dev libopenblas0-serial  # core; OpenBLAS halves factoring
  libpugixml-dev                          # file formats
  libopenmesh-dev libcgal-dev libtet1.5-dev libnglib-dev  # optional components
  libcli11-dev nlohmann-json3-dev libpng-dev libtinygltf-dev libcairo2-dev  # the program flbc
  pybind11-dev python3-dev                # the Python module
  libgtest-dev poppler-utils librsvg2-bin python3-numpy  # tests; the last three read results
  python3-scipy python3-pytest            # tests of the Python module
  mkdocs mkdocs-material libjs-katex groff-base  # tests of pages
  clang-format codespell                  # test of sources
)
headers=/usr/src/openfoam
needs_headers=
sources=()  # source packages
needs_sources() {
  local package
  for package in "$@"; do
    [ -d "/usr/src/$package" ] || sources+=("$package")
  done
}
for package in "$@"; do
  case $package in
    openfoam)
      packages+=(openfoam openmpi-bin bzip2)
      [ -e $headers/src/dynamicMesh/lnInclude ] || needs_headers=yes
      ;;
    web)
      packages+=(emscripten nodejs libboost-dev libfast-float-dev)
      needs_sources tetgen pugixml
      ;;
    windows)
      packages+=(g++-mingw-w64-x86-64-posix wine64 libboost-dev googletest)
      needs_sources tetgen pugixml zlib libpng1.6 openmesh
      ;;
    aarch64)
      packages+=(g++-aarch64-linux-gnu qemu-user libboost-dev googletest)
      needs_sources tetgen pugixml zlib libpng1.6 openmesh
      ;;
    *) packages+=("$package") ;;
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
  sed 's/^Types:.*/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$work/sources/a.sources"
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
