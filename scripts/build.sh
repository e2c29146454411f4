#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing (Debian 12) and builds the preset named: release (default), checked,
# debug, asan, tsan.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

packages=(
  git cmake ninja-build ccache g++
  libglm-dev libpcg-cpp-dev
  libopenvdb-dev libnanovdb-dev libboost-iostreams-dev libblosc-dev zlib1g-dev
  libembree-dev libopenimageio-dev openimageio-tools libopenexr-dev libimath-dev
  libpugixml-dev libtbb-dev libcli11-dev libfmt-dev nlohmann-json3-dev
  libbenchmark-dev libgtest-dev libgmock-dev clang-format
)
missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' ||
    missing+=("$package")
done
if ((${#missing[@]})); then
  echo "Installing ${missing[*]}"
  sudo=()
  ((EUID == 0)) || sudo=(sudo)
  "${sudo[@]}" apt-get update -qq
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset"
