#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Whether contacts are the same to the byte where work-groups go through pairs and regions together
# (kernels/lib/group.h), emulated on the processor, and where work-items do alone.
# usage: agrees.sh <falling_objects> <libgroup_emulation.so>
set -euo pipefail
program=$1
emulation=$2
folder=$(mktemp -d)
log=$folder/log
trap 'rm -rf "$folder"' EXIT

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

# Open ground, and what is thicker or thinner than it gets into that.
awk 'BEGIN {
  for (x = 0; x < 9; ++x)
    for (y = 0; y < 9; ++y) print "v", x - 4, y - 4, 0.2 * sin(3 * x + 5 * y)
  for (x = 0; x < 8; ++x)
    for (y = 0; y < 8; ++y) {
      corner = 9 * x + y + 1
      print "f", corner, corner + 9, corner + 10
      print "f", corner, corner + 10, corner + 1
    }
}' > "$folder/ground.obj"
cat > "$folder/ground.toml" << END
title = "planks and balls on open ground"
steps = 60
[mesh]
ground = { file = "ground.obj" }
plank = { shape = "box", x = 1.2, y = 0.3, z = 0.1, cells = 3 }
ball = { shape = "sphere", sides = 12 }
[[body]]
mesh = "ground"
motion = "fixed"
[[body]]
mesh = "plank"
at = [0, 0, 0.3]
count = [3, 2, 2]
spacing = [1.5, 1.2, 0.5]
tumble = true
[[body]]
mesh = "ball"
at = [0, 0.6, 0.8]
count = [2, 2, 1]
spacing = [1.8, 1.8, 0.5]
END

# In a pile; driven by ODE, which lets bodies sink into one another; on open ground; and with sheets,
# which are open and deformable.
for scene in "--objects 40 --steps 60" "--objects 16 --steps 80 --collider ode --compare" \
  "--scene $folder/ground.toml" "--scene rigid-deformable --objects 4 --sheets 1 --steps 60"; do
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
