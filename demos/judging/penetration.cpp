// SPDX-License-Identifier: BSD-3-Clause
#include "judging/penetration.h"

#include <algorithm>
#include <array>

#include "simulation/pose.h"

namespace falling_objects {
namespace {

using ode_ext::oracle::Mesh;
using ode_ext::oracle::Pose;

Mesh oracle_mesh(const TriangleMesh& mesh) { return Mesh(mesh.vertices, mesh.indices); }

}  // namespace

PenetrationMeter::PenetrationMeter(const Scene& scene) : scene_(scene) {
  if (const Ground& ground = scene.ground(); !ground.empty()) {
    ground_.emplace(oracle_mesh(ground.mesh()));
    // Its vertices are rounded to floats, its heights are not.
    constexpr double kRounding = 1e-4;  // [m]
    ground_->know_outside(
        [&ground](ode_ext::oracle::Vector p) { return p.z > ground.height(p.x, p.y) + kRounding; });
  }
  for (const Shape& shape : scene.shapes()) {
    shapes_.push_back(oracle_mesh(shape.mesh));
    half_thinnest_.push_back(shapes_.back().thinnest_part() / 2);
  }
  for (const Object& object : scene.objects()) {
    const bool closed = shapes_[object.shape].closed();
    measures_all_ = measures_all_ && closed;
    measures_any_ = measures_any_ || closed;
  }
}

std::vector<Pose> PenetrationMeter::poses() const {
  std::vector<Pose> poses;
  for (const Object& object : scene_.objects()) poses.push_back(pose_of(object.body));
  return poses;
}

std::vector<Ball> PenetrationMeter::balls(const std::vector<Pose>& poses) const {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    balls.push_back({poses[i].position, shapes_[scene_.objects()[i].shape].radius()});
  }
  return balls;
}

template <class Visit>
void PenetrationMeter::for_each_pair(const std::vector<Pose>& poses, Visit visit) const {
  const std::size_t count = scene_.objects().size();
  const auto pairs = near_pairs(balls(poses));
  auto pair = pairs.begin();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t shape_i = scene_.objects()[i].shape;
    const bool closed = shapes_[shape_i].closed();
    if (closed && ground_) visit(i, count, *ground_, Pose{}, half_thinnest_[shape_i]);
    for (; pair != pairs.end() && (*pair)[0] == i; ++pair) {
      const std::size_t j = (*pair)[1];
      const std::size_t shape_j = scene_.objects()[j].shape;
      if (!closed || !shapes_[shape_j].closed()) continue;
      if (!can_move(scene_.objects()[i]) && !can_move(scene_.objects()[j])) continue;
      visit(i, j, shapes_[shape_j], poses[j],
            std::min(half_thinnest_[shape_i], half_thinnest_[shape_j]));
    }
  }
}

PenetrationMeter::Result PenetrationMeter::measure() const {
  const std::vector<Pose> poses = this->poses();
  Result result;
  for_each_pair(poses, [&](std::size_t i, std::size_t j, const Mesh& other, const Pose& pose,
                           double allowed) {
    // What is neither deeper than all so far nor deeper than allowed need not be known exactly.
    const double floor = std::min(result.deepest, allowed);
    const double depth =
        penetration(shapes_[scene_.objects()[i].shape], poses[i], other, pose, floor);
    result.deepest = std::max(result.deepest, depth);
    if (depth > allowed) result.too_deep.push_back({i, j, depth, allowed});
  });
  return result;
}

std::vector<double> PenetrationMeter::all_depths() const {
  const std::vector<Pose> poses = this->poses();
  std::vector<double> depths;
  for_each_pair(
      poses, [&](std::size_t i, std::size_t, const Mesh& other, const Pose& pose, double) {
        const double depth = penetration(shapes_[scene_.objects()[i].shape], poses[i], other, pose);
        if (depth > 0) depths.push_back(depth);
      });
  return depths;
}

}  // namespace falling_objects
