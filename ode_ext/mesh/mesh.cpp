// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/exit_distance.h"
#include "mesh/facets.h"
#include "mesh/half_edges.h"
#include "mesh/measures.h"
#include "mesh/normals.h"
#include "mesh/orientation.h"
#include "mesh/vertex_chunks.h"
#include "mesh/weld.h"

namespace ode_ext {
namespace {

float radius_about(Vec3f middle, const std::vector<Vec3f>& vertices) {
  double largest = 0;
  for (const Vec3f& vertex : vertices) {
    largest = std::max(largest, length(Vec3d(vertex) - Vec3d(middle)));
  }
  return rounded_up(largest);
}

// What depends on edges.
void connect(const std::vector<HalfEdge>& half_edges, Mesh& mesh) {
  Edges edges = find_edges(mesh.vertices, half_edges, mesh.facets);
  std::vector<Edge> all = edges.apart;
  all.insert(all.end(), edges.flat.begin(), edges.flat.end());
  mesh.meshlets = build_meshlets(mesh.bvh, mesh.triangles, all);
  mesh.rings = build_rings(mesh.vertices.size(), all);
  mesh.edges = std::move(edges.apart);
  mesh.flat_edges = std::move(edges.flat);
}

}  // namespace

Mesh build_mesh(const TriangleSoup& soup, const MeshOptions& options) {
  Mesh mesh;
  mesh.soup = soup;
  mesh.content_hash = hash_soup(soup.data(), soup.size());
  mesh.shape_hash = mesh.content_hash;
  mesh.deformable = options.deformable;
  if (mesh.deformable) mesh.open_thickness = options.open_thickness;
  mesh.finite = is_finite(soup);
  if (!mesh.finite) return mesh;

  // No number may depend on the shape that a deformable mesh happened to be met in first, or equal
  // contacts would be told apart by its past; nor on how the program lists a rigid one.
  WeldedMesh welded = weld(soup, mesh.deformable ? VertexOrder::kListing : VertexOrder::kRuns);
  if (!mesh.deformable) order_by_vertices(welded);
  mesh.vertices = std::move(welded.vertices);
  mesh.triangles = std::move(welded.triangles);
  mesh.source_triangle = std::move(welded.source_triangle);

  std::vector<HalfEdge> half_edges = half_edges_of(mesh.triangles);
  const Orientation orientation = orient(mesh.vertices, mesh.triangles, half_edges);
  mesh.closed = orientation.closed;
  mesh.inverted = orientation.inverted;
  mesh.reoriented = orientation.reoriented;

  if (!mesh.deformable) mesh.shape_hash = hash_soup(mesh.vertices.data(), mesh.vertices.size());
  mesh.box = box_of(mesh.vertices);
  mesh.mean_edge = mean_side(mesh.vertices, mesh.triangles);
  mesh.chunks = cut_into_chunks(mesh.vertices);
  mesh.bvh = build_bvh(mesh.vertices, mesh.triangles);
  mesh.neighbours = neighbours(mesh.triangles.size(), half_edges);
  if (options.deformable) {  // the device makes the rest, so that it is the same in every shape
    mesh.radius = half_diagonal(mesh.box);
    mesh.corner_vertex = std::move(welded.corner_vertex);
    connect(half_edges, mesh);
    return mesh;
  }

  Normals normals = compute_normals(mesh.vertices, mesh.triangles);
  mesh.normals = std::move(normals.vertices);
  mesh.face_normals = std::move(normals.faces);
  mesh.facets = facets(mesh.vertices, mesh.triangles, mesh.face_normals, mesh.neighbours);
  connect(half_edges, mesh);
  mesh.radius = radius_about(centre(mesh.box), mesh.vertices);
  if (mesh.closed) {
    mesh.exits = exit_distances(mesh.vertices, mesh.normals, mesh.triangles, mesh.bvh);
  } else {
    const float thickness = options.open_thickness > 0 ? options.open_thickness : mesh.mean_edge;
    mesh.exits = exit_distances(mesh.vertices, mesh.normals, mesh.triangles, mesh.bvh, thickness);
  }
  return mesh;
}

Vec3d face_normal(const Mesh& mesh, std::uint32_t triangle) {
  if (!mesh.deformable) return Vec3d(mesh.face_normals[triangle]);
  const Triangle& corners = topology(mesh).triangles[triangle];
  return face_normal(mesh.vertices[corners[0]], mesh.vertices[corners[1]],
                     mesh.vertices[corners[2]]);
}

}  // namespace ode_ext
