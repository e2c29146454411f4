#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the matrix of extremes with many samples, and writes docs/extremes.csv and the chart
# docs/extremes.svg. The argument says how many times the samples of the test (4).
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh checked
build/checked/bin/extremes_report "${1:-4}" >docs/extremes.csv
python3 scripts/extremes_chart.py docs/extremes.csv docs/extremes.svg
