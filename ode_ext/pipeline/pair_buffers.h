// SPDX-License-Identifier: BSD-3-Clause
// The objects of a step and the pairs of one of its tiles in device memory.
#pragma once

#include <cstddef>
#include <vector>

#include "device/buffer.h"
#include "pipeline/scene.h"
#include "pipeline/tiles.h"
#include "shared/types.h"

namespace ode_ext {

struct PairBuffers {
  explicit PairBuffers(Device& device);

  // These enqueue only: the sources live in here.
  void upload_objects(const Scene& scene);
  void upload_pairs(const Scene& scene, Tile tile);
  void upload_dense_first();  // of the pairs uploaded last

  cl_uint count = 0;
  cl_uint chunks = 0;  // of vertices, of all pairs
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

 private:
  std::vector<ox_object> host_objects_;
  std::vector<ox_u32> host_members_, host_dense_first_;
};

}  // namespace ode_ext
