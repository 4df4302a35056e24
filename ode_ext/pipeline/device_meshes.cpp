// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/device_meshes.h"

#include <algorithm>
#include <cmath>

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

ox_vertex to_record(const Mesh& mesh, std::size_t i) {
  ox_vertex record{};
  store(record.position, mesh.vertices[i]);
  store(record.direction, Vec3f{} - mesh.normals[i]);
  record.exit = mesh.exits[i];
  return record;
}

ox_chunk to_record(const Mesh& mesh, const VertexChunk& chunk, std::uint32_t vertex_first) {
  ox_chunk record{};
  record.first = vertex_first + chunk.first;
  record.count = chunk.count;
  store(record.centre, centre(chunk.box));
  store(record.half_size, half_size(chunk.box));
  record.radius = std::nextafter(length(half_size(chunk.box)), INFINITY);
  for (std::uint32_t v = chunk.first; v < chunk.first + chunk.count; ++v)
    if (std::isfinite(mesh.exits[v])) record.reach = std::max(record.reach, mesh.exits[v]);
  return record;
}

// A ray origin inside the box and the slab distances carry together less than 16 roundings of
// coordinates up to the extent (ray_step.cl); a box this much larger is never missed for them.
ox_node to_record(const BvhNode& node, float extent) {
  const float margin = 0x1p-20f * extent;
  ox_node record{};
  for (std::size_t k = 0; k < 3; ++k) {
    record.lo[k] = node.lo[k] - margin;
    record.hi[k] = node.hi[k] + margin;
  }
  record.skip = node.skip;
  record.leaf = node.leaf;
  return record;
}

ox_triangle to_record(const Mesh& mesh, std::uint32_t triangle) {
  const auto& corners = mesh.triangles[triangle];
  const bool flat = mesh.face_normals[triangle] == Vec3f{};
  ox_triangle record{};
  store(record.a, mesh.vertices[corners[0]]);
  store(record.b, mesh.vertices[corners[flat ? 0 : 1]]);
  store(record.c, mesh.vertices[corners[flat ? 0 : 2]]);
  store(record.normal, mesh.face_normals[triangle]);
  record.id = mesh.source_triangle[triangle];
  return record;
}

void append_bytes(std::vector<ox_u32>& words, const std::vector<std::uint8_t>& bytes) {
  const std::size_t first = words.size();
  words.resize(first + (bytes.size() + 3) / 4);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    words[first + i / 4] |= ox_u32{bytes[i]} << (8 * (i % 4));
}

static_assert(OX_BLOCK_CELLS == kBlockCells && OX_CHUNK_VERTICES == kChunkVertices);

template <class T>
void upload_all(Buffer& buffer, const std::vector<T>& records) {
  buffer.reserve(records.size() * sizeof(T));
  buffer.write(records.data(), records.size() * sizeof(T));
}

}  // namespace

DeviceMeshes::DeviceMeshes(Device& device)
    : device_(&device),
      records_(device),
      chunks_(device),
      vertices_(device),
      nodes_(device),
      triangles_(device),
      grids_(device) {}

void DeviceMeshes::set(const std::vector<std::shared_ptr<const Mesh>>& meshes) {
  if (meshes == meshes_) return;
  // Nothing is in flight here (a step ends with a wait), so the arrays may be rebuilt in place.
  meshes_.clear();
  places_.clear();
  owner_triangles_.clear();
  host_records_.clear();
  host_chunks_.clear();
  host_vertices_.clear();
  host_nodes_.clear();
  host_triangles_.clear();
  host_grids_.clear();
  for (const auto& mesh : meshes) append(*mesh);
  upload();
  meshes_ = meshes;
}

void DeviceMeshes::append(const Mesh& mesh) {
  const Box& box = mesh.box;
  ox_mesh record{};
  record.chunk_first = static_cast<ox_u32>(host_chunks_.size());
  record.chunk_count = static_cast<ox_u32>(mesh.chunks.size());
  record.node_first = static_cast<ox_u32>(host_nodes_.size());
  record.node_count = static_cast<ox_u32>(mesh.bvh.nodes.size());
  record.triangle_first = static_cast<ox_u32>(host_triangles_.size());
  record.grid_first = static_cast<ox_u32>(host_grids_.size());
  record.clearance_first = static_cast<ox_u32>(host_grids_.size() + mesh.grid.bits.size());
  record.block_side = mesh.clearance.block_side;
  std::copy(mesh.grid.cells.begin(), mesh.grid.cells.end(), record.grid_cells);
  record.flags = (mesh.closed ? OX_MESH_CLOSED : 0u) | (mesh.grid.bits.empty() ? 0u : OX_MESH_GRID);
  store(record.box_centre, centre(box));
  store(record.box_half, half_size(box));
  store(record.grid_origin, mesh.grid.origin);
  store(record.grid_scale, mesh.grid.cells_per_meter);
  const Vec3f farthest = max(max(box.hi, Vec3f{} - box.hi), max(box.lo, Vec3f{} - box.lo));
  record.extent = length(farthest);
  record.radius = mesh.radius;

  const auto vertex_first = static_cast<std::uint32_t>(host_vertices_.size());
  places_.push_back({vertex_first, record.triangle_first});
  host_records_.push_back(record);
  for (const VertexChunk& chunk : mesh.chunks)
    host_chunks_.push_back(to_record(mesh, chunk, vertex_first));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    host_vertices_.push_back(to_record(mesh, i));
  for (const BvhNode& node : mesh.bvh.nodes) host_nodes_.push_back(to_record(node, record.extent));
  for (const std::uint32_t triangle : mesh.bvh.order)
    host_triangles_.push_back(to_record(mesh, triangle));
  owner_triangles_.resize(host_vertices_.size(), UINT32_MAX);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t corner : mesh.triangles[t]) {
      std::uint32_t& owner = owner_triangles_[vertex_first + corner];
      owner = std::min(owner, mesh.source_triangle[t]);
    }
  host_grids_.insert(host_grids_.end(), mesh.grid.bits.begin(), mesh.grid.bits.end());
  append_bytes(host_grids_, mesh.clearance.steps);
}

void DeviceMeshes::upload() {
  upload_all(records_, host_records_);
  upload_all(chunks_, host_chunks_);
  upload_all(vertices_, host_vertices_);
  upload_all(nodes_, host_nodes_);
  upload_all(triangles_, host_triangles_);
  upload_all(grids_, host_grids_);
}

}  // namespace ode_ext
