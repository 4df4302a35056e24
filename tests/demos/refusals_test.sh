#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What falling_objects cannot do it says before it begins, in a sentence and with exit code 2.
set -euo pipefail

program=${1:?usage: tests/demos/refusals_test.sh <falling_objects>}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
unset DISPLAY WAYLAND_DISPLAY

fail() { echo "refusals: $*" >&2; exit 1; }

# refused <words> <option>...
refused() {
  local words=$1 code=0
  shift
  timeout 60 "$program" --quiet "$@" > "$out/log" 2>&1 || code=$?
  [[ $code -eq 2 ]] || fail "$*: exit code $code instead of 2: $(cat "$out/log")"
  grep -q -F -e "$words" "$out/log" || fail "$*: does not say '$words': $(cat "$out/log")"
  ! grep -q "^scene " "$out/log" || fail "$*: is refused after the run"
}

printf 'v 5 0 0\nv 5.0000001 0 0\nv 5 0.0000001 0\nv 5 0 0.0000001\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' \
  > "$out/small.obj"
refused "the mesh '$out/small.obj' is too small or too flat to have a volume" --objects 4 --mesh "$out/small.obj"

# In 1 GB of memory.
(
  ulimit -v 1000000
  refused "not enough memory for 1000000 objects" --objects 1000000 --collider ode
)
echo "refusals: all before anything ran"
