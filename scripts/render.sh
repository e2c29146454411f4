#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds brume and renders the founding fog scene to fog.exr and fog.png.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh release
build/release/bin/brume render scenes/cornell_box_spheres_area_lights_fog.xml \
  -o fog.exr -o fog.png "$@"
