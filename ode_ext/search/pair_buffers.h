// SPDX-License-Identifier: BSD-3-Clause
// The objects of a batch and the pairs of one of its tiles in device memory.
#pragma once

#include <cstddef>
#include <vector>

#include "abi/types.h"
#include "opencl/buffer.h"
#include "search/scene.h"

namespace ode_ext {

struct PairBuffers {
  explicit PairBuffers(Device& device);

  // These do not wait: the sources of what they enqueue live in here.
  void upload_objects(const Scene& scene);
  void upload_pairs(const Scene& scene, Tile tile);

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
};

}  // namespace ode_ext
