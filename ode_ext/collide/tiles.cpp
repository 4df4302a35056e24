// SPDX-License-Identifier: BSD-3-Clause
#include "collide/tiles.h"

#include <algorithm>
#include <cmath>

#include "abi/types.h"

namespace ode_ext {

std::vector<Tile> cut_into_tiles(const Scene& scene, std::uint64_t tile_vertices,
                                 std::size_t tile_pairs) {
  std::vector<Tile> tiles;
  std::uint64_t vertices = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    std::uint64_t of_pair = 0;
    for (const std::uint32_t object : scene.pairs[i])
      of_pair += kChunkVertices * scene.meshes[scene.objects[object].mesh]->topology->chunks.size();
    if (tiles.empty() || vertices + of_pair > tile_vertices || tiles.back().count == tile_pairs) {
      tiles.push_back({i, 0});
      vertices = 0;
    }
    vertices += of_pair;
    ++tiles.back().count;
  }
  return tiles;
}

namespace {

std::uint64_t most_crossings(const Scene& scene, const std::array<std::uint32_t, 2>& pair) {
  const MeshTopology& a = *scene.meshes[scene.objects[pair[0]].mesh]->topology;
  const MeshTopology& b = *scene.meshes[scene.objects[pair[1]].mesh]->topology;
  const auto edges = [](const MeshTopology& mesh) {
    return std::uint64_t{mesh.edges.size()} + mesh.flat_edges.size();
  };
  return edges(a) * b.triangles.size() + edges(b) * a.triangles.size();
}

}  // namespace

ListCounts most_records(const Scene& scene, Tile tile, const ColliderOptions& options) {
  std::uint64_t chunks = 0, vertices = 0, meshlets = 0, meshlet_pairs = 0, crossings = 0,
                contacts = 0;
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
    std::uint64_t of_pair = 0;
    bool deformable = false;
    for (const std::uint32_t object : scene.pairs[i]) {
      const Mesh& mesh = *scene.meshes[scene.objects[object].mesh];
      deformable = deformable || mesh.deformable;
      chunks += mesh.topology->chunks.size();
      of_pair += mesh.vertices.size();
    }
    vertices += of_pair;
    if (options.edges) {
      const auto count = [&](std::size_t k) {
        const Mesh& mesh = *scene.meshes[scene.objects[scene.pairs[i][k]].mesh];
        return std::uint64_t{mesh.topology->meshlets.meshlets.size()};
      };
      meshlets += OX_MOST_SUBTREES * std::max(count(0), count(1));
      meshlet_pairs += count(0) * count(1);
      crossings += most_crossings(scene, scene.pairs[i]);
    }
    if (!deformable)
      contacts += options.max_contacts;
    else
      contacts += options.max_contacts_deformable != 0
                      ? options.max_contacts_deformable
                      : of_pair + (options.edges ? most_crossings(scene, scene.pairs[i]) : 0);
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
