#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Pictures and films of a run are there, as many as there should be, and change nothing of the run.
set -euo pipefail

program=${1:?usage: tests/view/pictures_test.sh <falling_objects>}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
unset DISPLAY WAYLAND_DISPLAY

fail() { echo "$*" >&2; exit 1; }
run() { "$program" --objects 12 --steps 30 --quiet "$@"; }
draw() { run --size 160x90 "$@"; }
hash_of() { sed -n 's/^ *contact hash *//p' "$out/log"; }

run > "$out/log"
expected=$(hash_of)
[[ -n $expected ]] || fail "no contact hash was printed"
! grep -q pictures: "$out/log" || fail "pictures were drawn that nobody asked for"

# 30 steps at 60 Hz, 30 pictures a second and the start: 16.
draw --frames "$out/a/%02d.png" --overlay caption,contacts,touched,regions,meshlets,inside,boxes > "$out/log"
[[ $(hash_of) == "$expected" ]] || fail "drawing changed the contacts"
grep -q "pictures: $out/a/00.png to $out/a/15.png (16 pictures" "$out/log" || fail "$(cat "$out/log")"
[[ $(find "$out/a" -name '*.png' | wc -l) == 16 ]] || fail "not 16 pictures: $(ls "$out/a")"
cmp -s "$out/a/00.png" "$out/a/15.png" && fail "the first picture is the last"

draw --beside ode --video "$out/a.mp4" --frames "$out/last.png" > "$out/log"
[[ $(hash_of) == "$expected" ]] || fail "ODE's own collider beside the batch changed its contacts"
frames=$(ffprobe -v error -count_frames -select_streams v -show_entries stream=nb_read_frames \
  -of csv=p=0 "$out/a.mp4")
[[ ${frames%,} == 16 ]] || fail "the film has $frames pictures, not 16"
[[ -s $out/last.png ]] || fail "there is no picture of the end"

refused() { # WORDS OPTIONS...
  local words=$1 code=0
  shift
  run "$@" > "$out/log" 2>&1 || code=$?
  [[ $code == 2 ]] || fail "$*: exit code $code instead of 2"
  grep -qi -- "$words" "$out/log" || fail "$*: does not say '$words': $(cat "$out/log")"
}
refused "even numbers" --size 161x90
refused "azimuth" --frames "$out/x.png" --camera 1
refused "%04d" --frames "$out/%d%d.png"
refused "wants --frames" --beside ode
refused "no sheets" --beside ode --frames "$out/x.png" --scene rigid-deformable --sheets 1
refused "no window" --window
refused "not in" --overlay shadows
echo "16 pictures, 16 in the film, the same contacts"
