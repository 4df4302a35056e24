// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/penetration.h"

#include <algorithm>

#include "falling_objects/pose.h"

namespace falling_objects {
namespace {

using ode_ext::oracle::Mesh;
using ode_ext::oracle::Pose;
using ode_ext::oracle::Vector;

Mesh oracle_mesh(const TriangleMesh& mesh) { return Mesh(mesh.vertices, mesh.indices); }

}  // namespace

PenetrationMeter::PenetrationMeter(const Scene& scene)
    : scene_(scene), ground_(oracle_mesh(scene.ground().mesh())) {
  for (const Shape& shape : scene.shapes()) {
    shapes_.push_back(oracle_mesh(shape.mesh));
    half_thinnest_.push_back(shapes_.back().thinnest_part() / 2);
  }
}

PenetrationMeter::Result PenetrationMeter::measure() const {
  const std::size_t count = scene_.objects().size();
  std::vector<Pose> poses;
  for (const Object& object : scene_.objects()) poses.push_back(pose_of(object.body));

  Result result;
  // What is neither deeper than all so far nor deeper than allowed need not be known exactly.
  const auto look_at = [&](std::size_t i, const Mesh& other, const Pose& pose, std::size_t j,
                           double allowed) {
    const double floor = std::min(result.deepest, allowed);
    const double depth =
        penetration(shapes_[scene_.objects()[i].shape], poses[i], other, pose, floor);
    result.deepest = std::max(result.deepest, depth);
    if (depth > allowed) result.too_deep.push_back({i, j, depth, allowed});
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t shape_i = scene_.objects()[i].shape;
    const Mesh& mesh = shapes_[shape_i];
    if (!mesh.closed()) continue;
    look_at(i, ground_, Pose{}, count, half_thinnest_[shape_i]);
    for (std::size_t j = i + 1; j < count; ++j) {
      const std::size_t shape_j = scene_.objects()[j].shape;
      const Mesh& other = shapes_[shape_j];
      const Vector apart = poses[i].position - poses[j].position;
      const double reach = mesh.radius() + other.radius();
      if (!other.closed() || dot(apart, apart) > reach * reach) continue;
      look_at(i, other, poses[j], j, std::min(half_thinnest_[shape_i], half_thinnest_[shape_j]));
    }
  }
  return result;
}

}  // namespace falling_objects
