// SPDX-License-Identifier: BSD-3-Clause
#include "support/fcl_oracle.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace ode_ext::test {
namespace {

using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<FclMesh> fcl_mesh(const TestMesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    vertices.emplace_back(mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]);
  }
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  auto model = std::make_shared<FclMesh>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d fcl_pose(const TestPose& pose, const Point& origin) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < 3; ++j) {
      result.linear()(row, static_cast<Eigen::Index>(j)) = pose.rotation[3 * i + j];
    }
    result.translation()[row] = pose.position[i] - origin[i];
  }
  return result;
}

bool intersect(const FclMesh& a, const TestPose& pa, const FclMesh& b, const TestPose& pb) {
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  fcl::collide(&a, fcl_pose(pa, pb.position), &b, fcl_pose(pb, pb.position), request, result);
  return result.isCollision();
}

}  // namespace

bool surfaces_intersect(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                        const TestPose& pb) {
  return intersect(*fcl_mesh(a), pa, *fcl_mesh(b), pb);
}

OracleAnswer surfaces_intersect_robustly(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                         const TestPose& pb) {
  const auto fa = fcl_mesh(a), fb = fcl_mesh(b);
  const bool answer = intersect(*fa, pa, *fb, pb);
  const double nudge = 1e-5 * std::max(mesh_size(a), mesh_size(b));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      TestPose nudged = pa;
      nudged.position[axis] += sign * nudge;
      if (intersect(*fa, nudged, *fb, pb) != answer) return OracleAnswer::Fragile;
    }
  }
  return answer ? OracleAnswer::Intersect : OracleAnswer::Apart;
}

double winding_number(const TestMesh& mesh, const Point& point) {
  double half_angles = 0;
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const Point a = mesh.corner(t, 0) - point, b = mesh.corner(t, 1) - point,
                c = mesh.corner(t, 2) - point;
    const double la = length(a), lb = length(b), lc = length(c);
    half_angles += std::atan2(dot(a, cross(b, c)),
                              la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return half_angles / (2 * std::numbers::pi);
}

bool one_contains_the_other(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                            const TestPose& pb) {
  const auto inside = [](const TestMesh& inner, const TestPose& pi, const TestMesh& outer,
                         const TestPose& po) {
    // Without passing through world coordinates, which may be huge.
    const Point p = rotate_back(po, rotate(pi, inner.corner(0, 0)) + (pi.position - po.position));
    return std::fabs(winding_number(outer, p)) > 0.5;
  };
  return inside(a, pa, b, pb) || inside(b, pb, a, pa);
}

}  // namespace ode_ext::test
