// SPDX-License-Identifier: BSD-3-Clause
// The files of kernels/, as bytes in the library. Defined in a source that cmake/EmbedKernels.cmake
// writes at build time, in the order of ODE_EXT_KERNEL_FILES (shared headers first).
#pragma once

#include <cstddef>

namespace ode_ext {

struct EmbeddedKernel {
  const char* name;           // path below kernels/, for #line
  const unsigned char* text;  // not null-terminated
  std::size_t size;           // [bytes]
};

extern const EmbeddedKernel kEmbeddedKernels[];
extern const std::size_t kEmbeddedKernelCount;

}  // namespace ode_ext
