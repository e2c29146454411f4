#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Holds brume against the laws in tests/statistics and writes the table in docs/validation.md.
#
#   scripts/validate.sh            the laws that every run of the tests holds, into docs/validation.md
#   scripts/validate.sh --long     all slabs of the table too, a few hours, into docs/validation.md
#   scripts/validate.sh FILTER     prints the rows of the tests that FILTER names, long or not, as
#                                  'Slab.NormalIncidence/g_0_albedo_1_tau_2' or 'Hulst*'
#
# BRUME_BUILD names a build folder with tests; without it, the preset "checked" is built.
set -euo pipefail
cd "$(dirname "$0")/.."
filter=${1:-*}
[[ $# == 0 ]] || export BRUME_LONG=1
[[ $filter != --long ]] || filter='*'
if [[ -z ${BRUME_BUILD:-} ]]; then
  scripts/build.sh checked
  BRUME_BUILD=build/checked
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export BRUME_VALIDATION_ROWS=$work/rows GTEST_TOTAL_SHARDS GTEST_BRIEF=1
GTEST_TOTAL_SHARDS=$(nproc)
touch "$work/rows"
failed=0
processes=()
for ((shard = 0; shard < GTEST_TOTAL_SHARDS; ++shard)); do
  GTEST_SHARD_INDEX=$shard "$BRUME_BUILD/bin/statistics_test" --gtest_filter="$filter" \
    >"$work/log.$shard" 2>&1 &
  processes+=($!)
done
for process in "${processes[@]}"; do wait "$process" || failed=1; done
((failed == 0)) || cat "$work"/log.* >&2

sort -t$'\t' -k7,7V -k1,1 "$work/rows" | awk -F'\t' '
  BEGIN {
    print "| law | source | expected | brume | z | test |"
    print "|---|---|---|---|---|---|"
  }
  {
    printf "| %s | %s | %s | %s ± %.2g | %.2f | `%s` |\n", $1, $2, $3, $4, $5, $6, $7
    sum += $6 * $6
    if ($6 * $6 > worst * worst) worst = $6
  }
  END {
    if (NR > 0)
      printf "\n%d rows; mean square of z %.3f; largest |z| %.2f.\n", NR, sum / NR, \
        worst < 0 ? -worst : worst
  }' >"$work/table"

if [[ $filter == '*' && $failed == 0 ]]; then
  awk -v table="$work/table" '
    /<!-- table: end -->/ { inside = 0 }
    !inside
    /<!-- table: begin/ { inside = 1; print ""; while ((getline line < table) > 0) print line; print "" }
  ' docs/validation.md >"$work/page"
  cp "$work/page" docs/validation.md
  tail -1 "$work/table"
else
  cat "$work/table"
fi
exit "$failed"
