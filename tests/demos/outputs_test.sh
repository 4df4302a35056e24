#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What falling_objects cannot write takes nothing else with it, and is not taken for written.
set -euo pipefail

program=${1:?usage: tests/demos/outputs_test.sh <falling_objects>}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
unset DISPLAY WAYLAND_DISPLAY

fail() { echo "outputs: $*" >&2; exit 1; }

# ran <exit code> <option>...: with its report in $out/report
ran() {
  local expected=$1 code=0
  shift
  rm -f "$out"/run.*
  timeout 60 "$program" --collider ode --objects 2 --steps 4 "$@" \
    > "$out/report" 2> "$out/errors" || code=$?
  [[ $code -eq $expected ]] || fail "$*: exit code $code instead of $expected: $(cat "$out/errors")"
}
has() { grep -q -F -e "$2" "$1" || fail "'$2' is not in $1: $(cat "$1")"; }
snapshot="$out/run.obj"
recording="$out/run.glb"

ran 1 --quiet --check --csv /dev/full --snapshot "$snapshot" --record "$recording"
has "$out/errors" "/dev/full"
has "$out/report" "check: "
[[ -s $snapshot && -s $recording ]] || fail "a CSV that is not written takes others with it"

ln -s /dev/full "$out/full.glb"
ran 1 --quiet --check --record "$out/full.glb" --snapshot "$snapshot"
has "$out/errors" "$out/full.glb"
has "$out/report" "check: "
[[ -s $snapshot ]] || fail "a recording that is not written takes others with it"

code=0
"$program" --collider ode --objects 2 --steps 4 --quiet --snapshot "$snapshot" \
  > /dev/full 2> "$out/errors" || code=$?
[[ $code -eq 1 ]] || fail "a report that is not written: exit code $code"
has "$out/errors" "the report could not be written"

# As Ctrl-C, which a script's background jobs ignore.
"$program" --collider ode --objects 2 --steps 100000000 --quiet --check --csv "$out/run.csv" \
  --record "$recording" > "$out/report" 2> "$out/errors" &
for ((i = 0; i < 300; ++i)); do
  [[ -e $recording ]] && break
  sleep 0.1
done
sleep 1
kill -TERM $!
code=0
wait $! || code=$?
[[ $code -eq 143 ]] || fail "a run that is ended has exit code $code"
has "$out/errors" "stopped after step"
has "$out/report" "check: not finished"
[[ $(wc -l < "$out/run.csv") -gt 10 && -s $recording ]] || fail "a run that is ended is lost"

# A display that is not there, as in a shell of another machine.
DISPLAY=:97 ran 0
has "$out/report" "contact hash"
# Built without windows it says so where one is asked for, and of the display nothing.
if ! "$program" --window --objects 2 --steps 1 2>&1 | grep -q -F "draws nothing"; then
  has "$out/errors" "no window can be opened"
fi

# An ffmpeg that ends.
mkdir "$out/bin"
printf '#!/bin/sh\nexit 1\n' > "$out/bin/ffmpeg"
chmod +x "$out/bin/ffmpeg"
if "$program" --collider ode --objects 2 --steps 1 --quiet --frames "$out/frames" \
  > "$out/report" 2>&1; then
  PATH=$out/bin:$PATH ran 1 --quiet --check --steps 40 --size 64x64 --video "$out/run.mp4" \
    --csv "$out/run.csv"
  has "$out/report" "check: "
  ! grep -q "not finished" "$out/report" || fail "an ffmpeg that ends ends the run"
  [[ $(wc -l < "$out/run.csv") -eq 41 ]] || fail "an ffmpeg that ends takes the CSV with it"
fi
echo "outputs: each by itself"
