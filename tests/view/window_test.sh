#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The window opens, draws, takes keys and the mouse, and closes: on a screen in memory (Xvfb).
set -euo pipefail

program=${1:?usage: tests/view/window_test.sh <falling_objects> [picture to write]}
out=$(mktemp -d)
screen=
window=
cleanup() {
  for process in $window $screen; do kill "$process" 2> /dev/null || true; done
  rm -rf "$out"
}
trap cleanup EXIT
fail() { echo "$*" >&2; cat "$out/log" >&2; exit 1; }
unset WAYLAND_DISPLAY

# It says which number it took.
Xvfb -displayfd 3 -screen 0 1200x640x24 -nolisten tcp 3> "$out/number" 2> "$out/xvfb" &
screen=$!
wait_for() { # SECONDS COMMAND...
  local end=$((SECONDS + $1))
  shift
  until "$@" > /dev/null 2>&1; do
    [[ $SECONDS -lt $end ]] || return 1
    sleep 0.1
  done
}
wait_for 30 test -s "$out/number" || fail "there is no screen: $(cat "$out/xvfb")"
DISPLAY=:$(cat "$out/number")
export DISPLAY

# No option asks for the window: there is a display.
"$program" --objects 24 --size 1200x640 --beside ode --overlay caption,contacts,boxes \
  > "$out/log" 2>&1 &
window=$!
focus() { xdotool windowfocus "$(xdotool search --onlyvisible --name '^falling_objects$')"; }
wait_for 120 focus || fail "no window came"

picture() {
  ffmpeg -loglevel error -y -f x11grab -video_size 1200x640 -i "$DISPLAY" -frames:v 1 "$out/$1.png"
}
# How many colors there are tells an empty window from a drawn one.
colors() {
  ffmpeg -loglevel error -i "$out/$1.png" -f rawvideo -pix_fmt rgb24 - | od -An -v -tx1 -w3 | sort -u | wc -l
}
drawn() { picture start && [[ $(colors start) -gt 500 ]]; }
wait_for 60 drawn || fail "the window shows nothing: $(colors start) colors"

[[ $# -lt 2 ]] || sleep 15 # until things lie, for a picture to show
xdotool key p; sleep 1   # stands still
picture before
xdotool mousemove 200 300 mousedown 1; sleep 0.5
xdotool mousemove 260 320; sleep 0.5
xdotool mouseup 1 click 4; sleep 1
picture turned
cmp -s "$out/before.png" "$out/turned.png" && fail "turning and zooming changes nothing"
[[ $# -lt 2 ]] || cp "$out/turned.png" "$2"
xdotool key d; sleep 0.7 # ten more
xdotool key c; sleep 0.7 # driven by ODE's own collider
xdotool key o; sleep 0.7 # one step
xdotool key p; sleep 2   # goes on
xdotool key Escape

wait "$window" || fail "the program failed"
window=
grep -Eq "^closed after ([2-9]|[0-9]{2,}) steps with 34 objects, driven by ODE's own collider" \
  "$out/log" || fail "not what was asked for"
cat "$out/log"
