#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What falling_objects cannot write takes nothing else with it, and is not taken for written.
set -euo pipefail

program=${1:?usage: tests/demos/outputs_test.sh <falling_objects>}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
unset DISPLAY WAYLAND_DISPLAY

fail() { echo "outputs: $*" >&2; exit 1; }

# ran <exit code> <option>...: $steps or four, with its report in $out/report
ran() {
  local expected=$1 code=0
  shift
  rm -f "$out"/run.*
  timeout 60 "$program" --collider ode --objects 2 --steps "${steps:-4}" "$@" \
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

# As Ctrl-C, which a script's background jobs ignore; and as where a terminal is closed.
for signal in TERM HUP; do
  rm -f "$out"/run.*
  env --default-signal=HUP "$program" --collider ode --objects 2 --steps 100000000 --quiet --check \
    --csv "$out/run.csv" --record "$recording" > "$out/report" 2> "$out/errors" &
  for ((i = 0; i < 300; ++i)); do
    [[ -e $recording ]] && break
    sleep 0.1
  done
  sleep 1
  kill -"$signal" $!
  # The shell and the kernel both say that a terminal is closed.
  [[ $signal != HUP ]] || kill -HUP $! 2> /dev/null || true
  code=0
  wait $! || code=$?
  [[ $code -eq $((128 + $(kill -l "$signal"))) ]] || fail "a run that $signal ends: exit code $code"
  has "$out/errors" "stopped after step"
  has "$out/report" "check: not finished"
  [[ $(wc -l < "$out/run.csv") -gt 10 && -s $recording ]] || fail "a run that $signal ends is lost"
done

# An open mesh has no inside, and a depth that is not measured is none of 0.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n' > "$out/open.obj"
ran 0 --quiet --mesh "$out/open.obj" --csv "$out/run.csv"
has "$out/report" "deepest penetration   not measured: open meshes have no inside"
python3 - "$out/run.csv" <<'PYTHON' || fail "the CSV has depths that were not measured"
import csv, sys
sys.exit(any(row["deepest_penetration"] for row in csv.DictReader(open(sys.argv[1]))))
PYTHON
ran 0 --quiet --csv "$out/run.csv"
has "$out/report" "m (measured on the meshes)"

# A display that is not there, as in a shell of another machine.
DISPLAY=:97 ran 0
has "$out/report" "contact hash"
# Built without windows it says so where one is asked for, and of the display nothing.
if ! "$program" --window --objects 2 --steps 1 2>&1 | grep -q -F "draws nothing"; then
  has "$out/errors" "no window can be opened"
fi

# An ffmpeg that has no room for the end of the film, and one that ends after four pictures. (Built
# without pictures the program says that it draws nothing.)
if "$program" --collider ode --objects 2 --steps 1 --quiet --frames "$out/picture.png" \
  > "$out/report" 2>&1; then
  mkdir "$out/bin"
  touch "$out/bin/ffmpeg"
  chmod +x "$out/bin/ffmpeg"
  printf '#!/bin/sh\ncat > /dev/null\necho "[error] Error writing trailer" >&2\n' > "$out/bin/ffmpeg"
  PATH=$out/bin:$PATH ran 1 --quiet --check --size 64x64 --video "$out/run.mp4"
  has "$out/errors" "Error writing trailer"
  has "$out/errors" "ffmpeg could not make '$out/run.mp4'"
  printf '#!/bin/sh\nhead -c 50000 > /dev/null\nexit 1\n' > "$out/bin/ffmpeg"
  PATH=$out/bin:$PATH steps=40 ran 1 --quiet --check --size 64x64 --video "$out/run.mp4" \
    --csv "$out/run.csv"
  has "$out/report" "check: "
  ! grep -q "not finished" "$out/report" || fail "an ffmpeg that ends ends the run"
  [[ $(wc -l < "$out/run.csv") -eq 41 ]] || fail "an ffmpeg that ends takes the CSV with it"
else
  has "$out/report" "draws nothing"
fi
echo "outputs: each by itself"
