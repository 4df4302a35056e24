#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What ode_ext-run says, and what it leaves alone.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tests/preload/run_test.sh BIN PRELOAD
  BIN      the directory of idioms, idioms_by_api and ode_ext-run
  PRELOAD  that of libode_ext_preload.so
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
esac
[[ $# -eq 2 ]] || { usage >&2; exit 2; }
bin=$1 preload=$2
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

failed=0
fail() {
  echo "run_test: $*" >&2
  failed=1
}

# expect <exit status> <words of the output> <argument of ode_ext-run>...
expect() {
  local wanted=$1 words=$2 status=0
  shift 2
  "$bin/ode_ext-run" "$@" > "$results/output" 2>&1 || status=$?
  [[ $status -eq $wanted ]] || fail "$*: status $status, expected $wanted"
  [[ -z $words ]] || grep -q -F -e "$words" "$results/output" ||
    { cat "$results/output"; fail "$*: says nothing of '$words'"; }
}

expect 0 "usage: ode_ext-run" --help
expect 0 "ode_ext 0." --version
expect 2 "usage: ode_ext-run"
expect 2 "unrecognized option" --nosuch true
expect 2 "no program is named after --capture ./host" --capture ./host
for number in 0 65 -1 abc 8x ''; do
  expect 2 "--max-contacts '$number': expected a whole number from 1 to 64" --max-contacts "$number" true
done
expect 2 "--log 'loud': expected off, error, warning or info" --log loud true
expect 2 "--config 'rays=none': dBatchConfigCheck: config: rays is 'none', expected full" \
  --config rays=none true
expect 2 "--capture '/missing/f': No such file or directory" --capture /missing/f true
expect 2 "--trace '/': Is a directory" --trace / true
expect 2 "--capture '': expected a file" --capture "" true
expect 0 "" --max-contacts 64 --log off --config workload=exact --trace "$results/t" true
[[ ! -e $results/t ]] || fail "--trace is written by a program without meshes"
expect 127 "not found" nosuchprogram
expect 127 "No such file" ./nosuchprogram
expect 126 "not an executable file" "$(dirname "$0")"
expect 126 "rights of another user" "$(command -v passwd)"
printf 'int main(void) { return 0; }\n' > "$results/static.c"
cc -static -o "$results/static" "$results/static.c"
expect 126 "linked statically" "$results/static"
expect 3 "" sh -c 'exit 3'
expect 0 "called no ODE" --stats true
expect 0 "--help" echo --help
expect 0 "uses ode_ext by itself; it goes on with that, and of the options" "$bin/idioms_by_api" in_the_callback
expect 0 "" --capture "$results/capture" "$bin/idioms" in_the_callback
[[ -s $results/capture ]] || fail "--capture writes nothing"
expect 0 "passes" --stats sh -c "exec '$bin/idioms' in_the_callback"

# same_as_stock <environment> <sentence>: the program goes on as before, and hears of it once.
same_as_stock() {
  "$bin/idioms" in_the_callback > "$results/stock"
  env "$1" "$bin/ode_ext-run" "$bin/idioms" in_the_callback > "$results/preload" 2> "$results/said"
  cmp "$results/stock" "$results/preload" || fail "$1: not as before"
  [[ $(grep -c -F -e "$2" "$results/said") -eq 1 ]] || fail "$1: says $(cat "$results/said")"
}

same_as_stock ODE_EXT_DEVICE=nosuch:: "nosuch"
same_as_stock ODE_EXT_MAX_CONTACTS=many "ODE_EXT_MAX_CONTACTS is 'many', expected 1 to 64"
same_as_stock ODE_EXT_CONFIG=rays=none "rays"
same_as_stock ODE_EXT_TRUST_MESHES=no "ODE_EXT_TRUST_MESHES is 'no', expected 0 to 1"
same_as_stock ODE_EXT_LOG=loud "ODE_EXT_LOG"
# lacking <function> <sentence>: an ODE whose table of names has another one in its place.
lacking() {
  local other=${1//[a-z]/x} ode
  ode=$(ldd "$bin/idioms" | awk '/libode/ { print $3 }')
  mkdir -p "$results/ode"
  sed "s/\\x00$1\\x00/\\x00$other\\x00/" "$ode" > "$results/ode/$(basename "$ode")"
  same_as_stock LD_LIBRARY_PATH="$results/ode" "$2"
}

lacking dGeomTriMeshGetTriangleCount "this ODE has no dGeomTriMeshGetTriangleCount"
lacking dCheckConfiguration "does not tell its precision"

# A program that collides two meshes by a function of its own: it is asked, and nobody else.
"$bin/ode_ext-run" "$bin/own_collider" > "$results/own" 2> "$results/said"
printf 'asked 1 times, contacts 0\n%.0s' 1 2 | cmp - <(tail -n 2 "$results/own") ||
  fail "a collider of the program's own: $(cat "$results/own")"
[[ $(grep -c "sets a collider of its own" "$results/said") -eq 1 ]] ||
  fail "a collider of the program's own: says $(cat "$results/said")"

# Without the library behind it, which may want an OpenCL that is not there.
cp "$preload/libode_ext_preload.so" "$results"
"$bin/idioms" in_the_callback > "$results/stock"
LD_PRELOAD=$results/libode_ext_preload.so "$bin/idioms" in_the_callback > "$results/preload" \
  2> "$results/said"
cmp "$results/stock" "$results/preload" || fail "alone: not as before"
[[ $(grep -c "cannot open shared object file" "$results/said") -eq 1 ]] ||
  fail "alone: says $(cat "$results/said")"
exit "$failed"
