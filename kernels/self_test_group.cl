// SPDX-License-Identifier: BSD-3-Clause
// Whether the work-items of a group hand values on as lib/group.h and lib/lanes.h say, tried out
// once per device where lanes are groups (ode_ext/opencl/self_test.cpp).
//
// in    none
// out   results: a word a work-item, 1 where all that it got is right
// item  1 of a group of OX_LANES
// may overflow: none
#include "lib/lanes.h"

static uint ox_test_value(uint item) { return 0x9e3779b1u * (item + 1u); }
static float ox_test_float(uint item) { return (float)((7u * item + 3u) % OX_LANES) - 5.0f; }

__kernel void self_test_group(__global volatile uint* results) {
  const uint item = OX_ITEM;
  const uint own = ox_test_value(item);
  bool agrees = ox_of_item(own, OX_LANES - 1u - item) == ox_test_value(OX_LANES - 1u - item);
  uint bits = 0u;
  for (uint k = 0u; k < OX_LANES; ++k) {
    agrees = ox_of_item(own, k) == ox_test_value(k) && agrees;
    if ((ox_test_value(k) >> 30 & 1u) != 0u) bits |= 1u << k;
  }
  agrees = ox_group_bits((own >> 30 & 1u) != 0u) == bits && agrees;
  const ox_floats value = ox_test_float(item);
  agrees = ox_least_of(&value) == -5.0f && agrees;
  agrees = ox_greatest_of(&value) == (float)(OX_LANES - 1u) - 5.0f && agrees;
  // What one writes is there for the others behind ox_settle().
  __global volatile uint* of_group = results + OX_LANES * (uint)get_group_id(0);
  of_group[(item + 5u) % OX_LANES] = own;
  ox_settle();
  agrees = of_group[(item + 9u) % OX_LANES] == ox_test_value((item + 4u) % OX_LANES) && agrees;
  ox_settle();
  of_group[item] = agrees ? 1u : 0u;
}
