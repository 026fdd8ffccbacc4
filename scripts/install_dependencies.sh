#!/usr/bin/env bash
# Installs missing Debian packages, and the named ones. Returns immediately if all are installed.
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
  mkdocs mkdocs-material libjs-katex codespell groff-base  # tests of pages
)
packages+=("$@")

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "These Debian packages are missing; install them as root: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
