#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# libode_ext_preload.so and what it loads bring no ODE into a program, and show a program nothing but
# the functions of ODE that they stand in front of.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tests/preload/links_test.sh DIRECTORY
Looks at the libraries in the given directory.
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  "") usage >&2; exit 2 ;;
esac
cd "$1"

failed=0
fail() {
  echo "links_test: $*" >&2
  failed=1
}

for library in libode_ext_preload.so libode_ext_preload_double.so libode_ext_preload_single.so; do
  needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
  [[ -n $needed ]] || fail "$library needs nothing; is this readelf's output?"
  if grep -E '^lib(ode|ode_ext)\.so' <<< "$needed"; then
    fail "$library links ODE"
  fi
  undefined=$(nm -D --undefined-only "$library")
  [[ -n $undefined ]] || fail "$library takes nothing from anywhere; is this nm's output?"
  if grep -E ' U d[A-Z]' <<< "$undefined"; then
    fail "$library takes functions of ODE from whoever has them"
  fi
done
exported=$(nm -D --defined-only libode_ext_preload.so | awk '{ print $3 }')
for function in dSpaceCollide dSpaceCollide2 dCollide dSetColliderOverride; do
  grep -q -x "$function" <<< "$exported" || fail "libode_ext_preload.so does not export $function"
done
if grep -v -E '^d(InitODE2?|SpaceCollide2?|Collide|SetColliderOverride|CreateTriMesh|Geom(Destroy|TriMeshData.*))$' <<< "$exported"; then
  fail "libode_ext_preload.so exports more than it stands in front of"
fi
for precision in double single; do
  exported=$(nm -D --defined-only libode_ext_preload_$precision.so | awk '{ print $3 }' | sort | xargs)
  [[ $exported == "ode_ext_preload_config_fault ode_ext_preload_core" ]] || fail "the $precision library exports $exported"
done
exit "$failed"
