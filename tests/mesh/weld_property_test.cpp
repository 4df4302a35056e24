// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "mesh/mesh.h"
#include "mesh/weld.h"
#include "support/validate_bvh.h"

namespace ode_ext {
namespace {

// Corners on a lattice of 3 x 3 x 3 places: most soups have collapsed, duplicate and non-manifold
// triangles.
TriangleSoup lattice_soup() {
  const auto count = *rc::gen::inRange<std::size_t>(0, 40);
  TriangleSoup soup(3 * count);
  for (Vec3f& corner : soup) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corner[axis] = static_cast<float>(*rc::gen::inRange(-1, 2));
    }
  }
  return soup;
}

RC_GTEST_PROP(WeldProperty, KeepsEveryTriangleThatDoesNotCollapse, ()) {
  const TriangleSoup soup = lattice_soup();
  const WeldedMesh mesh = weld(soup);
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < soup.size() / 3; ++i) {
    const Vec3f a = soup[3 * i], b = soup[3 * i + 1], c = soup[3 * i + 2];
    if (a == b || b == c || c == a) continue;
    RC_ASSERT(next < mesh.triangles.size());
    RC_ASSERT(mesh.source_triangle[next] == i);
    for (std::size_t k = 0; k < 3; ++k) {
      RC_ASSERT(mesh.vertices[mesh.triangles[next][k]] == soup[3 * i + k]);
    }
    ++next;
  }
  RC_ASSERT(next == mesh.triangles.size());
}

RC_GTEST_PROP(WeldProperty, HasNoPlaceTwice, ()) {
  const WeldedMesh mesh = weld(lattice_soup());
  std::set<std::tuple<float, float, float>> places;
  for (const Vec3f& v : mesh.vertices) RC_ASSERT(places.emplace(v.x, v.y, v.z).second);
}

RC_GTEST_PROP(MeshProperty, IsWholeForAnySoup, ()) {
  const TriangleSoup soup = lattice_soup();
  const Mesh mesh = build_mesh(soup);
  RC_ASSERT(mesh.finite);
  RC_ASSERT(test::validate_bvh(build_bvh(mesh.vertices, mesh.topology->triangles), mesh.vertices,
                               mesh.topology->triangles) == "");
  RC_ASSERT(mesh.normals.size() == mesh.vertices.size());
  RC_ASSERT(mesh.exits.size() == mesh.vertices.size());
  RC_ASSERT(mesh.topology->source_triangle.size() == mesh.topology->triangles.size());
  for (std::uint32_t t = 0; t < mesh.topology->triangles.size(); ++t) {
    const double norm = length(face_normal(mesh, t));
    RC_ASSERT(norm == 0 || std::fabs(norm - 1) < 1e-6);
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const float norm = length(mesh.normals[i]);
    RC_ASSERT(norm == 0 || std::fabs(norm - 1) < 1e-6f);
    RC_ASSERT(mesh.exits[i] >= 0);
    RC_ASSERT(norm > 0 || mesh.exits[i] == 0);
    RC_ASSERT(mesh.closed() || mesh.exits[i] <= mesh.mean_edge);
  }
}

}  // namespace
}  // namespace ode_ext
