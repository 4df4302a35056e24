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

# No option asks for the window: there is a display. ODE's half is 455 wide, and so is the batch's; the
# panel has the rest.
"$program" --objects 24 --size 1200x680 --beside ode --overlay caption,contacts,regions \
  --camera=3.4,-5.6,5.0:0.1,-0.1,0.3 \
  > "$out/log" 2>&1 &
window=$!
find_window() { id=$(xdotool search --onlyvisible --name '^falling_objects$') && xdotool windowfocus "$id"; }
wait_for 120 find_window || fail "no window came"
id=$(xdotool search --onlyvisible --name '^falling_objects$')

# The whole, and ODE's half: that shows no number that changes while nothing else does. Without the
# pointer, which would be a change of its own.
picture() {
  ffmpeg -loglevel error -y -f x11grab -draw_mouse 0 -video_size 1200x680 -i "$DISPLAY" \
    -frames:v 1 "$out/$1.png" -frames:v 1 -vf crop=450:680:0:0 "$out/$1-half.png"
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
[[ $# -lt 2 ]] || cp "$out/before.png" "$2"
xdotool mousemove 200 300 mousedown 1; sleep 0.5
xdotool mousemove 260 320; sleep 0.5
xdotool mouseup 1
change "turning"
stand "after turning"
xdotool click 4
change "zooming"
stand "after zooming"
xdotool key h
change "the camera as it was"
stand "after h"
xdotool mousemove 919 527 click 1   # the first check box of overlays
change "no caption"
stand "without a caption"
xdotool windowsize "$id" 1000 600
change "another size"
stand "in another size"
xdotool windowsize "$id" 1200 680
change "the first size"
stand "in the first size"
xdotool windowfocus "$(xdotool search --maxdepth 0 '.*')"   # the root's: what is typed goes elsewhere
sleep 0.5
xdotool windowfocus "$id"
stand "after another had the keys"
xdotool key o
change "a step"
stand "after a step"

xdotool key r   # from the start, paused: all hang in the air
change "starting again"
stand "at the start"
# The gear in front is taken and thrown to the left, out of the heap.
xdotool mousemove 320 317 mousedown 3; sleep 0.5; xdotool key p; sleep 1
xdotool mousemove 60 250; sleep 1
xdotool mouseup 3

xdotool key p   # paused: what stands still now
stand "after the throw"
xdotool key d key c key p   # ten more, and driven by ODE's own collider: seen at the end
change "going on"
xdotool key Escape   # while it steps

wait "$window" || fail "the program failed"
window=
grep -Eq "^closed after ([2-9]|[0-9]{2,}) steps with 34 objects, driven by ODE's own collider, 1 thrown" \
  "$out/log" || fail "not what was asked for"
cat "$out/log"
