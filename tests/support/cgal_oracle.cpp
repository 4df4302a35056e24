// SPDX-License-Identifier: BSD-3-Clause
#include "support/cgal_oracle.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <vector>

namespace ode_ext::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

// Relative to `origin`, so that a scene far away is not rounded more.
Triangles placed(const TestMesh& mesh, const TestPose& pose, const Point& origin) {
  const auto corner = [&](std::size_t triangle, std::size_t k) {
    const Point p = rotate(pose, mesh.corner(triangle, k)) + (pose.position - origin);
    return Kernel::Point_3(p[0], p[1], p[2]);
  };
  Triangles triangles;
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    triangles.emplace_back(corner(t, 0), corner(t, 1), corner(t, 2));
  }
  return triangles;
}

}  // namespace

bool surfaces_intersect_exactly(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                const TestPose& pb) {
  const Triangles queries = placed(a, pa, pb.position), targets = placed(b, pb, pb.position);
  const Tree tree(targets.begin(), targets.end());
  return std::any_of(queries.begin(), queries.end(),
                     [&](const auto& triangle) { return tree.do_intersect(triangle); });
}

}  // namespace ode_ext::test
