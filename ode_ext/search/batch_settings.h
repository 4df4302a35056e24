// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "opencl/device.h"

namespace ode_ext {

// What the kernels of a batch are told about its algorithms.
struct BatchSettings {
  cl_uint modes = 0;  // OX_MODE_...
  cl_float displacement_limit = 1;
  cl_uint walk_limit = 32;
  cl_uint max_contacts = 16;
  cl_uint max_contacts_deformable = 0;
};

}  // namespace ode_ext
