#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# contact-pictures draws what contacts prints, and the contacts of ode_ext in them are as true as the
# README says.
set -euo pipefail

program=${1:?usage: tests/demos/contact_pictures_test.sh <contacts>}
script=$(cd "$(dirname "$0")/../.." && pwd)/scripts/contact-pictures
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "$1" >&2
  cat log >&2
  exit 1
}

/usr/bin/python3 -B "$script" --program "$program" --out pictures > log 2>&1 || fail "no pictures"
[[ $(grep -c ', ode_ext: ' log) -eq 6 ]] || fail "not all six pairs are drawn"
! grep ', ode_ext: ' log | grep -q 'no contact\|askew' || fail "a contact of ode_ext is wrong"
grep ', ODE: ' log | grep -q 'askew' || fail "stock ODE is drawn with the contacts of ode_ext"
for picture in overview plate-in-rim beam-on-ridges; do
  size=$(stat -c %s "pictures/$picture.svg")
  [[ $size -gt 10000 && $size -lt 150000 ]] || fail "$picture.svg has $size bytes"
done

status=0
"$program" > /dev/full 2> log || status=$?
[[ $status -eq 1 ]] || fail "contacts that cannot be written: exit code $status"

status=0
/usr/bin/python3 -B "$script" --program missing --out pictures > log 2>&1 || status=$?
[[ $status -eq 1 ]] || fail "a missing program is not noticed"
grep -q 'there is no missing' log || fail "a missing program is not named"

status=0
"$program" nothing > log 2>&1 || status=$?
[[ $status -ne 0 ]] || fail "an unknown pair is accepted"
status=0
ODE_EXT_DEVICE=nothing-like-it "$program" cube-on-cube > log 2>&1 || status=$?
[[ $status -eq 1 ]] || fail "a missing device is not an error"
grep -q '^contacts: ' log || fail "a missing device is not said"
echo "pictures are drawn, and true"
