// SPDX-License-Identifier: BSD-3-Clause
#include "support/fcl_oracle.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ode_ext::test {

struct FclSurface::Model {
  fcl::BVHModel<fcl::OBBRSSd> mesh;
};

namespace {

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

// Without contact points FCL lists the triangles all the same.
fcl::CollisionResultd ask(const FclSurface& a, const TestPose& pa, const FclSurface& b,
                          const TestPose& pb, std::size_t most) {
  const fcl::CollisionRequestd request(most, false);
  fcl::CollisionResultd result;
  fcl::collide(&a.model().mesh, fcl_pose(pa, pb.position), &b.model().mesh,
               fcl_pose(pb, pb.position), request, result);
  return result;
}

}  // namespace

FclSurface::FclSurface(const TestMesh& mesh) : size_(mesh_size(mesh)) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    vertices.emplace_back(mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]);
  }
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  auto model = std::make_shared<Model>();
  model->mesh.beginModel();
  model->mesh.addSubModel(vertices, triangles);
  model->mesh.endModel();
  model_ = std::move(model);
}

bool surfaces_intersect(const FclSurface& a, const TestPose& pa, const FclSurface& b,
                        const TestPose& pb) {
  return ask(a, pa, b, pb, 1).isCollision();
}

std::vector<TrianglePair> intersecting_triangles(const FclSurface& a, const TestPose& pa,
                                                 const FclSurface& b, const TestPose& pb) {
  const auto result = ask(a, pa, b, pb, std::numeric_limits<std::size_t>::max());
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    pairs.push_back({static_cast<unsigned>(contact.b1), static_cast<unsigned>(contact.b2)});
  }
  return pairs;
}

std::vector<TestPose> nudged(const TestPose& pose, double distance) {
  std::vector<TestPose> poses;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      poses.push_back(pose);
      poses.back().position[axis] += sign * distance;
    }
  }
  return poses;
}

bool surfaces_intersect(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                        const TestPose& pb) {
  return surfaces_intersect(FclSurface(a), pa, FclSurface(b), pb);
}

OracleAnswer surfaces_intersect_robustly(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                         const TestPose& pb) {
  const FclSurface fa(a), fb(b);
  const bool answer = surfaces_intersect(fa, pa, fb, pb);
  for (const TestPose& pose : nudged(pa, 1e-5 * std::max(fa.size(), fb.size()))) {
    if (surfaces_intersect(fa, pose, fb, pb) != answer) return OracleAnswer::Fragile;
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
