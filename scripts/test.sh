#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds brume with its checks on and runs the tests. Arguments go to
# ctest: `scripts/test.sh -L unit` runs the fast ones.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh checked
scripts/check.sh
ctest --preset checked -j "$(nproc)" "$@"
