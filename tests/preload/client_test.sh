#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# A program that knows nothing of ode_ext, as it is and under the preload: it prints the same, but for
# contacts and figures, and all its mesh pairs are collided by ode_ext.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tests/preload/client_test.sh BUILD dart|dartpy|panda|late|two|static [argument of the client]...
  BUILD  the build directory
  dart   a C++ program of DART's ODE detector     dartpy  the same from Python
  panda  panda3d, whose wheel has an ODE of its own in single precision; install_panda.sh installs it
         where it is not
  two    dartpy and panda3d in one process
  late   ODE comes with a plugin                  static  ODE is linked statically and exported
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
esac
[[ $# -ge 2 ]] || { usage >&2; exit 2; }
build=$1 client=$2
shift 2
sources=$(cd "$(dirname "$0")" && pwd)
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

failed=0
fail() {
  echo "client_test: $*" >&2
  failed=1
}

# Of idioms their pairs, sorted out below.
case $client in
  dart) program=("$build/bin/dart_pairs" "$@") ;;
  dartpy) program=(/usr/bin/python3 "$sources/clients/dartpy_pairs.py" "$@") ;;
  panda)
    python=$("$sources/install_panda.sh")
    program=("$python" "$sources/clients/panda_meshes.py" "$@")
    ;;
  late) program=("$build/bin/late_host" "$build/libidioms_plugin.so" "${1:-recorded}") ;;
  two)
    python=$("$sources/install_panda.sh")
    program=("$python" "$sources/clients/two_odes.py")
    ;;
  static) program=("$build/bin/idioms_static" "${1:-recorded}") ;;
  *) usage >&2; exit 2 ;;
esac

"${program[@]}" > "$results/stock" 2> "$results/messages"
"$build/bin/ode_ext-run" --stats "${program[@]}" > "$results/preload" 2> "$results/statistics" ||
  { cat "$results/statistics"; fail "the program failed"; }
sed 's/^/stock    /' <(grep '^figures' "$results/stock")
sed 's/^/preload  /' <(grep '^figures' "$results/preload")
cat "$results/statistics"

same() { grep -v -E '^(figures|  )' "$1"; }
pairs=$(grep -c '^pair' "$results/stock" || true)
echo "$pairs lines of pairs, $(grep -c '^pair.* collides\?$' "$results/stock" || true) collide"
[[ $pairs -gt 0 ]] || fail "there are no pairs"
diff <(same "$results/stock") <(same "$results/preload") || fail "the program did something else"

# Of the one cube on the other, 0.010 deep.
case $client in
  dart | dartpy | panda | two)
    grep -q "^figures: cube on cube.* the deepest 0.293" "$results/stock" ||
      fail "ODE alone is said to give 0.293"
    grep -q "^figures: cube on cube.* the deepest 0.010" "$results/preload" ||
      fail "the cubes are 0.010 deep"
    ;;
esac
asked=$(sed -n 's/.*two meshes \([0-9]*\) times.*/\1/p' "$results/statistics")
by_ode=$(sed -n 's/.*contacts; \([0-9]*\) pairs answered by.*/\1/p' "$results/statistics")
[[ ${asked:-0} -gt 0 && ${by_ode:-1} -eq 0 ]] || fail "not all mesh pairs came to ode_ext"

if [[ $client == two ]]; then
  second() { sed -n '/^panda_meshes$/,/^figures.*hash/s/in [0-9.]* s//p' "$1"; }
  cmp <(second "$results/stock") <(second "$results/preload") ||
    fail "the second ODE does not go on as before"
  grep -q "this process has another ODE" "$results/statistics" || fail "nothing is said of it"
fi
if [[ $client == static ]]; then
  ODE_EXT_TRUST_MESHES=1 "$build/bin/ode_ext-run" "${program[@]}" > "$results/trusting" \
    2> "$results/said"
  diff <(same "$results/preload") <(same "$results/trusting") || fail "it trusts the meshes"
  grep -q "ODE_EXT_TRUST_MESHES has no effect" "$results/said" || fail "nothing is said of trust"
fi
if [[ $client == panda ]]; then
  "$build/bin/ode_ext-run" "${program[@]}" > "$results/again"
  hash_of() { grep -o 'hash .*' "$1"; }
  [[ $(hash_of "$results/preload") == "$(hash_of "$results/again")" ]] ||
    fail "another run gives other contacts"
fi
exit "$failed"
