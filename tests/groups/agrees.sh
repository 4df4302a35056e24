#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Whether contacts are the same to the byte where work-groups go through pairs and regions together
# (kernels/lib/group.h), emulated on the processor, and where work-items do alone.
# usage: agrees.sh <falling_objects> <libgroup_emulation.so>
set -euo pipefail
program=$1
emulation=$2
log=$(mktemp)
trap 'rm -f "$log"' EXIT

fail() {
  echo "agrees.sh: $*" >&2
  cat "$log" >&2
  exit 1
}

hash_of() {  # <library to be loaded before, or nothing> <command>...
  local library=$1
  shift
  env ${library:+LD_PRELOAD="$library"} "$@" 2> "$log" | sed -n 's/.*contact hash *//p'
}

# In a pile; driven by ODE, which lets bodies sink into one another; and with sheets, which are open.
for scene in "--objects 40 --steps 60" "--objects 16 --steps 80 --collider ode --compare" \
  "--scene rigid-deformable --objects 4 --sheets 1 --steps 60"; do
  read -ra options <<< "$scene --quiet --no-window"
  expected=$(hash_of "" "$program" "${options[@]}")
  # Step by step, for whole steps have no launches of their own.
  got=$(hash_of "$emulation" "$program" "${options[@]}" --config workload=exact) || fail "it ends"
  for kernel in cull flood choose_planes reduce_candidates; do
    grep -q "group_emulation: $kernel launched [1-9]" "$log" || fail "$kernel was not emulated"
  done
  [[ -n $expected && $got == "$expected" ]] || fail "$scene: contact hash $got, not $expected"
  echo "$scene: contact hash $got both ways"
done
