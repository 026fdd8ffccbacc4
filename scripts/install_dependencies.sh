#!/usr/bin/env bash
# Installs missing Debian packages, and the named ones. Returns immediately if all are installed.
# "openfoam" also brings MPI and the headers of OpenFOAM.
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
packages+=("$@")
headers=/usr/src/openfoam
needs_headers=
if [[ " $* " == *" openfoam "* ]]; then
  packages+=(openmpi-bin bzip2)
  [ -e $headers/src/dynamicMesh/lnInclude ] || needs_headers=yes
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || [ "$needs_headers" ] || exit 0

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

# The package has no headers, but the source package of the same version has.
if [ "$needs_headers" ]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  mkdir -p "$work/sources" "$work/lists/partial"
  sed 's/^Types:.*/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$work/sources/a.sources"
  from_sources=(apt-get -qq -o Dir::Etc::sourcelist=/dev/null
    -o Dir::Etc::sourceparts="$work/sources" -o Dir::State::lists="$work/lists"
    -o APT::Sandbox::User=root)
  cd "$work"
  "${from_sources[@]}" update
  "${from_sources[@]}" source --download-only openfoam
  tar -xf openfoam_*.orig.tar.* --wildcards --strip-components=1 '*/src' '*/wmake'
  for part in OpenFOAM OSspecific/POSIX meshTools finiteVolume dynamicMesh fileFormats surfMesh; do
    wmake/wmakeLnInclude -s "src/$part" 2>/dev/null
  done
  "${as_root[@]}" mkdir -p $headers
  "${as_root[@]}" cp -a src wmake $headers
fi
