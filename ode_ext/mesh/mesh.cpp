// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/both.h"
#include "mesh/bvh.h"
#include "mesh/edge_pairs.h"
#include "mesh/exit_distance.h"
#include "mesh/facets.h"
#include "mesh/folded.h"
#include "mesh/half_edges.h"
#include "mesh/inner_walls.h"
#include "mesh/measures.h"
#include "mesh/neighbours.h"
#include "mesh/normals.h"
#include "mesh/orientation.h"
#include "mesh/origin.h"
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

// A thread takes tens of microseconds to start, a triangle one.
constexpr std::size_t kTrianglesABranch = 8192;

// What depends on where the vertices are, and is made on the device of what deforms.
void find_facets(const std::vector<Neighbours>& across, Mesh& mesh, MeshTopology& topology) {
  Normals normals = compute_normals(mesh.vertices, topology.triangles);
  mesh.normals = std::move(normals.vertices);
  topology.facets = facets(mesh.vertices, topology.triangles, normals.faces, across);
}

// What depends on edges.
void connect(Edges edges, const Bvh& bvh, MeshTopology& topology) {
  std::vector<Edge> all = edges.apart;
  all.insert(all.end(), edges.flat.begin(), edges.flat.end());
  topology.meshlets = build_meshlets(bvh, topology.triangles, all);
  topology.components = std::move(edges.components);
  topology.edges = std::move(edges.apart);
  topology.flat_edges = std::move(edges.flat);
  topology.sides = std::move(edges.sides);
  find_joined(topology.edges, topology.flat_edges, topology.chunks);
}

// What was appended to keeps no room for more.
void trim(Mesh& mesh, MeshTopology& topology) {
  mesh.vertices.shrink_to_fit();
  topology.source_triangle.shrink_to_fit();
  topology.edges.shrink_to_fit();
  topology.flat_edges.shrink_to_fit();
  topology.meshlets.meshlets.shrink_to_fit();
  topology.meshlets.vertices.shrink_to_fit();
  topology.meshlets.tree.shrink_to_fit();
  topology.chunks.shrink_to_fit();
}

}  // namespace

Mesh build_mesh(SourceTriangles given, const MeshOptions& options) {
  Mesh mesh;
  mesh.source = std::move(given);
  const SourceTriangles& source = mesh.source;
  mesh.content_hash = hash_soup(source);
  mesh.shape_hash = mesh.content_hash;
  mesh.deformable = options.deformable;
  if (mesh.deformable) mesh.open_thickness = options.open_thickness;
  mesh.finite = is_finite(source);
  if (!mesh.finite) return mesh;

  // No number may depend on the shape that a deformable mesh happened to be met in first, or equal
  // contacts would be told apart by its past; nor on how the program lists a rigid one.
  WeldedMesh welded = weld(source, mesh.deformable ? VertexOrder::kListing : VertexOrder::kRuns);
  if (!mesh.deformable) {
    order_by_vertices(welded);
    leave_out_folded(welded);
  }
  std::vector<HalfEdge> half_edges = half_edges_of(welded.triangles);
  if (!mesh.deformable && leave_out_inner_walls(welded, half_edges))
    half_edges = half_edges_of(welded.triangles);
  const auto topology = std::make_shared<MeshTopology>();
  mesh.topology = topology;
  mesh.vertices = std::move(welded.vertices);
  if (!mesh.deformable) mesh.origin = exact_origin(box_of(mesh.vertices));
  for (Vec3f& vertex : mesh.vertices) vertex = vertex - mesh.origin;
  topology->vertex_count = mesh.vertices.size();
  topology->triangles = std::move(welded.triangles);
  topology->source_triangle = std::move(welded.source_triangle);

  const std::vector<Triangle>& triangles = topology->triangles;
  const Orientation orientation = orient(mesh.vertices, topology->triangles, half_edges);
  if (mesh.deformable)
    pair_by_number(half_edges);
  else
    pair_by_solids(mesh.vertices, triangles, half_edges);
  topology->closed = orientation.closed;
  topology->inverted = orientation.inverted;
  topology->reoriented = orientation.reoriented;

  if (!mesh.deformable) mesh.shape_hash = hash_soup(mesh.vertices.data(), mesh.vertices.size());
  mesh.box = box_of(mesh.vertices);
  mesh.mean_edge = mean_side(mesh.vertices, triangles);
  topology->chunks = cut_into_chunks(mesh.vertices);
  Bvh bvh;
  Edges edges;
  do_both(
      worthwhile_threads(triangles.size(), kTrianglesABranch),
      [&] { bvh = build_bvh(mesh.vertices, triangles); },
      [&] {
        const std::vector<Neighbours> across = neighbours(triangles.size(), half_edges);
        if (!mesh.deformable) find_facets(across, mesh, *topology);
        edges = find_edges(mesh.vertices, half_edges, topology->facets);
      });
  connect(std::move(edges), bvh, *topology);
  trim(mesh, *topology);
  if (options.deformable) {  // the device makes the rest, so that it is the same in every shape
    mesh.radius = half_diagonal(mesh.box);
    topology->source = source;
    topology->corner_vertex = std::move(welded.corner_vertex);
    topology->spread = meshlet_spread(topology->meshlets, mesh.vertices, triangles);
    return mesh;
  }

  mesh.radius = radius_about(centre(mesh.box), mesh.vertices);
  const float thickness = mesh.closed()                ? std::numeric_limits<float>::infinity()
                          : options.open_thickness > 0 ? options.open_thickness
                                                       : mesh.mean_edge;
  mesh.exits = exit_distances(mesh.vertices, mesh.normals, triangles, bvh, thickness);
  return mesh;
}

Vec3d face_normal(const Mesh& mesh, std::uint32_t triangle) {
  const Triangle& corners = mesh.topology->triangles[triangle];
  if (!mesh.deformable) return Vec3d(face_normal(mesh.vertices, corners));
  return face_normal(mesh.vertices[corners[0]], mesh.vertices[corners[1]],
                     mesh.vertices[corners[2]]);
}

Box box_as_given(const Mesh& mesh) {
  return {mesh.box.lo + mesh.origin, mesh.box.hi + mesh.origin};
}

}  // namespace ode_ext
