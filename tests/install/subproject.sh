#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The sources as a part of somebody else's project, in folders with a blank in their names: what
# includes by quotes finds its headers, and the variables of the project around stay as they were.
set -euo pipefail

build=${1:?usage: tests/install/subproject.sh <build directory>}
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "subproject: $*" >&2
  exit 1
}

project="$work/a project"
mkdir -p "$project/around/ode_ext"
cp "$root/tests/install/consumer.c" "$project"
cp "$root/tests/install/subproject/CMakeLists.txt" "$project/around"
cp -r "$root/CMakeLists.txt" "$root/LICENSE" "$root/cmake" "$root/include" "$root/kernels" \
  "$root/ode_ext" "$project/around/ode_ext"

# of_build <name>: as the build has it.
of_build() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }

# configured_as <type of library> <option>...
configured_as() {
  local type=$1
  shift
  rm -rf "$project/build"
  cmake -S "$project/around" -B "$project/build" -G "$(of_build CMAKE_GENERATOR)" \
    -DCMAKE_C_COMPILER="$(of_build CMAKE_C_COMPILER)" \
    -DCMAKE_CXX_COMPILER="$(of_build CMAKE_CXX_COMPILER)" \
    -DCMAKE_PREFIX_PATH="$(of_build CMAKE_PREFIX_PATH)" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" \
    > "$work/configure.log" 2>&1 || { cat "$work/configure.log"; fail "configuring"; }
  grep -q "ode_ext is a $type\$" "$work/configure.log" || fail "$* does not make a $type"
}

configured_as STATIC_LIBRARY -DBUILD_SHARED_LIBS=OFF
configured_as SHARED_LIBRARY

# compiled <file>: as the build would.
compiled() {
  local folder command
  { read -r folder && read -r command; } < <(python3 - "$project/build/compile_commands.json" "$1" << 'PYTHON'
import json, sys

commands = [c for c in json.load(open(sys.argv[1])) if c["file"].endswith("/" + sys.argv[2])]
print(commands[0]["directory"], commands[0]["command"], sep="\n")
PYTHON
  )
  (cd "$folder" && eval "$command -fsyntax-only") || fail "$1 does not compile"
  echo "$1 compiles"
}
compiled consumer.c
compiled ode_ext/preload/preload.c
compiled ode_ext/mesh/mesh.cpp
echo "subproject: all well"
