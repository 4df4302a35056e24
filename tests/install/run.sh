#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs a build into an empty prefix, component by component, and builds the programs of this folder
# against it, through CMake and through pkg-config, from C and from C++, and runs all four. Also
# checks what the installed library needs and what it exports, and runs the installed tools.
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

# install_component <name> <regular expression of all that it may bring> <one of it>...
installed() { (cd "$prefix" && find . -type f -o -type l) 2> /dev/null | sort; }
install_component() {
  local before others wanted
  before=$(installed)
  cmake --install "$build" --prefix "$prefix" --component "$1" >> "$work/install.log"
  installed | grep -v -x -F -e "$before" > "$work/new" || fail "component $1 brings nothing"
  others=$(grep -v -E "$2" "$work/new" || true)
  [[ -z $others ]] || fail "component $1 brings what is not its own: $others"
  for wanted in "${@:3}"; do
    grep -q -E "$wanted\$" "$work/new" || fail "component $1 does not bring $wanted"
  done
  echo "component $1: $(wc -l < "$work/new") files"
}
mkdir "$prefix"
if [[ $(sed -n 's/^BUILD_SHARED_LIBS:BOOL=//p' "$build/CMakeCache.txt") == ON ]]; then
  install_component runtime '/libode_ext\.so\.[0-9.]+$' '/libode_ext\.so\.[0-9]+\.[0-9]+'
  library='/libode_ext\.so'
else
  library='/libode_ext\.a'
fi
install_component dev "^\./include/ode_ext/|/cmake/ode_ext/|/ode_ext\.pc$|$library\$" \
  /ode_ext\\.h /ode_ext-config\\.cmake /ode_ext\\.pc "$library"
install_component tools '^\./(bin/ode_ext-|share/man/man1/ode_ext-|lib.*/ode_ext/libode_ext_preload)' \
  /ode_ext-info /ode_ext-replay /ode_ext-run /libode_ext_preload\\.so /ode_ext-info\\.1 /ode_ext-replay\\.1
install_component docs '^\./share/doc/ode_ext/' /README\\.md /docs/contacts\\.md /docs/pictures/tower\\.webp /hello\\.c
while read -r page picture; do
  [[ -s $(dirname "$page")/$picture ]] || fail "$page shows $picture, which is not installed"
done < <(grep -r -o '!\[[^]]*\]([^)]*)' --include='*.md' "$prefix/share/doc/ode_ext" |
  sed -E 's/^([^:]*):.*\]\(([^)]*)\)$/\1 \2/')
# All of it is what comes without naming a component.
installed > "$work/components"
cmake --install "$build" --prefix "$work/whole" > /dev/null
(cd "$work/whole" && find . -type f -o -type l) | sort | diff "$work/components" - ||
  fail "the components are not all that is installed"
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
# Folders may be absolute, as where every package has a prefix of its own.
cmake -S "$here/../.." -B "$work/absolute" -G "$generator" -DODE_EXT_BUILD_TESTS=OFF \
  -DODE_EXT_BUILD_DEMOS=OFF -DCMAKE_INSTALL_INCLUDEDIR=/absolute/include > "$work/absolute.log"
grep -q -x 'includedir=/absolute/include' "$work/absolute/ode_ext.pc" ||
  fail "ode_ext.pc does not take an absolute folder of headers"
LD_LIBRARY_PATH=$libraries "$work/pc_cpp"

echo "tools:"
"$prefix/bin/ode_ext-info" | tail -n 1
LD_LIBRARY_PATH=$libraries ODE_EXT_CAPTURE=$work/capture "$work/pc_c" > /dev/null
"$prefix/bin/ode_ext-replay" "$work/capture" | tail -n 1

if [[ ${#static[@]} -eq 0 ]]; then
  library=$libraries/libode_ext.so
  needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
  allowed='^(libode|libOpenCL|libstdc\+\+|libgcc_s|libm|libc|ld-linux.*)\.so'
  others=$(grep -v -E "$allowed" <<< "$needed" || true)
  [[ -z $others ]] || fail "the library needs more than ODE and OpenCL: $others"
  # ODE's table keeps pointing into it.
  readelf -d "$library" | grep -q NODELETE || fail "the library can be unloaded"
  exported=$(nm -D --defined-only "$library" | awk '{print $NF}')
  grep -q '^dBatchColliderCreate$' <<< "$exported" || fail "the C API is not exported"
  others=$(grep -v '^dBatch' <<< "$exported" || true)
  [[ -z $others ]] || fail "exported but no part of the API: $others"
fi
echo "installed, built and run in both ways"
