// SPDX-License-Identifier: BSD-3-Clause
// What the collider takes for granted of a device's arithmetic, tried out once per device. The host
// (ode_ext/device/self_test.cpp) works out the same values and compares.
//
// 1 work-item = 1 case, any local size.
// in:  inputs, four floats a case; case_count
// out: results, nine words a case in the order of the host's SelfTestColumn; counter: += case_count

#pragma OPENCL FP_CONTRACT OFF

__kernel void self_test(__global const float* inputs, uint case_count, __global uint* results,
                        volatile __global uint* counter) {
  const uint i = (uint)get_global_id(0);
  if (i >= case_count) return;
  const float a = inputs[4u * i + 0u];
  const float b = inputs[4u * i + 1u];
  const float c = inputs[4u * i + 2u];
  const float d = inputs[4u * i + 3u];
  __global uint* result = results + 9u * i;

  result[0] = as_uint(a * b);
  result[1] = as_uint(a + c);
  result[2] = as_uint(a * b - c * d);
  result[3] = as_uint(fma(a, b, -(a * b)));
  result[4] = (a < b ? 1u : 0u) | (a <= b ? 2u : 0u) | (a > b ? 4u : 0u) | (a >= b ? 8u : 0u) |
              (a == b ? 16u : 0u) | (a != b ? 32u : 0u);
  result[5] = as_uint(a > b ? a : b);
  result[6] = as_uint(a < b ? a : b);
  result[7] = as_uint(a / b);
  result[8] = atomic_inc(counter);
}
