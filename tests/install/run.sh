#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs a build into an empty prefix and builds the programs of this folder against it, through
# CMake and through pkg-config, from C and from C++, and runs all four. Also checks what the
# installed library needs and what it exports.
set -euo pipefail

build=${1:?usage: tests/install/run.sh <build directory>}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

fail() {
  echo "install: $*" >&2
  exit 1
}

cmake --install "$build" --prefix "$prefix" > "$work/install.log"
# What works only because the sources are still there would fail everywhere else.
source_headers=$(cd "$here/../../include" && pwd)
if grep -r -l -I -F -e "$source_headers" -e "$(cd "$build" && pwd)" "$prefix"; then
  fail "the files above name the source or the build tree"
fi

echo "find_package:"
# The generator of the build: CMake's default may not be installed.
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
cmake -S "$here" -B "$work/cmake" -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
  > "$work/configure.log"
cmake --build "$work/cmake" > "$work/build.log" || { cat "$work/build.log"; fail "build"; }
"$work/cmake/consumer_c"
"$work/cmake/consumer_cpp"

echo "pkg-config:"
pc=$(find "$prefix" -name ode_ext.pc -printf '%h')
libraries=$(find "$prefix" -name 'libode_ext.*' -printf '%h\n' -quit)
static=()
[[ -e $libraries/libode_ext.so ]] || static=(--static)
flags() { PKG_CONFIG_PATH=$pc pkg-config "${static[@]}" "$@" ode_ext; }
# Unquoted on purpose: flags are words.
warnings="-Wall -Wextra -Wpedantic -Werror"
cc $warnings -std=c11 "$here/consumer.c" -o "$work/pc_c" $(flags --cflags --libs)
c++ $warnings "$here/consumer.cpp" -o "$work/pc_cpp" $(flags --cflags --libs)
LD_LIBRARY_PATH=$libraries "$work/pc_c"
LD_LIBRARY_PATH=$libraries "$work/pc_cpp"

if [[ ${#static[@]} -eq 0 ]]; then
  library=$libraries/libode_ext.so
  needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
  allowed='^(libode|libOpenCL|libstdc\+\+|libgcc_s|libm|libc|ld-linux.*)\.so'
  others=$(grep -v -E "$allowed" <<< "$needed" || true)
  [[ -z $others ]] || fail "the library needs more than ODE and OpenCL: $others"
  exported=$(nm -D --defined-only "$library" | awk '{print $NF}')
  grep -q '^dBatchColliderCreate$' <<< "$exported" || fail "the C API is not exported"
  others=$(grep -v '^dBatch' <<< "$exported" || true)
  [[ -z $others ]] || fail "exported but no part of the API: $others"
fi
echo "installed, built and run in both ways"
