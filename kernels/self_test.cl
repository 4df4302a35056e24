// SPDX-License-Identifier: BSD-3-Clause
// What the collider takes for granted of a device's arithmetic, tried out once per device. The host
// (ode_ext/opencl/self_test.cpp) works out the same values and compares.
//
// 1 work-item = 1 case, any local size.
// in:  inputs, four floats a case; case_count
// out: results, ten words a case in the order of the host's SelfTestColumn; counter: += case_count

#include "lib/lanes.h"

static bool ox_agrees(float p, float q) { return p == q || (p != p && q != q); }

// Whether vectors of so many cases from i on give lane by lane what single floats give. Not of the
// last case, which is about what may differ.
static uint ox_vectors_agree(__global const float* inputs, uint i, uint case_count) {
  ox_floats in[4], out[3];
  for (uint k = 0u; k < OX_VECTOR_WIDTH; ++k)
    for (uint c = 0u; c < 4u; ++c)
      ((float*)(in + c))[k] = inputs[4u * ((i + k) % (case_count - 1u)) + c];
  out[0] = in[0] * in[1] - in[2] * in[3];
  out[1] = fma(in[0], in[1], -(in[0] * in[1]));
  out[2] = in[0] > in[1] ? in[2] : in[3];
  for (uint k = 0u; k < OX_VECTOR_WIDTH; ++k) {
    __global const float* x = inputs + 4u * ((i + k) % (case_count - 1u));
    const float expected[3] = {x[0] * x[1] - x[2] * x[3], fma(x[0], x[1], -(x[0] * x[1])),
                               x[0] > x[1] ? x[2] : x[3]};
    for (uint c = 0u; c < 3u; ++c)
      if (!ox_agrees(((const float*)(out + c))[k], expected[c])) return 0u;
  }
  return 1u;
}

__kernel void self_test(__global const float* inputs, uint case_count, __global uint* results,
                        volatile __global uint* counter) {
  const uint i = (uint)get_global_id(0);
  if (i >= case_count) return;
  const float a = inputs[4u * i + 0u];
  const float b = inputs[4u * i + 1u];
  const float c = inputs[4u * i + 2u];
  const float d = inputs[4u * i + 3u];
  __global uint* result = results + 10u * i;

  result[0] = as_uint(a * b);
  result[1] = as_uint(a + c);
  result[2] = as_uint(a * b - c * d);
  result[3] = as_uint(fma(a, b, -(a * b)));
  result[4] = (a < b ? 1u : 0u) | (a <= b ? 2u : 0u) | (a > b ? 4u : 0u) | (a >= b ? 8u : 0u) |
              (a == b ? 16u : 0u) | (a != b ? 32u : 0u);
  result[5] = as_uint(a > b ? a : b);
  result[6] = as_uint(a < b ? a : b);
  result[7] = as_uint(a / b);
  result[8] = ox_vectors_agree(inputs, i, case_count);
  result[9] = atomic_inc(counter);
}
