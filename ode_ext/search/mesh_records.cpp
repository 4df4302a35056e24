// SPDX-License-Identifier: BSD-3-Clause
#include "search/mesh_records.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mesh/both.h"
#include "mesh/convex.h"
#include "mesh/measures.h"
#include "mesh/normals.h"
#include "mesh/ray_cast.h"
#include "mesh/rings.h"
#include "search/deform_topology.h"

namespace ode_ext {
namespace {

void store(ox_f32 (&target)[3], Vec3f v) {
  target[0] = v.x;
  target[1] = v.y;
  target[2] = v.z;
}

// Rounded up, so that centre +- half holds the box.
Vec3f half_size(const Box& box) {
  const Vec3f c = centre(box);
  const Vec3f h = max(box.hi - c, c - box.lo);
  return {std::nextafter(h.x, INFINITY), std::nextafter(h.y, INFINITY),
          std::nextafter(h.z, INFINITY)};
}

void store_box(const Box& box, ox_chunk& record) {
  store(record.centre, centre(box));
  store(record.half_size, half_size(box));
}

ox_vertex to_record(const Mesh& mesh, std::size_t i) {
  ox_vertex record{};
  store(record.position, mesh.vertices[i]);
  if (mesh.deformable) return record;
  store(record.direction, Vec3f{} - mesh.normals[i]);
  record.exit = mesh.exits[i];
  return record;
}

ox_chunk to_record(const Mesh& mesh, const VertexChunk& chunk, std::uint32_t vertex_first) {
  ox_chunk record{};
  record.first = vertex_first + chunk.first;
  record.count = chunk.count;
  record.is_joined = chunk.joined ? 1 : 0;
  if (mesh.deformable) return record;
  store_box(chunk.box, record);
  for (std::uint32_t v = chunk.first; v < chunk.first + chunk.count; ++v)
    if (std::isfinite(mesh.exits[v])) record.reach = std::max(record.reach, mesh.exits[v]);
  return record;
}

// A ray origin inside the box and the slab distances carry together less than 16 roundings of
// coordinates up to the extent (ray_step.cl); a box this much larger is never missed for them.
ox_meshlet_node to_record(const MeshletNode& node, float extent) {
  const float margin = 0x1p-20f * extent;
  ox_meshlet_node record{};
  record.count = node.count;
  std::copy(node.first.begin(), node.first.end(), record.first);
  for (std::size_t k = 0; k < kTreeWidth; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      record.lo[axis][k] = node.boxes[k].lo[axis] - margin;
      record.hi[axis][k] = node.boxes[k].hi[axis] + margin;
    }
    record.child[k] =
        node.nodes[k] != kNone ? node.nodes[k] << 1 : node.first[k] << 1 | OX_CHILD_MESHLET;
  }
  return record;
}

static_assert(kTreeWidth == OX_LANES && kTreeStack == OX_TREE_STACK);
static_assert(offsetof(ox_meshlet_node, lo) % 64 == 0 && offsetof(ox_meshlet_node, hi) % 64 == 0,
              "lib/lanes.h loads them whole");

static_assert(kNone == OX_NONE && kWithinFacet == OX_WITHIN_FACET);

// Over all meshes, what is at a side of a triangle (mesh/edges.h).
ox_u32 over_all(std::uint32_t side, const MeshRange& first) {
  if (side == kNone) return OX_NONE;
  return side + ((side & kWithinFacet) != 0 ? first.triangle_first : first.edge_first);
}

ox_triangle to_record(const Mesh& mesh, std::uint32_t triangle, const MeshRange& first) {
  ox_triangle record{};
  const Sides& sides = mesh.topology->sides[triangle];
  record.side_ab = over_all(sides[0], first);
  record.side_bc = over_all(sides[1], first);
  record.side_ca = over_all(sides[2], first);
  const std::vector<std::uint32_t>& facets = mesh.topology->facets;
  record.facet = facets.empty() ? triangle : facets[triangle];
  if (mesh.deformable) return record;
  const Triangle& corners = mesh.topology->triangles[triangle];
  const Vec3f normal = face_normal(mesh.vertices, corners);
  const bool flat = normal == Vec3f{};
  store(record.a, mesh.vertices[corners[0]]);
  store(record.b, mesh.vertices[corners[flat ? 0 : 1]]);
  store(record.c, mesh.vertices[corners[flat ? 0 : 2]]);
  store(record.normal, normal);
  return record;
}

static_assert(OX_CHUNK_VERTICES == kChunkVertices);

// A thread takes tens of microseconds to start, a triangle half of one.
constexpr std::size_t kTrianglesAThread = 16384;

// How far the rays of an open mesh go [m].
float reach_of(const Mesh& mesh) {
  if (mesh.closed()) return 0;
  if (mesh.deformable) return thickness_of(mesh);
  float reach = 0;
  for (const float exit : mesh.exits)
    if (std::isfinite(exit)) reach = std::max(reach, exit);
  return reach;
}

}  // namespace

void measure(const Mesh& mesh, ox_mesh& record) {
  const Box& box = mesh.box;
  store(record.box_centre, centre(box));
  store(record.box_half, half_size(box));
  record.extent = length(farthest_corner(box));
  record.radius = mesh.radius;
  record.mean_edge = mesh.mean_edge;
  record.reach = reach_of(mesh);
}

float thickness_of(const Mesh& mesh) {
  if (mesh.closed()) return INFINITY;
  return mesh.open_thickness > 0 ? mesh.open_thickness : mesh.mean_edge;
}

MeshBuffers::MeshBuffers(Device& device)
    : chunks(device, Memory::kShared),
      vertices(device, Memory::kShared),
      triangles(device, Memory::kShared),
      edges(device, Memory::kShared),
      ring_starts(device, Memory::kShared),
      rings(device, Memory::kShared),
      meshlets(device, Memory::kShared),
      meshlet_nodes(device, Memory::kShared),
      topologies(device, Memory::kShared) {}

void MeshBuffers::release() {
  for (Buffer* buffer : {&chunks, &vertices, &triangles, &edges, &ring_starts, &rings, &meshlets,
                         &meshlet_nodes, &topologies})
    buffer->release();
}

void MeshCounts::add(const Mesh& mesh) {
  const MeshTopology& built = *mesh.topology;
  chunks += built.chunks.size();
  vertices += built.vertex_count;
  triangles += built.triangles.size();
  edges += built.edges.size() + built.flat_edges.size();
  meshlets += built.meshlets.meshlets.size();
  meshlet_nodes += built.meshlets.tree.size();
  if (mesh.deformable) topology_words += count_topology_words(built);
}

MeshRecords::MeshRecords(MeshBuffers& buffers, const MeshCounts& kept, const MeshCounts& more)
    : chunks_(buffers.chunks, kept.chunks, more.chunks),
      vertices_(buffers.vertices, kept.vertices, more.vertices),
      triangles_(buffers.triangles, kept.triangles, more.triangles),
      edges_(buffers.edges, kept.edges, more.edges),
      ring_starts_(buffers.ring_starts, kept.vertices, more.vertices + 1),
      rings_(buffers.rings, 2 * kept.edges, 2 * more.edges),
      meshlets_(buffers.meshlets, kept.meshlets, more.meshlets),
      meshlet_nodes_(buffers.meshlet_nodes, kept.meshlet_nodes, more.meshlet_nodes),
      topologies_(buffers.topologies, kept.topology_words, more.topology_words) {}

MeshRange MeshRecords::next() const {
  return {static_cast<std::uint32_t>(vertices_.size()),
          static_cast<std::uint32_t>(triangles_.size()), static_cast<std::uint32_t>(edges_.size()),
          static_cast<std::uint32_t>(topologies_.size())};
}

ox_mesh MeshRecords::append(const Mesh& mesh) {
  const MeshTopology& built = *mesh.topology;
  const MeshRange first = next();
  ox_mesh record{};
  record.chunk_first = static_cast<ox_u32>(chunks_.size());
  record.chunk_count = static_cast<ox_u32>(built.chunks.size());
  record.triangle_first = first.triangle_first;
  record.triangle_count = static_cast<ox_u32>(built.triangles.size());
  record.meshlet_first = static_cast<ox_u32>(meshlets_.size());
  record.meshlet_count = static_cast<ox_u32>(built.meshlets.meshlets.size());
  record.meshlet_node_first = static_cast<ox_u32>(meshlet_nodes_.size());
  record.meshlet_node_count = static_cast<ox_u32>(built.meshlets.tree.size());
  record.component_count = static_cast<ox_u32>(built.components.size());
  record.flat_edge_first = first.edge_first + static_cast<ox_u32>(built.edges.size());
  record.flags = (mesh.closed() ? OX_MESH_CLOSED : 0u) |
                 (mesh.deformable ? OX_MESH_DEFORMABLE : 0u) |
                 (mesh.deformable && !mesh.closed() ? OX_MESH_TWO_SIDED : 0u) |
                 (is_convex(mesh) ? OX_MESH_CONVEX : 0u);
  measure(mesh, record);
  if (!mesh.closed() && !mesh.deformable)
    record.vector_area = vector_area_share(mesh.vertices, built.triangles);

  if (mesh.deformable) append_topology(built, topologies_);
  for (const MeshletNode& node : built.meshlets.tree)
    meshlet_nodes_.push_back(to_record(node, record.extent));
  do_both(
      worthwhile_threads(built.triangles.size(), kTrianglesAThread),
      [&] {
        append_edges(built, first);
        append_rings(built, first);
        append_vertices(mesh);
      },
      [&] {
        append_meshlets(mesh, first, meshlets_);
        append_triangles(mesh, first);
      });
  return record;
}

void MeshRecords::append_vertices(const Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  for (const VertexChunk& chunk : mesh.topology->chunks)
    chunks_.push_back(to_record(mesh, chunk, first));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) vertices_.push_back(to_record(mesh, i));
}

void MeshRecords::append_triangles(const Mesh& mesh, const MeshRange& first) {
  for (std::uint32_t t = 0; t < mesh.topology->triangles.size(); ++t)
    triangles_.push_back(to_record(mesh, t, first));
}

void MeshRecords::append_edges(const MeshTopology& mesh, const MeshRange& first) {
  const auto append_all = [&](const std::vector<Edge>& edges) {
    for (const Edge& edge : edges) {
      ox_edge record{};
      for (std::size_t k = 0; k < 2; ++k) {
        const std::uint32_t triangle = edge.triangles[k];
        record.vertex[k] = first.vertex_first + edge.vertices[k];
        record.triangle[k] = triangle == kNone ? OX_NONE : first.triangle_first + triangle;
      }
      edges_.push_back(record);
    }
  };
  append_all(mesh.edges);
  append_all(mesh.flat_edges);
}

void MeshRecords::append_rings(const MeshTopology& mesh, const MeshRange& first) {
  const Rings rings = build_rings(mesh.vertex_count, mesh.edges, mesh.flat_edges);
  const auto before = static_cast<ox_u32>(rings_.size());
  for (std::size_t v = 0; v < mesh.vertex_count; ++v)
    ring_starts_.push_back(before + rings.starts[v]);
  for (const RingNeighbour& neighbour : rings.neighbours)
    rings_.push_back({first.vertex_first + neighbour.vertex, first.edge_first + neighbour.edge});
}

MeshCounts MeshRecords::close() {
  ring_starts_.push_back(static_cast<ox_u32>(rings_.size()));
  chunks_.close();
  vertices_.close();
  triangles_.close();
  edges_.close();
  ring_starts_.close();
  rings_.close();
  meshlets_.close();
  meshlet_nodes_.close();
  topologies_.close();
  return {chunks_.size(),   vertices_.size(),      triangles_.size(), edges_.size(),
          meshlets_.size(), meshlet_nodes_.size(), topologies_.size()};
}

}  // namespace ode_ext
