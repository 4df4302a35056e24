// SPDX-License-Identifier: BSD-3-Clause
// The OpenCL API as this library uses it: of 1.2, which is all that it needs, and of 2.0 what it
// asks a device for first (Device::info().shares_memory).
#pragma once

#define CL_TARGET_OPENCL_VERSION 200
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS  // clCreateCommandQueue
#include <CL/cl.h>
#include <CL/cl_ext.h>
