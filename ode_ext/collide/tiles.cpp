// SPDX-License-Identifier: BSD-3-Clause
#include "collide/tiles.h"

#include <algorithm>
#include <cmath>

#include "abi/types.h"

namespace ode_ext {

namespace {

ObjectSize size_of(const Mesh& mesh) {
  const MeshTopology& built = *mesh.topology;
  return {static_cast<std::uint32_t>(built.chunks.size()),
          static_cast<std::uint32_t>(mesh.vertices.size()),
          static_cast<std::uint32_t>(built.edges.size() + built.flat_edges.size()),
          static_cast<std::uint32_t>(built.triangles.size()),
          static_cast<std::uint32_t>(built.meshlets.meshlets.size()),
          mesh.deformable};
}

std::uint64_t most_crossings(const ObjectSize& a, const ObjectSize& b) {
  return std::uint64_t{a.edges} * b.triangles + std::uint64_t{b.edges} * a.triangles;
}

}  // namespace

std::vector<ObjectSize> object_sizes(const Scene& scene) {
  std::vector<ObjectSize> sizes;
  sizes.reserve(scene.objects.size());
  for (const Scene::Object& object : scene.objects)
    sizes.push_back(size_of(*scene.meshes[object.mesh]));
  return sizes;
}

std::vector<Tile> cut_into_tiles(const Scene& scene, const std::vector<ObjectSize>& sizes,
                                 std::uint64_t tile_vertices, std::size_t tile_pairs) {
  std::vector<Tile> tiles;
  std::uint64_t vertices = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    std::uint64_t of_pair = 0;
    for (const std::uint32_t object : scene.pairs[i])
      of_pair += std::uint64_t{kChunkVertices} * sizes[object].chunks;
    if (tiles.empty() || vertices + of_pair > tile_vertices || tiles.back().count == tile_pairs) {
      tiles.push_back({i, 0});
      vertices = 0;
    }
    vertices += of_pair;
    ++tiles.back().count;
  }
  return tiles;
}

ListCounts most_records(const Scene& scene, const std::vector<ObjectSize>& sizes, Tile tile,
                        const ColliderOptions& options) {
  std::uint64_t chunks = 0, vertices = 0, meshlets = 0, meshlet_pairs = 0, crossings = 0,
                contacts = 0;
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
    const ObjectSize& a = sizes[scene.pairs[i][0]];
    const ObjectSize& b = sizes[scene.pairs[i][1]];
    const std::uint64_t of_pair = std::uint64_t{a.vertices} + b.vertices;
    const std::uint64_t crossings_of_pair = options.edges ? most_crossings(a, b) : 0;
    chunks += std::uint64_t{a.chunks} + b.chunks;
    vertices += of_pair;
    crossings += crossings_of_pair;
    if (options.edges) {
      meshlets += std::uint64_t{OX_MOST_SUBTREES} * std::max(a.meshlets, b.meshlets);
      meshlet_pairs += std::uint64_t{a.meshlets} * b.meshlets;
    }
    if (!a.deformable && !b.deformable)
      contacts += options.max_contacts;
    else
      contacts += options.max_contacts_deformable != 0 ? options.max_contacts_deformable
                                                       : of_pair + crossings_of_pair;
  }
  // A chunk is in one list, a ray in two if the iterative algorithm hands it on.
  // A table has fewer than 8 places for each crossing it starts from, or 4 for each key: vertices
  // near one another, a vertex that is outside, an edge that crosses. A place is six words, and all
  // tables before the last one take no more than it does.
  const std::uint64_t flood_words =
      options.edges ? 12 * (8 * crossings + 4 * (2 * vertices + crossings) + 32 * tile.count) : 0;
  return {chunks,   chunks,        chunks,   vertices,  vertices,    vertices,
          meshlets, meshlet_pairs, vertices, crossings, flood_words, contacts};
}

ListCounts share(const ListCounts& counts, std::size_t part, std::size_t whole) {
  ListCounts result{};
  for (std::size_t i = 0; i < kListCount; ++i)
    result[i] = static_cast<std::uint64_t>(std::ceil(
        static_cast<double>(counts[i]) * static_cast<double>(part) / static_cast<double>(whole)));
  return result;
}

}  // namespace ode_ext
