// SPDX-License-Identifier: BSD-3-Clause
// A batch in parts that fit the device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "collide/options.h"
#include "search/list.h"
#include "search/scene.h"

namespace ode_ext {

// What bounds what an object can append. Pairs name objects in any order, so what is asked of each
// lies close together.
struct ObjectSize {
  std::uint32_t chunks, vertices, edges, triangles, meshlets;
  bool deformable;
};
std::vector<ObjectSize> object_sizes(const Scene& scene);

// Tiles of at most so many vertices, unless it is a single pair's, and at most so many pairs.
// `sizes`: of all objects.
std::vector<Tile> cut_into_tiles(const Scene& scene, const std::vector<ObjectSize>& sizes,
                                 std::uint64_t tile_vertices, std::size_t tile_pairs);

// What a tile can append at the very most.
ListCounts most_records(const Scene& scene, const std::vector<ObjectSize>& sizes, Tile tile,
                        const ColliderOptions& options);

// The share of some records that a part of the pairs has.
ListCounts share(const ListCounts& counts, std::size_t part, std::size_t whole);

}  // namespace ode_ext
