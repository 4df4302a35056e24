// SPDX-License-Identifier: BSD-3-Clause
// Which vertices are inside the other mesh of their pair, by solid angles in double precision.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geometry/triangle_tree.h"
#include "support/rig.h"

namespace ode_ext::test {

// Of a built mesh, rigid, or deformable in its first shape.
class InsideOracle {
 public:
  explicit InsideOracle(const Mesh& mesh) : closed_(mesh.closed()) {
    for (const Triangle& t : mesh.topology->triangles)
      corners_.push_back({point_of(mesh.vertices[t[0]]), point_of(mesh.vertices[t[1]]),
                          point_of(mesh.vertices[t[2]])});
    low_ = point_of(mesh.box.lo);
    high_ = point_of(mesh.box.hi);
    std::vector<oracle::Triangle> triangles;
    for (const auto& corner : corners_)
      triangles.push_back({vector(corner[0]), vector(corner[1]), vector(corner[2])});
    surface_ = std::make_unique<oracle::TriangleTree>(std::move(triangles));
  }

  bool closed() const { return closed_; }
  bool may_be_inside(const Point& p, double margin) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < low_[k] - margin || p[k] > high_[k] + margin) return false;
    return true;
  }
  bool is_near(const Point& p, double distance) const {
    return surface_->closest(vector(p), 0).squared_distance <= distance * distance;
  }
  // By the sum of the triangles' solid angles (van Oosterom and Strackee 1983): right too of a
  // surface that cuts itself.
  bool is_inside(const Point& p) const;

 private:
  static oracle::Vector vector(const Point& p) { return {p[0], p[1], p[2]}; }

  bool closed_;
  std::vector<std::array<Point, 3>> corners_;
  Point low_{}, high_{};
  std::unique_ptr<oracle::TriangleTree> surface_;
};

// Of each vertex whether a face turns at it: within a facet it bounds nothing. Of a deformable
// mesh, and of what is in a sheet, any may.
inline std::vector<bool> bounding_vertices(const Mesh& mesh, const Mesh& other) {
  std::vector<bool> bounds(mesh.vertices.size(),
                           mesh.deformable || (other.deformable && !other.closed()));
  for (const Edge& edge : mesh.topology->edges)
    for (const std::uint32_t vertex : edge.vertices) bounds[vertex] = true;
  return bounds;
}

// Pair << 1 | side, and the vertex, counted within its mesh.
using SideVertex = std::pair<std::uint32_t, std::uint32_t>;

class InsideOracles {
 public:
  const InsideOracle& of(const std::shared_ptr<const Mesh>& mesh) {
    auto& kept = oracles_[mesh.get()];
    if (!kept.second) kept = {mesh, std::make_unique<InsideOracle>(*mesh)};
    return *kept.second;
  }

  // What the records of a flood list beside what they should, which is the vertices inside that
  // bound something; a line for each difference. Of open targets nothing is said, nor of vertices
  // so near to the surface that either is right, which `near` counts.
  std::vector<std::string> differences(const Scene& scene, const StepRecords& records) {
    std::set<SideVertex> listed;
    for (const ox_hit& hit : records.hits)
      listed.emplace(hit.pair_side,
                     Rig::shared().local_vertex(mesh_of(scene, hit.pair_side), hit.vertex));
    std::vector<std::string> lines;
    for (std::uint32_t i = 0; i < 2 * scene.pairs.size(); ++i) {
      const auto& source = scene.meshes[mesh_of(scene, i)];
      const InsideOracle& target = of(scene.meshes[mesh_of(scene, i ^ 1)]);
      if (!target.closed()) continue;
      const double doubt = kDoubt * static_cast<double>(records.pairs[i >> 1].epsilon);
      const auto bounds = bounding_vertices(*source, *scene.meshes[mesh_of(scene, i ^ 1)]);
      for (std::uint32_t v = 0; v < source->vertices.size(); ++v) {
        const Point p = in_target(scene, i, source->vertices[v]);
        const bool maybe = target.may_be_inside(p, doubt);
        if (maybe && target.is_near(p, doubt)) {
          ++near;
          continue;
        }
        const bool inside = maybe && bounds[v] && target.is_inside(p);
        if (inside != listed.contains({i, v}))
          lines.push_back("pair " + std::to_string(i >> 1) + " side " + std::to_string(i & 1) +
                          " vertex " + std::to_string(v) +
                          (inside ? " is inside and not listed" : " is listed and not inside"));
      }
    }
    return lines;
  }

  static std::uint32_t mesh_of(const Scene& scene, std::uint32_t pair_side) {
    return scene.objects[scene.pairs[pair_side >> 1][pair_side & 1]].mesh;
  }
  // Of the pair's side, in the frame of the other; not by way of the world, which may be far.
  static Point in_target(const Scene& scene, std::uint32_t pair_side, Vec3f vertex) {
    const auto frame_of = [&](std::uint32_t side) {
      const Scene::Object& object = scene.objects[scene.pairs[pair_side >> 1][side]];
      return frame_pose(object.pose, *scene.meshes[object.mesh]);
    };
    const Pose ps = frame_of(pair_side & 1), pt = frame_of(1 - (pair_side & 1));
    const Vec3d d = ps.rotate(Vec3d(vertex)) + (ps.position - pt.position);
    const auto& r = pt.rotation;
    return {r[0] * d.x + r[3] * d.y + r[6] * d.z, r[1] * d.x + r[4] * d.y + r[7] * d.z,
            r[2] * d.x + r[5] * d.y + r[8] * d.z};
  }

  std::size_t near = 0;

 private:
  std::map<const Mesh*, std::pair<std::shared_ptr<const Mesh>, std::unique_ptr<InsideOracle>>>
      oracles_;
};

}  // namespace ode_ext::test
