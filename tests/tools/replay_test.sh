#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What a program captures replays to the same bytes: on one device thread and on two, by another
# organization of the kernels, of rigid meshes and of sheets, of one thread of the program and of
# several. Files that are cut, changed or of something else are told from captures, in a sentence.
set -euo pipefail

usage="usage: tests/tools/replay_test.sh <ode_ext-replay> <falling_objects> <ode_ext_tests> <pair_times>"
replay=${1:?$usage} falling_objects=${2:?$usage} tests=${3:?$usage} pair_times=${4:?$usage}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "replay: $*" >&2
  exit 1
}
capture() {  # <file> <command>...
  ODE_EXT_CAPTURE=$1 "${@:2}" > "$work/log" 2>&1 || { cat "$work/log" >&2; fail "$2 failed"; }
}
replayed() { "$replay" "$@" | sed -n 's/^replayed  *hash //p'; }
same() {  # <what> <hash> <expected>
  [[ -n $2 && $2 == "$3" ]] || fail "$1: $2, expected $3"
  echo "$1: $2"
}
on_two() { POCL_MAX_PTHREAD_COUNT=2 POCL_CPU_MAX_CU_COUNT=2 "$@"; }
on_one() { POCL_MAX_PTHREAD_COUNT=1 POCL_CPU_MAX_CU_COUNT=1 "$@"; }

# check <name>: the capture of that name, replayed in every way.
check() {
  local file=$work/$1.capture expected
  expected=$(on_two "$replay" "$file" | sed -n 's/^captured  *hash //p')
  [[ $(on_two "$replay" "$file" --repeat 2 | tail -n 1) == "the same, byte for byte" ]] ||
    fail "$1: is not replayed to the same bytes"
  same "$1, two threads" "$(on_two replayed "$file")" "$expected"
  same "$1, one thread" "$(on_one replayed "$file")" "$expected"
}
on_two capture "$work/rigid.capture" "$falling_objects" --objects 30 --steps 60 --quiet
check rigid
on_two capture "$work/sheets.capture" "$falling_objects" --scene rigid-deformable --objects 4 \
  --sheets 10 --steps 120 --quiet
check sheets
capture "$work/threads.capture" "$tests" \
  --gtest_filter='Threads.PassesOfOneColliderInTwoThreadsAreDeliveredOrRefused'
check threads
same "rigid, exact workload" "$(replayed "$work/rigid.capture" --config workload=exact)" \
  "$(replayed "$work/rigid.capture")"

"$pair_times" --replay "$work/rigid.capture" --pairs 4 --repetitions 1 > "$work/log"
grep -q '^meshes [0-9]* and [0-9]* ' "$work/log" || fail "pair_times: $(cat "$work/log")"

# refused <exit code> <words that it must say> <argument>...
refused() {
  local code=0 said
  said=$("$replay" "${@:3}" 2>&1) || code=$?
  [[ $code -eq $1 && $said == *"$2"* ]] || fail "expected exit $1 and '$2', got $code and: $said"
  echo "refused: ${said##*$'\n'}"
}
size=$(stat -c %s "$work/rigid.capture")
# byte <file> <offset> <octal>: changes one.
byte() { printf "\\$3" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none; }

cp "$work/rigid.capture" "$work/changed"
byte "$work/changed" $((size - 10)) 177  # in the depth of the last contact
refused 1 "different   1 pairs in 1 passes" "$work/changed"
refused 1 "captured  pos (" "$work/changed"

head -c $((size - 10)) "$work/rigid.capture" > "$work/cut"
refused 2 "ends within record" "$work/cut"
refused 2 "--partial replays what is before that" "$work/cut"
"$replay" "$work/cut" --partial > "$work/log" || fail "--partial: $(cat "$work/log")"
grep -q "has no contacts in the capture" "$work/log" || fail "--partial: $(cat "$work/log")"
# Cut before the first contacts: nothing can be compared, which is not to be the same.
first=$(python3 - "$work/rigid.capture" << 'PYTHON'
import struct, sys

data, at, contacts = open(sys.argv[1], "rb").read(), 16, 4
while struct.unpack_from("<I", data, at)[0] != contacts:
    at += 16 + struct.unpack_from("<Q", data, at + 8)[0]
print(at)
PYTHON
)
head -c $((first + 5)) "$work/rigid.capture" > "$work/cut"
refused 2 "not compared" "$work/cut" --partial
# What was not delivered has no contacts either, and the rest of the capture is as good.
capture "$work/backtracked.capture" "$tests" \
  --gtest_filter='ApiMode.BacktrackingDeliversNothingMakesNoCallbackAndReturnsZero'
"$replay" "$work/backtracked.capture" > "$work/log" 2>&1 || [[ $? -eq 1 ]] ||
  fail "misprediction=backtrack: $(cat "$work/log")"
grep -q "has no contacts in the capture" "$work/log" || fail "nothing was backtracked"
for length in 0 7 12 16 20 33 1000 100000; do
  head -c "$length" "$work/rigid.capture" > "$work/cut"
  refused 2 "$work/cut" "$work/cut"
done

cp "$work/rigid.capture" "$work/other"
byte "$work/other" 8 002
refused 2 "is a capture of version 2, and this program reads version 1" "$work/other"
byte "$work/other" 8 001
byte "$work/other" 12 001
refused 2 "written on a machine of another byte order" "$work/other"
cp "$work/rigid.capture" "$work/other"
byte "$work/other" 33 377  # the first record, a collider, holds more than it does
refused 2 "is damaged: record 1" "$work/other"
refused 2 "is not a capture" "$0"
refused 2 "cannot read" "$work/nowhere"
refused 2 "cannot read" "$work"
code=0
said=$("$replay" "$work/rigid.capture" 2>&1 > /dev/full) || code=$?
[[ $code -eq 2 && $said == *"the report could not be written"* ]] ||
  fail "a report that is lost: exit $code, $said"
refused 3 "no OpenCL device matches" --device nowhere "$work/rigid.capture"

said=$(ODE_EXT_CAPTURE=$work/no/where "$falling_objects" --objects 2 --steps 1 --quiet 2>&1) &&
  fail "a capture that cannot be written is no error"
[[ $said == *"ODE_EXT_CAPTURE names"*"cannot be written"* ]] || fail "$said"
said=$(ODE_EXT_CAPTURE=/dev/full "$falling_objects" --objects 4 --steps 9 --quiet 2>&1) ||
  fail "a full disk ends the program: $said"
[[ $said == *"cannot be written any more: No space left"* ]] || fail "a full disk: $said"
said=$(ODE_EXT_CAPTURE=$work/both ODE_EXT_TRACE=$work/both "$falling_objects" --objects 2 \
  --steps 1 --quiet 2>&1) && fail "one file for capture and trace is no error"
[[ $said == *"ODE_EXT_TRACE and ODE_EXT_CAPTURE both name '$work/both'"* ]] || fail "$said"

# Programs that run at one time, as of one script, whose files have one name.
said=$(flock "$work/shared" env ODE_EXT_CAPTURE="$work/shared" "$falling_objects" \
  --objects 2 --steps 1 --quiet 2>&1)
[[ $said == *"another process writes the file that ODE_EXT_CAPTURE names; this one writes"* ]] ||
  fail "nothing is said of a file that another process writes: $said"
[[ ! -s $work/shared && -s $(echo "$work"/shared.*) ]] || fail "two processes write one capture"
echo "captures replay"
