#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What the preload costs a program without meshes: runs it alternately with and without.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tests/preload/overhead.sh BIN [RUNS [argument of boxes]...]
  BIN   the directory of boxes and ode_ext-run
  RUNS  of either kind (default: 10)
Prints the time of a pass [ms] of either: the least, the median, the most. Fails if bodies end
elsewhere, or if anything was loaded for them.
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  "") usage >&2; exit 2 ;;
esac
bin=$1 runs=${2:-10}
shift $(($# > 1 ? 2 : 1))
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

for ((i = 0; i < runs; ++i)); do
  "$bin/boxes" "$@" > "$results/plain"
  "$bin/ode_ext-run" --stats "$bin/boxes" "$@" > "$results/preload" 2> "$results/statistics"
  grep '^state' "$results/plain" > "$results/plain-states"
  grep '^state' "$results/preload" | cmp "$results/plain-states" -
  grep -q "nothing was loaded" "$results/statistics" ||
    { cat "$results/statistics" >&2; echo "overhead: something was loaded" >&2; exit 1; }
  for kind in plain preload; do
    sed -n 's/figures: \([0-9.]*\) ms.*/\1/p' "$results/$kind" >> "$results/$kind-times"
  done
done
cat "$results/statistics"
for kind in plain preload; do
  sort -n "$results/$kind-times" | awk -v kind="$kind" '
    { times[NR] = $1 }
    END { printf "%-8s %.4f %.4f %.4f\n", kind, times[1], times[int((NR + 1) / 2)], times[NR] }'
done
