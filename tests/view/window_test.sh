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

# It says which number it took. Without -noreset it refuses the program while it starts anew, as it does
# whenever xdotool, the only client so far, has left.
Xvfb -displayfd 3 -screen 0 1200x680x24 -nolisten tcp -noreset 3> "$out/number" 2> "$out/xvfb" &
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
"$program" --objects 24 --size 1200x680 --beside ode --overlay caption,contacts,regions,boxes \
  --camera=4.9,-5.2,5.6:1.4,1.0,0.3 \
  > "$out/log" 2>&1 &
window=$!
focus() { xdotool windowfocus "$(xdotool search --onlyvisible --name '^falling_objects$')"; }
wait_for 120 focus || fail "no window came"

# The whole, and ODE's half: that shows no number that changes while nothing else does. Without the
# pointer, which would be a change of its own.
picture() {
  ffmpeg -loglevel error -y -f x11grab -draw_mouse 0 -video_size 1200x680 -i "$DISPLAY" \
    -frames:v 1 "$out/$1.png" -frames:v 1 -vf crop=600:680:0:0 "$out/$1-half.png"
}
# How many colors there are tells an empty window from a drawn one.
colors() {
  ffmpeg -loglevel error -i "$out/$1.png" -f rawvideo -pix_fmt rgb24 - | od -An -v -tx1 -w3 | sort -u | wc -l
}
drawn() { picture start && [[ $(colors start) -gt 500 ]]; }
wait_for 60 drawn || fail "the window shows nothing: $(colors start) colors"

# What comes after `before`.
changed() { picture after && ! cmp -s "$out/before-half.png" "$out/after-half.png"; }
stands() { picture before && sleep 1 && ! changed; }
stand() { wait_for 60 stands || fail "it does not stand still $1"; }
change() { wait_for 60 changed || fail "$1 changes nothing"; }
picture before
change "time"

[[ $# -lt 2 ]] || sleep 15 # until things lie, for a picture to show
xdotool key p
stand "after p"
xdotool mousemove 200 300 mousedown 1; sleep 0.5
xdotool mousemove 260 320; sleep 0.5
xdotool mouseup 1
change "turning"
stand "after turning"
xdotool click 4
change "zooming"
stand "after zooming"
[[ $# -lt 2 ]] || cp "$out/before.png" "$2"
xdotool key d key c   # ten more, and driven by ODE's own collider: seen at the end
stand "after d and c"
xdotool key o
change "a step"
stand "after a step"
xdotool key p
change "going on"
xdotool key Escape

wait "$window" || fail "the program failed"
window=
grep -Eq "^closed after ([2-9]|[0-9]{2,}) steps with 34 objects, driven by ODE's own collider" \
  "$out/log" || fail "not what was asked for"
cat "$out/log"
