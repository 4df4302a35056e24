// SPDX-License-Identifier: BSD-3-Clause
// The OpenCL API as this library uses it: headers and loader of 2.0, devices of 1.2. What a device
// has of 2.0 it is asked for (DeviceInfo::shares_memory).
#pragma once

#define CL_TARGET_OPENCL_VERSION 200
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS  // clCreateCommandQueue
#include <CL/cl.h>
#include <CL/cl_ext.h>
