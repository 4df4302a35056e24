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

// Tiles of at most so many vertices, unless it is a single pair's, and at most so many pairs.
std::vector<Tile> cut_into_tiles(const Scene& scene, std::uint64_t tile_vertices,
                                 std::size_t tile_pairs);

// What a tile can append at the very most.
ListCounts most_records(const Scene& scene, Tile tile, const ColliderOptions& options);

// The share of some records that a part of the pairs has.
ListCounts share(const ListCounts& counts, std::size_t part, std::size_t whole);

}  // namespace ode_ext
