// SPDX-License-Identifier: BSD-3-Clause
// The objects of a batch and the pairs of one of its tiles in device memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abi/types.h"
#include "opencl/buffer.h"
#include "search/scene.h"

namespace ode_ext {

struct PairBuffers {
  explicit PairBuffers(Device& device);

  // These do not wait: the sources of what they enqueue live in here.
  void upload_objects(const Scene& scene);
  // `longest_first`: those that had the most features come first, in order (pair_order.h).
  void upload_pairs(const Scene& scene, Tile tile, bool longest_first = false);
  // What there is of each pair, in the order of the scene.
  std::span<const ox_range> in_order(std::span<const ox_range> found_ranges);

  cl_uint count = 0;
  // in
  Buffer objects;  // ox_object
  Buffer members;  // two object indices per pair
  // out
  Buffer pairs;   // ox_pair
  Buffer found;   // ox_found
  Buffer ranges;  // ox_range of contacts

 private:
  std::vector<ox_object> host_objects_;
  std::vector<ox_u32> host_members_;
  std::vector<std::uint32_t> order_;  // which pairs of the tile they are; empty: as they come
  std::vector<ox_range> in_order_;
};

}  // namespace ode_ext
