# SPDX-License-Identifier: BSD-3-Clause
# Writes the files of kernels/ as arrays into a C++ source (see ode_ext/opencl/embedded_kernels.h):
#   cmake "-DROOT=<kernels>" "-DFILES=abi/types.h;pair_step.cl" "-DOUT=<file.cpp>" -P EmbedKernels.cmake
# The table has the files in the order given. As hex there is nothing to escape and no limit on length.

foreach(argument ROOT FILES OUT)
  if("${${argument}}" STREQUAL "")
    message(FATAL_ERROR "EmbedKernels.cmake: -D${argument}=... is missing")
  endif()
endforeach()

string(REPEAT "[0-9a-f]" 32 sixteen_bytes)
set(arrays "")
set(table "")
set(count 0)
foreach(file IN LISTS FILES)
  file(READ "${ROOT}/${file}" hex HEX)
  string(LENGTH "${hex}" size)
  math(EXPR size "${size} / 2")
  string(REGEX REPLACE "(${sixteen_bytes})" "\\1\n    " hex "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  # The zero is not counted; it is there because C++ has no empty arrays.
  string(APPEND arrays "const unsigned char kText${count}[] = {\n    ${bytes}0x00};  // ${file}\n")
  string(APPEND table "    {\"${file}\", kText${count}, ${size}},\n")
  math(EXPR count "${count} + 1")
endforeach()

file(WRITE "${OUT}.new" "// Written by cmake/EmbedKernels.cmake.
#include \"opencl/embedded_kernels.h\"

namespace ode_ext {
namespace {

${arrays}
}  // namespace

const EmbeddedKernel kEmbeddedKernels[] = {
${table}};
const std::size_t kEmbeddedKernelCount = ${count};

}  // namespace ode_ext
")
file(COPY_FILE "${OUT}.new" "${OUT}" ONLY_IF_DIFFERENT)
file(REMOVE "${OUT}.new")
