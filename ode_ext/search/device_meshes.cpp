// SPDX-License-Identifier: BSD-3-Clause
#include "search/device_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "mesh/both.h"
#include "mesh/ray_cast.h"
#include "mesh/rings.h"

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

// The deform step makes the rest of the records of deformable meshes.
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
  if (mesh.deformable) return record;
  const Triangle& corners = mesh.topology->triangles[triangle];
  const bool flat = mesh.face_normals[triangle] == Vec3f{};
  store(record.a, mesh.vertices[corners[0]]);
  store(record.b, mesh.vertices[corners[flat ? 0 : 1]]);
  store(record.c, mesh.vertices[corners[flat ? 0 : 2]]);
  store(record.normal, mesh.face_normals[triangle]);
  return record;
}

static_assert(OX_CHUNK_VERTICES == kChunkVertices);

// A thread takes tens of microseconds to start, a triangle half of one.
constexpr std::size_t kTrianglesAThread = 16384;

template <class T>
void upload_all(Buffer& buffer, const std::vector<T>& records) {
  buffer.reserve(records.size() * sizeof(T));
  buffer.write(records.data(), records.size() * sizeof(T));
}

// Of the vertices of a deformable mesh [m]; a closed one's come from rays.
float thickness_of(const Mesh& mesh) {
  if (mesh.closed()) return INFINITY;
  return mesh.open_thickness > 0 ? mesh.open_thickness : mesh.mean_edge;
}

// How far the rays of an open mesh go [m].
float reach_of(const Mesh& mesh) {
  if (mesh.closed()) return 0;
  if (mesh.deformable) return thickness_of(mesh);
  float reach = 0;
  for (const float exit : mesh.exits)
    if (std::isfinite(exit)) reach = std::max(reach, exit);
  return reach;
}

// What a mesh and each of its shapes have of their own.
void measure(const Mesh& mesh, ox_mesh& record) {
  const Box& box = mesh.box;
  store(record.box_centre, centre(box));
  store(record.box_half, half_size(box));
  record.extent = length(farthest_corner(box));
  record.radius = mesh.radius;
  record.mean_edge = mesh.mean_edge;
  record.reach = reach_of(mesh);
}

// A power of two, so that scaling rounds nothing.
float scale_for(float extent) {
  if (extent == 0) return 1;
  return std::ldexp(1.0f, std::clamp(-std::ilogb(extent), -126, 126));
}

}  // namespace

DeviceMeshes::DeviceMeshes(Program& program)
    : deform_(program),
      records_(program.device()),
      chunks_(program.device()),
      vertices_(program.device()),
      triangles_(program.device()),
      edges_(program.device()),
      ring_starts_(program.device()),
      rings_(program.device()),
      meshlets_(program.device()),
      meshlet_nodes_(program.device()),
      facets_(program.device()),
      topologies_(program.device()) {}

void DeviceMeshes::set(const MeshList& meshes) {
  // Nothing is in flight here (a batch ends with a wait), so the arrays may be rebuilt in place.
  const bool anew = !are_shapes_of_the_same(meshes);
  if (anew)
    rebuild(meshes);
  else
    forget_sources();
  moves_.clear();
  positions_.clear();
  for (auto& [i, deformable] : deformables_) {
    const bool changed = anew || meshes[i] != meshes_[i];
    if (changed || deformable.moving) add_move(i, *meshes[i], !changed);
    if (!anew) deformable.moving = changed;
  }
  if (!moves_.empty()) deform_.run(moves_, positions_, *this);
  meshes_ = meshes;
}

void DeviceMeshes::forget() {
  meshes_.clear();
  deformables_.clear();
}

bool DeviceMeshes::are_shapes_of_the_same(const MeshList& meshes) const {
  return std::equal(meshes.begin(), meshes.end(), meshes_.begin(), meshes_.end(),
                    [](const auto& a, const auto& b) { return a->topology == b->topology; });
}

void DeviceMeshes::rebuild(const MeshList& meshes) {
  std::unordered_map<const MeshTopology*, const Mesh*> shapes_before;
  for (const auto& mesh : meshes_) shapes_before.emplace(mesh->topology.get(), mesh.get());
  const MeshList before = std::exchange(meshes_, {});  // keeps them until they are appended
  ranges_.clear();
  owner_triangles_.clear();
  host_records_.clear();
  host_chunks_.clear();
  host_vertices_.clear();
  host_triangles_.clear();
  host_edges_.clear();
  host_ring_starts_ = {0};
  host_rings_.clear();
  host_meshlets_.clear();
  host_meshlet_nodes_.clear();
  host_facets_.clear();
  host_topologies_.clear();
  deformables_.clear();
  reserve(meshes);
  for (const auto& mesh : meshes) {
    const auto known = shapes_before.find(mesh->topology.get());
    append(*mesh, known == shapes_before.end() ? nullptr : known->second);
  }
  upload();
}

// Growing bit by bit, they would be copied several times, at sizes that count.
void DeviceMeshes::reserve(const MeshList& meshes) {
  const auto sum = [&](auto count_of) {
    std::size_t total = 0;
    for (const auto& mesh : meshes) total += count_of(*mesh->topology);
    return total;
  };
  const std::size_t vertices = sum([](const MeshTopology& mesh) { return mesh.vertex_count; });
  const std::size_t triangles = sum([](const MeshTopology& mesh) { return mesh.triangles.size(); });
  host_chunks_.reserve(sum([](const MeshTopology& mesh) { return mesh.chunks.size(); }));
  host_vertices_.reserve(vertices);
  host_ring_starts_.reserve(vertices + 1);
  host_triangles_.reserve(triangles);
  host_facets_.reserve(triangles);
  const std::size_t edges =
      sum([](const MeshTopology& mesh) { return mesh.edges.size() + mesh.flat_edges.size(); });
  host_edges_.reserve(edges);
  host_rings_.reserve(2 * edges);
  host_meshlets_.reserve(
      sum([](const MeshTopology& mesh) { return mesh.meshlets.meshlets.size(); }));
}

// What was uploaded only, once it has been.
void DeviceMeshes::forget_sources() {
  const auto free = [](auto&... sources) {
    (std::decay_t<decltype(sources)>().swap(sources), ...);
  };
  free(host_chunks_, host_vertices_, host_triangles_, host_edges_, host_ring_starts_, host_rings_,
       host_meshlets_, host_meshlet_nodes_, host_facets_, host_topologies_);
}

void DeviceMeshes::append(const Mesh& mesh, const Mesh* before) {
  const MeshTopology& built = *mesh.topology;
  ox_mesh record{};
  record.chunk_first = static_cast<ox_u32>(host_chunks_.size());
  record.chunk_count = static_cast<ox_u32>(built.chunks.size());
  record.triangle_first = static_cast<ox_u32>(host_triangles_.size());
  record.triangle_count = static_cast<ox_u32>(built.triangles.size());
  record.meshlet_first = static_cast<ox_u32>(host_meshlets_.size());
  record.meshlet_count = static_cast<ox_u32>(built.meshlets.meshlets.size());
  record.meshlet_node_first = static_cast<ox_u32>(host_meshlet_nodes_.size());
  record.meshlet_node_count = static_cast<ox_u32>(built.meshlets.tree.size());
  record.component_count = static_cast<ox_u32>(built.components.size());
  record.flags = (mesh.closed() ? OX_MESH_CLOSED : 0u) |
                 (mesh.deformable ? OX_MESH_DEFORMABLE : 0u) |
                 (mesh.deformable && !mesh.closed() ? OX_MESH_TWO_SIDED : 0u);
  measure(mesh, record);

  const MeshRange first{static_cast<std::uint32_t>(host_vertices_.size()), record.triangle_first,
                        static_cast<std::uint32_t>(host_edges_.size())};
  ranges_.push_back(first);
  if (mesh.deformable) {
    Deformable& deformable = deformables_[static_cast<std::uint32_t>(host_records_.size())];
    deformable.topology = append_topology(built, host_topologies_);
    deformable.moving = before != nullptr && before != &mesh;
  }
  record.flat_edge_first = first.edge_first + static_cast<ox_u32>(built.edges.size());
  host_records_.push_back(record);
  for (const VertexChunk& chunk : built.chunks)
    host_chunks_.push_back(to_record(mesh, chunk, first.vertex_first));
  const Mesh& placed = mesh.deformable && before != nullptr ? *before : mesh;
  for (std::size_t i = 0; i < placed.vertices.size(); ++i)
    host_vertices_.push_back(to_record(placed, i));
  for (const MeshletNode& node : built.meshlets.tree)
    host_meshlet_nodes_.push_back(to_record(node, record.extent));
  do_both(
      worthwhile_threads(built.triangles.size(), kTrianglesAThread),
      [&] {
        append_edges(built, first);
        append_rings(built, first);
        append_owners(built, first.vertex_first);
      },
      [&] {
        append_meshlets(mesh, first, host_meshlets_);
        append_triangles(mesh, first);
      });
}

void DeviceMeshes::append_triangles(const Mesh& mesh, const MeshRange& first) {
  const std::vector<std::uint32_t>& facets = mesh.topology->facets;
  for (std::uint32_t t = 0; t < mesh.topology->triangles.size(); ++t) {
    host_triangles_.push_back(to_record(mesh, t, first));
    host_facets_.push_back(facets.empty() ? t : facets[t]);
  }
}

void DeviceMeshes::append_owners(const MeshTopology& mesh, std::uint32_t vertex_first) {
  owner_triangles_.resize(host_vertices_.size(), UINT32_MAX);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t corner : mesh.triangles[t]) {
      std::uint32_t& owner = owner_triangles_[vertex_first + corner];
      owner = std::min(owner, mesh.source_triangle[t]);
    }
}

void DeviceMeshes::append_edges(const MeshTopology& mesh, const MeshRange& first) {
  const auto append_all = [&](const std::vector<Edge>& edges) {
    for (const Edge& edge : edges) {
      ox_edge record{};
      for (std::size_t k = 0; k < 2; ++k) {
        const std::uint32_t triangle = edge.triangles[k];
        record.vertex[k] = first.vertex_first + edge.vertices[k];
        record.triangle[k] = triangle == kNone ? OX_NONE : first.triangle_first + triangle;
      }
      host_edges_.push_back(record);
    }
  };
  append_all(mesh.edges);
  append_all(mesh.flat_edges);
}

void DeviceMeshes::append_rings(const MeshTopology& mesh, const MeshRange& first) {
  const Rings rings = build_rings(mesh.vertex_count, mesh.edges, mesh.flat_edges);
  const ox_u32 before = host_ring_starts_.back();
  for (std::size_t v = 1; v < rings.starts.size(); ++v)
    host_ring_starts_.push_back(before + rings.starts[v]);
  for (const RingNeighbour& neighbour : rings.neighbours)
    host_rings_.push_back(
        {first.vertex_first + neighbour.vertex, first.edge_first + neighbour.edge});
}

void DeviceMeshes::add_move(std::uint32_t mesh, const Mesh& shape, bool rests) {
  const Deformable& deformable = deformables_.at(mesh);
  MeshMove move;
  // Not host_records_[mesh] itself: what was uploaded just now may still be read from there.
  move.record.shape = host_records_[mesh];
  measure(shape, move.record.shape);
  move.record.mesh = mesh;
  move.record.vertex_first = ranges_[mesh].vertex_first;
  move.record.vertex_count = static_cast<ox_u32>(shape.vertices.size());
  move.record.position_first = static_cast<ox_u32>(positions_.size());
  move.record.corner_first = deformable.topology.corner_first;
  move.record.incident_first = deformable.topology.incident_first;
  move.record.scale = scale_for(move.record.shape.extent);
  move.record.thickness = thickness_of(shape);
  // A vertex may lie on a face that is not its own (mesh/exit_distance.cpp); rounding, here of
  // the ray test too, sees them less than 16 roundings of the size apart (ray_step.cl).
  move.record.on_surface = 0x1p-20f * 2 * shape.radius;
  move.rests = rests;
  moves_.push_back(move);
  if (!rests) positions_.insert(positions_.end(), shape.vertices.begin(), shape.vertices.end());
}

void DeviceMeshes::upload() {
  upload_all(records_, host_records_);
  upload_all(chunks_, host_chunks_);
  upload_all(vertices_, host_vertices_);
  upload_all(triangles_, host_triangles_);
  upload_all(edges_, host_edges_);
  upload_all(ring_starts_, host_ring_starts_);
  upload_all(rings_, host_rings_);
  upload_all(meshlets_, host_meshlets_);
  upload_all(meshlet_nodes_, host_meshlet_nodes_);
  upload_all(facets_, host_facets_);
  upload_all(topologies_, host_topologies_);
}

}  // namespace ode_ext
