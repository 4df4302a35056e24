#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# figures.py draws what a run of paper has measured, and says in a sentence what it has not.
set -euo pipefail

program=${1:?usage: tests/demos/figures_test.sh <paper>}
figures=$(cd "$(dirname "$0")/../.." && pwd)/demos/paper/figures.py
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "$1" >&2
  cat log >&2
  exit 1
}

# expect <exit code> <sentence in the output> <argument>...
expect() {
  local code=$1 sentence=$2 status=0
  shift 2
  /usr/bin/python3 -B "$figures" --results results --doc page.md "$@" > log 2>&1 || status=$?
  ! grep -q Traceback log || fail "figures.py $*: a traceback"
  [[ $status -eq $code ]] || fail "figures.py $*: exit code $status, expected $code"
  grep -qF "$sentence" log || fail "figures.py $*: does not say '$sentence'"
}

expect 1 "the scene 'rigid' was not run"

names=full,full-monolithic,iterative,iterative-monolithic
"$program" run --objects 12 --steps 6 --every 3 --quiet --out results/rigid \
  --configurations "$names,${names//,/-count,}-count" > log 2>&1 || fail "the run failed"

expect 0 page.md --only figure6
for file in results/figure6a.png results/figure6b.png; do
  [[ $(head -c 4 "$file" | tail -c 3) == PNG ]] || fail "$file is no picture"
done
grep -qF '| Figure 6, full rays | 1.31 |' page.md || fail "the page has no row for figure 6"
! grep -q 'not measured |' page.md || fail "the page lacks something that was measured"

expect 1 "the results of the scene 'rigid' hold no configuration 'full-exact'" --only table1
grep -qF '| rigid, full rays | 2.84 ms | not measured |' page.md || fail "table 1 says nothing"

gzip results/rigid/steps.csv
expect 0 page.md --only figure6
rm results/rigid/summary.json
expect 1 "there is no results/rigid/summary.json" --only figure6
echo "all is drawn, and what is missing is said"
