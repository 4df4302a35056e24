// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/convex.h"

#include <algorithm>
#include <cstdint>

#include "mesh/corners.h"

namespace ode_ext {
namespace {

// [1] of the size: what the device does not know of two coordinates of one mesh, by OX_INFLATION
// and OX_ROUNDING (kernels/lib/general_position.h).
constexpr double kCoordinates = 0x1p-19;

// How far, at most, a corner of `other` rises over the plane of a triangle [m].
double rise(const Mesh& mesh, std::uint32_t triangle, std::uint32_t other) {
  const Vec3d normal = face_normal(mesh, triangle);
  const Vec3d at(mesh.vertices[mesh.topology->triangles[triangle][0]]);
  double most = 0;
  for (const Vec3d& corner : corners_of(mesh.vertices, mesh.topology->triangles[other]))
    most = std::max(most, dot(normal, corner - at));
  return most;
}

}  // namespace

bool is_convex(const Mesh& mesh) {
  const MeshTopology& built = *mesh.topology;
  if (mesh.deformable || !built.closed || built.components.size() != 1) return false;
  const double flat = kCoordinates * length(Vec3d(farthest_corner(mesh.box)));
  return std::all_of(built.edges.begin(), built.edges.end(), [&](const Edge& edge) {
    const std::uint32_t one = edge.triangles[0], other = edge.triangles[1];
    return other != kNone && (rise(mesh, one, other) <= flat || rise(mesh, other, one) <= flat);
  });
}

}  // namespace ode_ext
