#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Formatting, citations, and rules of the house that a script can see. Exits 1 and says what to
# mend.
set -uo pipefail
cd "$(dirname "$0")/.."
failed=0

if command -v clang-format >/dev/null; then
  git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror || failed=1
fi

scripts/check_references.sh || failed=1

# A module includes only modules above it.
modules=(core phase volume medium geometry material light camera film scene integrator io render study app)
for i in "${!modules[@]}"; do
  below=$(IFS='|'; echo "${modules[*]:i+1}")
  [ -z "$below" ] && continue
  if grep -nE "#include \"($below)/" -r "src/${modules[i]}"; then
    echo "src/${modules[i]} includes a module below it (docs/architecture.md)"
    failed=1
  fi
done

if git grep -nE '<(embree3|openvdb|OpenImageIO|tbb|CLI|fmt|pugixml)[/.]' -- 'src/*.h' ':!src/io/grid_*.h'; then
  echo "third-party headers belong in .cpp files"
  failed=1
fi
exit $failed
