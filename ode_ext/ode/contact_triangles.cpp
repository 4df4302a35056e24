// SPDX-License-Identifier: BSD-3-Clause
#include "ode/contact_triangles.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace ode_ext {
namespace {

Vec3d to_local(const Pose& pose, Vec3d point) {
  const auto& r = pose.rotation;
  const Vec3d p = point - pose.position;
  return {r[0] * p.x + r[3] * p.y + r[6] * p.z, r[1] * p.x + r[4] * p.y + r[7] * p.z,
          r[2] * p.x + r[5] * p.y + r[8] * p.z};
}

// How far off its edge a contact may be: the device places edges of one mesh in the frame of the
// other with floats, in fewer than 16 roundings of coordinates of at most this size.
double rounding(const AnswerCopy& answer) {
  const auto& [a, b] = answer.members;
  return 16 * 0x1p-24 *
         (length(Vec3d(farthest_corner(a.mesh->box))) +
          length(Vec3d(farthest_corner(b.mesh->box))) + length(a.pose.position - b.pose.position));
}

double distance_to_segment(Vec3d point, Vec3d from, Vec3d to) {
  const Vec3d along = to - from;
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? std::clamp(dot(point - from, along) / length2, 0.0, 1.0) : 0.0;
  return length(point - (from + t * along));
}

// The corner or the two ends of the edge of a triangle that a point lies on; none: neither.
std::vector<std::uint32_t> feature_at(const Mesh& mesh, const Triangle& triangle, Vec3d point,
                                      double tolerance) {
  std::vector<std::uint32_t> feature;
  double nearest = tolerance;
  for (const std::uint32_t corner : triangle) {
    const double distance = length(point - Vec3d(mesh.vertices[corner]));
    if (!(distance <= nearest)) continue;
    nearest = distance;
    feature = {corner};
  }
  if (!feature.empty()) return feature;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
    const double distance =
        distance_to_segment(point, Vec3d(mesh.vertices[from]), Vec3d(mesh.vertices[to]));
    if (!(distance <= nearest)) continue;
    nearest = distance;
    feature = {from, to};
  }
  return feature;
}

bool has_all(const Triangle& triangle, std::span<const std::uint32_t> corners) {
  return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
    return std::find(triangle.begin(), triangle.end(), corner) != triangle.end();
  });
}

}  // namespace

std::vector<std::uint32_t> triangles_of(const AnswerCopy& answer, const Contact& contact,
                                        std::size_t side) {
  const PairMember& member = answer.members[side];
  const MeshTopology& built = *member.mesh->topology;
  const std::uint32_t own = contact.triangles[side];
  const auto place = std::find(built.source_triangle.begin(), built.source_triangle.end(), own);
  if (place == built.source_triangle.end()) return {own};
  const Triangle& triangle =
      built.triangles[static_cast<std::size_t>(place - built.source_triangle.begin())];

  // A vertex is where the contact is. One of two edges is half-way between them: the first mesh
  // reaches so far against the normal, the second along it.
  const Vec3d half = (side == 0 ? -0.5 : 0.5) * contact.depth * contact.normal;
  const double tolerance = rounding(answer);
  std::vector<std::uint32_t> feature =
      feature_at(*member.mesh, triangle, to_local(member.pose, contact.position), tolerance);
  if (feature.empty())
    feature = feature_at(*member.mesh, triangle, to_local(member.pose, contact.position + half),
                         tolerance);
  if (feature.empty()) return {own};

  std::vector<std::uint32_t> triangles;
  for (std::size_t t = 0; t < built.triangles.size(); ++t)
    if (has_all(built.triangles[t], feature)) triangles.push_back(built.source_triangle[t]);
  std::sort(triangles.begin(), triangles.end());  // the program's callbacks meet them in its order
  return triangles;
}

}  // namespace ode_ext
