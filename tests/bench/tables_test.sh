#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The tables of the documents are those that the results make, and a figure that is another is found.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
tables=$root/tests/bench/tables.py
results=$root/docs/results/pocl-2core
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
  echo "tables: $*" >&2
  exit 1
}
# refuses <text> <arguments>...: it fails, and says that.
refuses() {
  local text=$1 said
  shift
  ! said=$("$tables" "$@" 2>&1) || fail "accepts: $*"
  grep -q -F -- "$text" <<< "$said" || fail "does not say '$text' but: $said"
}

"$tables" --check "$results" "$root/docs/performance.md" "$root/README.md" ||
  fail "scripts/measure was run and tests/bench/tables.py was not"

cp "$root/docs/performance.md" "$work/other.md"
first=$(grep -n -m1 'tables.py bowl: begin' "$work/other.md" | cut -d: -f1)
sed -i "$((first + 4))s/[0-9]/7&/" "$work/other.md"
refuses "has other figures" --check "$results" "$work/other.md"
"$tables" "$results" "$work/other.md"
cmp "$work/other.md" "$root/docs/performance.md" || fail "does not put the tables back"

cp -r "$results" "$work/results"
rm "$work/results"/tori-*.txt
refuses "has no tori-1.txt" "$work/results"
echo 'no marks' > "$work/empty.md"
refuses "there is no mark" "$results" "$work/empty.md"
