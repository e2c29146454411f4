#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the matrix of extremes, draws docs/pictures/extremes.svg, and writes the figures into
# docs/extremes.md. The argument says how many times the samples of the test to take (4).
#
# BRUME_BUILD names a build folder with tests; without it, the preset "checked" is built.
set -euo pipefail
cd "$(dirname "$0")/.."
if [[ -z ${BRUME_BUILD:-} ]]; then
  scripts/build.sh checked
  BRUME_BUILD=build/checked
fi
table=$(mktemp)
trap 'rm -f "$table"' EXIT
"$BRUME_BUILD/bin/extremes_report" "${1:-4}" >"$table"
python3 scripts/extremes_chart.py "$table" docs/pictures/extremes.svg docs/extremes.md
