// SPDX-License-Identifier: BSD-3-Clause
// Against FCL and winding numbers: no contact between meshes that are apart, and one wherever a
// vertex is inside. (Two meshes of which only edges cross have no vertex inside; vertex rays say
// nothing of them, and nothing is said of them here.)
#include <gtest/gtest.h>

#include "geometry/mesh_oracle.h"
#include "property/random_pair.h"
#include "reference/reference_hits.h"
#include "support/fcl_oracle.h"

namespace ode_ext::test {
namespace {

// The greatest distance [m] of a vertex of the source under the surface of the target.
double deepest_vertex(const TestScene& scene, std::size_t side) {
  const TestMesh &source = scene.mesh_of(0, side), &target = scene.mesh_of(0, 1 - side);
  const oracle::Mesh surface(target.vertices, target.indices);
  double deepest = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(source.vertex_count()); ++i) {
    const Point p =
        to_local(scene.pose_of(0, 1 - side), to_world(scene.pose_of(0, side), source.vertex(i)));
    deepest = std::max(deepest, -surface.signed_distance({p[0], p[1], p[2]}));
  }
  return deepest;
}

void agrees(const TestScene& scene) {
  const TestMesh &a = scene.mesh_of(0, 0), &b = scene.mesh_of(0, 1);
  const TestPose &pa = scene.pose_of(0, 0), &pb = scene.pose_of(0, 1);
  const bool has_contact = !collide(scene).empty();
  const double inside = std::max(deepest_vertex(scene, 0), deepest_vertex(scene, 1));
  RC_CLASSIFY(inside > 0, "a vertex inside");
  RC_CLASSIFY(has_contact, "in contact");
  if (inside > comparison_tolerance(a, pa, b, pb)) RC_ASSERT(has_contact);
  const OracleAnswer answer = surfaces_intersect_robustly(a, pa, b, pb);
  RC_CLASSIFY(answer == OracleAnswer::Fragile, "fragile");
  RC_CLASSIFY(answer == OracleAnswer::Intersect && !has_contact, "edges cross, no contact");
  if (answer == OracleAnswer::Apart && !one_contains_the_other(a, pa, b, pb))
    RC_ASSERT(!has_contact);
}

RC_GTEST_PROP(AgreementProperty, HoldsForRandomClosedMeshes, ()) {
  Random random = random_numbers();
  agrees(random_pair(random));
}

RC_GTEST_PROP(AgreementProperty, HoldsForMeshesThatAreJustApartOrJustTouching, ()) {
  Random random = random_numbers();
  const TestMesh meshes[] = {make_cube(1, 3), make_icosphere(0.6, 2), make_torus(0.5, 0.2, 12, 8),
                             make_l(1)};
  const TestMesh &a = meshes[random.below(4)], &b = meshes[random.below(4)];
  const TestPose pb = random.pose(1);
  TestPose pa = random.pose(0);
  const Point away = random.direction();
  // Bisection along a line for where FCL's answer changes, then a little to either side of it.
  double in = 0, out = 3;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (in + out);
    pa.position = pb.position + middle * away;
    (surfaces_intersect(a, pa, b, pb) ? in : out) = middle;
  }
  pa.position = pb.position + (out + random.uniform(-0.01, 0.01)) * away;
  agrees(one_pair(a, pa, b, pb));
}

RC_GTEST_PROP(AgreementProperty, HoldsForMeshesInsideEachOther, ()) {
  Random random = random_numbers();
  const TestMesh outer[] = {make_cube(2, 3), make_icosphere(1.2, 2), make_torus(1, 0.5, 16, 10)};
  const int k = random.below(3);
  const TestMesh inner = scaled(random_closed_mesh(random), 0.15);
  const TestPose frame = random.pose(2);
  TestPose inside = random.pose(0.3);
  if (k == 2) inside.position = inside.position + Point{1, 0, 0};  // in the tube
  const TestPose pose = composed(frame, inside);
  agrees(random.below(2) == 0 ? one_pair(inner, pose, outer[k], frame)
                              : one_pair(outer[k], frame, inner, pose));
}

}  // namespace
}  // namespace ode_ext::test
