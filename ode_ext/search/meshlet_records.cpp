// SPDX-License-Identifier: BSD-3-Clause
#include "search/meshlet_records.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mesh/normals.h"

namespace ode_ext {
namespace {

static_assert(offsetof(ox_meshlet, vertex) % 64 == 0 && offsetof(ox_meshlet, normal) % 64 == 0,
              "lib/lanes.h loads them whole");
static_assert(kMeshletTriangles == OX_LANES && kMeshletVertices == OX_LANES &&
              kMeshletEdges == OX_MESHLET_EDGES);

// Lanes beyond its vertices repeat the first.
std::uint32_t vertex_index(const Mesh& mesh, const Meshlet& meshlet, std::uint32_t k) {
  return mesh.topology->meshlets
      .vertices[meshlet.vertex_first + (k < meshlet.vertex_count ? k : 0)];
}

std::uint32_t triangle_index(const Mesh& mesh, const Meshlet& meshlet, std::uint32_t k) {
  return mesh.topology->meshlets.triangles[meshlet.triangle_first + k];
}

// Where it is among the vertices of the meshlet.
ox_u32 place_of(const Mesh& mesh, const Meshlet& meshlet, std::uint32_t vertex) {
  const auto first = mesh.topology->meshlets.vertices.begin() + meshlet.vertex_first;
  return static_cast<ox_u32>(std::find(first, first + meshlet.vertex_count, vertex) - first);
}

ox_u32 corner_places(const Mesh& mesh, const Meshlet& meshlet, std::uint32_t triangle) {
  ox_u32 places = 0;
  for (std::uint32_t corner = 0; corner < 3; ++corner)
    places |= place_of(mesh, meshlet, mesh.topology->triangles[triangle][corner])
              << OX_CORNER_SHIFT(corner);
  return places;
}

void store_indices(const Mesh& mesh, const Meshlet& meshlet, const MeshRange& range,
                   ox_meshlet& record) {
  record.triangle_count = meshlet.triangle_count;
  for (std::uint32_t k = 0; k < OX_LANES; ++k) {
    record.vertex_index[k] = range.vertex_first + vertex_index(mesh, meshlet, k);
  }
  for (std::uint32_t k = 0; k < meshlet.triangle_count; ++k) {
    const std::uint32_t triangle = triangle_index(mesh, meshlet, k);
    record.triangle[k] = range.triangle_first + triangle;
    record.places[k] = corner_places(mesh, meshlet, triangle);
  }
  record.edge_count = meshlet.edge_count;
  for (std::uint32_t k = 0; k < meshlet.edge_count; ++k) {
    const std::uint32_t edge = mesh.topology->meshlets.edges[meshlet.edge_first + k];
    record.edge[k] = range.edge_first + edge;
    for (std::uint32_t end = 0; end < 2; ++end)
      record.ends[k / 2] |= place_of(mesh, meshlet, mesh.topology->edge(edge).vertices[end])
                            << OX_END_SHIFT(k, end);
  }
}

Vec3f vertex_of(const Mesh& mesh, const Meshlet& meshlet, std::uint32_t k) {
  return mesh.vertices[vertex_index(mesh, meshlet, k)];
}

void store_places(const Mesh& mesh, const Meshlet& meshlet, ox_meshlet& record) {
  for (std::uint32_t k = 0; k < meshlet.triangle_count; ++k) {
    const Triangle& corners = mesh.topology->triangles[triangle_index(mesh, meshlet, k)];
    if (face_normal(mesh.vertices, corners) != Vec3f{}) record.with_area |= 1u << k;
  }
  for (std::uint32_t k = 0; k < OX_LANES; ++k) {
    const Vec3f vertex = vertex_of(mesh, meshlet, k);
    const Vec3f normal = mesh.normals[vertex_index(mesh, meshlet, k)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      record.vertex[axis][k] = vertex[axis];
      record.normal[axis][k] = normal[axis];
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [lo, hi] = std::minmax_element(record.vertex[axis], record.vertex[axis] + OX_LANES);
    record.lo[axis] = *lo;
    record.hi[axis] = *hi;
  }
}

// Any normal gives a slab that holds the meshlet; the mean of its triangles' by area a thin one.
void store_slab(const Mesh& mesh, const Meshlet& meshlet, ox_meshlet& record) {
  Vec3d sum{};
  for (std::uint32_t k = 0; k < meshlet.triangle_count; ++k) {
    const Triangle& corners = mesh.topology->triangles[triangle_index(mesh, meshlet, k)];
    const Vec3d a(mesh.vertices[corners[0]]);
    sum = sum + cross(Vec3d(mesh.vertices[corners[1]]) - a, Vec3d(mesh.vertices[corners[2]]) - a);
  }
  const double norm = length(sum);
  const Vec3f normal = norm > 0 ? Vec3f((1 / norm) * sum) : Vec3f{};
  record.slab_lo = INFINITY;
  record.slab_hi = -INFINITY;
  for (std::size_t axis = 0; axis < 3; ++axis) record.slab_normal[axis] = normal[axis];
  for (std::uint32_t k = 0; k < meshlet.vertex_count; ++k) {
    const float height = dot(normal, vertex_of(mesh, meshlet, k));
    record.slab_lo = std::min(record.slab_lo, height);
    record.slab_hi = std::max(record.slab_hi, height);
  }
}

// Of the first meshlet that has the vertex.
void store_firsts(const Mesh& mesh, const Meshlet& meshlet, std::vector<bool>& is_first,
                  ox_meshlet& record) {
  for (std::uint32_t k = 0; k < meshlet.vertex_count; ++k) {
    const std::uint32_t vertex = vertex_index(mesh, meshlet, k);
    if (!is_first[vertex]) continue;
    record.firsts |= 1u << k;
    is_first[vertex] = false;
  }
}

}  // namespace

void append_meshlets(const Mesh& mesh, const MeshRange& range, MappedRecords<ox_meshlet>& records) {
  std::vector<bool> is_first(mesh.vertices.size());
  for (const std::uint32_t vertex : mesh.topology->components) is_first[vertex] = true;
  for (const Meshlet& meshlet : mesh.topology->meshlets.meshlets) {
    ox_meshlet record{};
    store_indices(mesh, meshlet, range, record);
    store_firsts(mesh, meshlet, is_first, record);
    if (!mesh.deformable) {
      store_places(mesh, meshlet, record);
      store_slab(mesh, meshlet, record);
    }
    records.push_back(record);
  }
}

}  // namespace ode_ext
