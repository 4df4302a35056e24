// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/exit_distance.h"
#include "geometry/normals.h"
#include "geometry/topology.h"
#include "geometry/vertex_chunks.h"
#include "geometry/weld.h"

namespace ode_ext {
namespace {

// The grid is asked about the very position whose ray would be cast, so only what may call that
// position inside a little off the surface matters: a kernel computes it, and decides hits, to
// within 2^-20 ~ 1e-6 of the extents (a handful of float roundings of 2^-24). Ten times that is
// still less than 1/100 of the smallest cell (1/512 of a side) and costs nothing.
constexpr double kGridMargin = 1e-5;  // of the box's diagonal

bool is_finite(const TriangleSoup& soup) {
  return std::all_of(soup.begin(), soup.end(), [](const Vec3f& corner) {
    return std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z);
  });
}

// Up, so that the sphere holds every vertex.
float radius_about(Vec3f middle, const std::vector<Vec3f>& vertices) {
  double largest = 0;
  for (const Vec3f& vertex : vertices) {
    largest = std::max(largest, length(Vec3d(vertex) - Vec3d(middle)));
  }
  const auto rounded = static_cast<float>(largest);
  if (rounded >= largest) return rounded;
  return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

// Over the sides of all triangles; an edge inside the mesh counts once for each of them.
float mean_side(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum += length(Vec3d(vertices[triangle[k]]) - Vec3d(vertices[triangle[(k + 1) % 3]]));
    }
  }
  if (triangles.empty()) return 0;
  return static_cast<float>(sum / (3 * static_cast<double>(triangles.size())));
}

}  // namespace

Mesh build_mesh(const TriangleSoup& soup, const MeshOptions& options) {
  Mesh mesh;
  mesh.content_hash = hash_soup(soup.data(), soup.size());
  mesh.finite = is_finite(soup);
  if (!mesh.finite) return mesh;

  WeldedMesh welded = weld(soup);
  mesh.vertices = std::move(welded.vertices);
  mesh.triangles = std::move(welded.triangles);
  mesh.source_triangle = std::move(welded.source_triangle);

  const Orientation orientation = orient(mesh.vertices, mesh.triangles);
  mesh.closed = orientation.closed;
  mesh.inverted = orientation.inverted;
  mesh.reoriented = orientation.reoriented;

  Normals normals = compute_normals(mesh.vertices, mesh.triangles);
  mesh.normals = std::move(normals.vertices);
  mesh.face_normals = std::move(normals.faces);

  mesh.box = box_of(mesh.vertices);
  mesh.radius = radius_about(centre(mesh.box), mesh.vertices);
  mesh.mean_edge = mean_side(mesh.vertices, mesh.triangles);
  mesh.chunks = cut_into_chunks(mesh.vertices);
  mesh.bvh = build_bvh(mesh.vertices, mesh.triangles);
  if (mesh.closed) {
    mesh.exits = exit_distances(mesh.vertices, mesh.normals, mesh.triangles, mesh.bvh);
    if (options.occupancy_grid) {
      const double diagonal = length(extent(mesh.box));
      mesh.grid = build_occupancy_grid(mesh.vertices, mesh.triangles, mesh.box.lo, mesh.box.hi,
                                       static_cast<float>(kGridMargin * diagonal));
      mesh.clearance = build_clearance_grid(mesh.grid);
    }
  } else {
    const float thickness = options.open_thickness > 0 ? options.open_thickness : mesh.mean_edge;
    mesh.exits = exit_distances(mesh.vertices, mesh.normals, mesh.triangles, mesh.bvh, thickness);
  }
  return mesh;
}

}  // namespace ode_ext
