#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# One way of using ODE, three times: as it is, with the calls of ode_ext in place of ODE's, and under
# the preload. All say of the same pairs that they collide; the last two give the same contacts to
# the bit; and under the preload passes are collided in batches.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tests/preload/idiom_test.sh BIN IDIOM
  BIN    the directory of idioms, idioms_by_api and ode_ext-run
  IDIOM  one of `idioms --list`
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
esac
[[ $# -eq 2 ]] || { usage >&2; exit 2; }
bin=$1 idiom=$2
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

failed=0
fail() {
  echo "idiom_test: $*" >&2
  failed=1
}

"$bin/idioms" "$idiom" > "$results/stock"
"$bin/idioms_by_api" "$idiom" --sound > "$results/api"
"$bin/ode_ext-run" --stats "$bin/idioms" "$idiom" --sound > "$results/preload" \
  2> "$results/statistics" || { cat "$results/statistics"; fail "the program failed"; }
cat "$results/statistics"

colliding=$(grep -c ' collide$' "$results/stock" || true)
echo "$(grep -c '^pair' "$results/stock") pairs, $colliding colliding; contacts" \
  "$(grep -c '^ ' "$results/stock" || true) of ODE, $(grep -c '^ ' "$results/preload" || true)"
[[ $colliding -gt 0 ]] || fail "nothing collides, which shows nothing"
diff <(grep '^pair' "$results/stock") <(grep '^pair' "$results/preload") ||
  fail "other pairs collide under the preload"
diff "$results/api" "$results/preload" ||
  fail "the preload gives other contacts than the calls of ode_ext"

# sum <words before a number>: over all colliders, of each of which a line tells; -1 if none does.
sum() {
  sed -n "s/.*$1 \\([0-9]*\\).*/\\1/p" "$results/statistics" | awk '{ s += $1 } END { print (NR > 0) ? s : -1 }'
}
collided=$(sum "with meshes,") alone=$(sum " s,") by_ode=$(sum "contacts;")
[[ $collided -ge 0 && $alone -ge 0 && $by_ode -ge 0 ]] || fail "the statistics lack a number"
[[ $by_ode -le 0 ]] || fail "ODE's own collider answered for $by_ode pairs"
case $idiom in
  without_a_pass) [[ $alone -gt 0 ]] || fail "no pair was collided" ;;
  updated | reinitialized) [[ $alone -gt 0 && $collided -gt 0 ]] || fail "no pair was collided" ;;
  *) [[ $alone -eq 0 && $collided -gt 0 ]] || fail "$alone pairs were not collided in a batch" ;;
esac
exit "$failed"
