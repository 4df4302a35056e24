#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What conda builds with, in the sources: PREFIX and CMAKE_ARGS are conda's.
set -euo pipefail

# CMAKE_ARGS are words.
# shellcheck disable=SC2086
cmake -S . -B build/conda -G Ninja ${CMAKE_ARGS:-} \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$PREFIX" -DCMAKE_INSTALL_LIBDIR=lib \
  -DODE_EXT_BUILD_DEMOS=OFF -DODE_EXT_BUILD_TESTS=OFF
cmake --build build/conda
cmake --install build/conda
