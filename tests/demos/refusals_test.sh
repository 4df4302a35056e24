#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What falling_objects cannot do it says before it begins, in a sentence and with exit code 2.
set -euo pipefail

program=$(realpath "${1:?usage: tests/demos/refusals_test.sh <falling_objects>}")
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

{
  printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n'
  printf 'property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n'
  printf '0 0 0\n1 0 0\n0 1 0\n3 0 1 900\n'
} > "$out/damaged.ply"
refused "cannot read the mesh '$out/damaged.ply'" --objects 4 --mesh "$out/damaged.ply"
refused "'nan' is no number from" --hz nan
refused "'-1' is no whole number from 0" --seed -1
refused "names the file that --csv writes" --csv "$out/one" --snapshot "$out/one"
(cd "$out" && refused "names the file that --csv writes" --csv new --snapshot ./new)
touch "$out/link"
ln "$out/link" "$out/other"
refused "names the file that --csv writes" --csv "$out/link" --snapshot "$out/other"
refused "names the file that --csv writes" --csv "$out/one.mp4" --video "$out/one.mp4"
refused "names the file that --snapshot writes" --snapshot "$out/one.png" --frames "$out/one.png"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' > "$out/a.obj"
refused "names the file that --mesh reads" --mesh "$out/a.obj" --snapshot "$out/b/../a.obj"
refused "names the file that --mesh reads" --scene tower --mesh "cube=$out/a.obj" --csv "$out/a.obj"
[[ $(wc -l < "$out/a.obj") -eq 8 ]] || fail "a mesh is written over"
refused "there are two for 'cube'" --scene tower --mesh "$out/a.obj" --mesh "$out/a.obj"

scene() { printf '[[body]]\nmesh = "cube"\nat = [0, 0, 1]\n%s\n' "$1" > "$out/scene.toml"; }
scene ''
refused "names the file that --scene reads" --scene "$out/scene.toml" --csv "$out/scene.toml"
cp "$out/a.obj" "$out/near.obj"
scene $'[[body]]\nmesh = "near"\n[mesh.near]\nfile = "near.obj"'
refused "names the file that --scene reads" --scene "$out/scene.toml" --csv "$out/near.obj"
scene $'[[body]]\nmesh = "far"\n[mesh.far]\nfile = "far.obj"'
printf 'v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nv 0 0 1e30\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' \
  > "$out/far.obj"
refused "is too large" --scene "$out/scene.toml"

# In 1 GB of memory.
(
  ulimit -v 1000000
  refused "not enough memory for 1000000 objects" --objects 1000000 --collider ode
)
echo "refusals: all before anything ran"
