#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# A check that cannot fail checks nothing: plants one violation at a time in a small clean tree and
# expects the check in question to name it.
set -euo pipefail

scripts=$(cd "$(dirname "$0")/../../scripts" && pwd)
formats=$scripts/../.clang-format
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failed=0
count=0

# A clean tree: one file in every room, each including what it may.
source_file() {  # <path> <line>...
  mkdir -p "$tree/$(dirname "$1")"
  printf '%s\n' '// SPDX-License-Identifier: BSD-3-Clause' "${@:2}" > "$tree/$1"
}
plant_clean_tree() {
  rm -rf "${tree:?}"/*
  cp "$formats" "$tree/"
  source_file include/ode_ext/ode_ext.h '#include <ode/ode.h>'
  source_file ode_ext/api/api.cpp '#include "ode/gather.h"' '#include "ode_ext/ode_ext.h"'
  source_file ode_ext/preload/core.cpp '#include "api/api.h"' '#include "ode/gather.h"'
  source_file ode_ext/ode/gather.cpp '#include <ode/ode.h>' '' '#include "collide/collider.h"'
  source_file ode_ext/collide/collider.cpp '#include <CL/cl.h>' '' '#include "contacts/contacts.h"' \
    '#include "opencl/device.h"'
  source_file ode_ext/contacts/contacts.h '#include "abi/types.h"' '#include "search/scene.h"'
  source_file ode_ext/search/scene.h '#include "mesh/mesh.h"' '#include "opencl/buffer.h"'
  source_file ode_ext/collide/collider.h '#include "paper/rays.h"'
  source_file ode_ext/paper/rays.h '#include "collide/batch.h"'
  source_file ode_ext/mesh/mesh.cpp '#include "mesh/bvh.h"' \
    "// $(printf '%95s' '') ε"
  source_file ode_ext/opencl/device.cpp '#include <CL/cl.h>'
  source_file ode_ext/tools/replay/main.cpp '#include "ode/capture_format.h"'
  source_file demos/hello/hello.c '#include <ode/ode.h>' '#include <ode_ext/ode_ext.h>'
  source_file demos/paper/run.cpp '#include "paper/options.h"'
  source_file kernels/abi/types.h 'typedef uint ox_u32;'
  source_file kernels/lib/vector.h '#include "abi/types.h"'
  source_file kernels/step.cl '#include "lib/vector.h"' \
    '__kernel void step(__global ox_u32* out) { out[0] = 0u; }'
}

# expect_pass <check>; expect_fail <check> <text that the check must print>
expect_pass() {
  count=$((count + 1))
  if ! output=$("$scripts/$1" "$tree" 2>&1); then
    printf 'FAILED: %s on a clean tree:\n%s\n' "$1" "$output"
    failed=1
  fi
}
expect_fail() {
  count=$((count + 1))
  if output=$("$scripts/$1" "$tree" 2>&1); then
    printf 'FAILED: %s accepts %s\n' "$1" "$2"
    failed=1
  elif ! grep -q -F -- "$2" <<< "$output"; then
    printf 'FAILED: %s does not name %s but says:\n%s\n' "$1" "$2" "$output"
    failed=1
  fi
  plant_clean_tree
}
# include_fails <file> <include>: the house check names line 3 of the file.
include_fails() {
  source_file "$1" '' "#include $2"
  expect_fail check-house "$1:3:#include $2"
}

plant_clean_tree
expect_pass check-house
expect_pass check-format
expect_pass check-kernels

include_fails ode_ext/mesh/bvh.cpp '"opencl/buffer.h"'
include_fails ode_ext/mesh/bvh.cpp '"../opencl/buffer.h"'
include_fails ode_ext/mesh/bvh.cpp '"collide/collider.h"'
include_fails ode_ext/mesh/bvh.cpp '<ode/ode.h>'
include_fails ode_ext/mesh/bvh.h '<CL/cl.h>'
include_fails ode_ext/opencl/buffer.cpp '"mesh/vec.h"'
include_fails ode_ext/opencl/buffer.cpp '"ode_ext/mesh/vec.h"'
include_fails ode_ext/opencl/buffer.cpp '"ode/gather.h"'
include_fails ode_ext/opencl/buffer.cpp '<ode/common.h>'
include_fails ode_ext/search/pair_step.cpp '"ode/gather.h"'
include_fails ode_ext/search/pair_step.cpp '"contacts/contacts.h"'
include_fails ode_ext/search/pair_step.cpp '"collide/collider.h"'
include_fails ode_ext/contacts/contacts.cpp '"collide/options.h"'
include_fails ode_ext/collide/tiles.cpp '"mesh/mesh.h"'
include_fails ode_ext/collide/tiles.cpp '"lib/append.h"'
include_fails ode_ext/ode/gather.cpp '"search/search.h"'
include_fails ode_ext/ode/gather.cpp '"opencl/buffer.h"'
include_fails ode_ext/search/pair_step.cpp '"api/handles.h"'
include_fails ode_ext/search/pair_step.cpp '"ode_ext/ode_ext.h"'
include_fails ode_ext/paper/rays.cpp '"api/handles.h"'
include_fails ode_ext/opencl/buffer.cpp '"paper/rays.h"'
include_fails ode_ext/ode/gather.h '"paper/rays.h"'
include_fails ode_ext/collide/tiles.cpp '"paper/rays.h"'
include_fails kernels/cull.cl '"abi/paper.h"'
include_fails kernels/cull.cl '"contacts/plane.h"'
include_fails kernels/contacts/plane.h '"paper/cast.h"'
include_fails kernels/lib/append.h '"contacts/plane.h"'
include_fails kernels/abi/contacts.h '"lib/append.h"'
include_fails ode_ext/ode/gather.h '"api/handles.h"'
include_fails ode_ext/ode/gather.h '<CL/cl.h>'
include_fails ode_ext/api/api.cpp '"preload/core.h"'
include_fails ode_ext/api/create.cpp '<CL/cl.h>'
include_fails ode_ext/tools/replay/player.cpp '"ode/gather.h"'
include_fails ode_ext/tools/replay/player.cpp '"ode/capture.h"'
include_fails ode_ext/tools/replay/player.cpp '"mesh/vec.h"'
include_fails ode_ext/tools/replay/player.cpp '"preload/core.h"'
include_fails ode_ext/tools/replay/player.cpp '<CL/cl.h>'
include_fails ode_ext/api/create.cpp '"tools/replay/player.h"'
include_fails include/ode_ext/export.h '<CL/cl.h>'
include_fails demos/hello/hello.c '"collide/collider.h"'
include_fails demos/hello/hello.c '"preload/core.h"'
include_fails demos/hello/hello.c '"ode_ext/paper/rays.h"'
include_fails demos/paper/run.cpp '"falling_objects/run.h"'
include_fails demos/simulation/scene.h '"judging/checks.h"'
include_fails demos/judging/checks.h '"support/contacts.h"'
include_fails kernels/step.cl '<ode/ode.h>'

printf 'int x;\n' > "$tree/ode_ext/mesh/unlicensed.cpp"
expect_fail check-house 'ode_ext/mesh/unlicensed.cpp:1:int x;'
source_file ode_ext/mesh/long.cpp "$(yes '//' | head -n 500)"
expect_fail check-house 'ode_ext/mesh/long.cpp:501:'
source_file ode_ext/mesh/wide.cpp "// $(printf '%96s' '') ε"
expect_fail check-house 'ode_ext/mesh/wide.cpp:2:'
rm -r "$tree"/*
expect_fail check-house 'no sources'

source_file ode_ext/mesh/ugly.cpp 'int  x=1 ;'
expect_fail check-format 'ode_ext/mesh/ugly.cpp:2'
source_file kernels/ugly.cl 'int  x( int y ) ;'
expect_fail check-format 'kernels/ugly.cl:2'
rm -r "$tree"/*
expect_fail check-format 'no sources'

source_file kernels/wrong.cl '__kernel void wrong(__global int* out) { out[0] = 0.5f; }'
expect_fail check-kernels 'kernels/wrong.cl:2'
source_file kernels/clash.cl '__kernel void step(__global int* out) { out[0] = 1; }'
expect_fail check-kernels 'step'
rm -r "$tree"/*
expect_fail check-kernels 'no kernels'

[[ $failed -eq 0 ]] && echo "$count checks behave"
exit "$failed"
