// SPDX-License-Identifier: BSD-3-Clause
// The pairs of a step in device memory.
#pragma once

#include <cstddef>

#include "device/buffer.h"
#include "shared/types.h"

namespace ode_ext {

struct PairBuffers {
  explicit PairBuffers(Device& device)
      : objects(device),
        members(device),
        dense_first(device),
        pairs(device),
        hits(device),
        crossings(device),
        heads(device),
        ranges(device),
        segments(device),
        crossing_segments(device) {}

  void reserve(std::size_t pair_count) {
    count = static_cast<cl_uint>(pair_count);
    members.reserve(2 * pair_count * sizeof(ox_u32));
    dense_first.reserve(pair_count * sizeof(ox_u32));
    pairs.reserve(pair_count * sizeof(ox_pair));
    hits.reserve(pair_count * sizeof(ox_u32));
    crossings.reserve(pair_count * sizeof(ox_u32));
    heads.reserve(2 * pair_count * sizeof(ox_u32));
    ranges.reserve(pair_count * sizeof(ox_range));
    segments.reserve(pair_count * sizeof(ox_u32));
    crossing_segments.reserve(pair_count * sizeof(ox_u32));
  }

  cl_uint count = 0;
  // in
  Buffer objects;      // ox_object
  Buffer members;      // two object indices per pair
  Buffer dense_first;  // monolithic: per pair the place of its first chunk
  // out
  Buffer pairs;              // ox_pair
  Buffer hits, crossings;    // their number per pair
  Buffer heads;              // per side the last of its crossings, AppendLists::crossing_links on
  Buffer ranges;             // ox_range of contacts
  Buffer segments;           // where the candidates of a pair start
  Buffer crossing_segments;  // where its crossings start
};

}  // namespace ode_ext
