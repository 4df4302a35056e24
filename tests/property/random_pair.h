// SPDX-License-Identifier: BSD-3-Clause
// Pairs of meshes for the properties, and what the collider says of them.
#pragma once

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "collide/collider.h"
#include "contacts/reference_reduce.h"
#include "support/rig.h"
#include "support/test_scene.h"

namespace ode_ext::test {

inline Random random_numbers() { return Random(*rc::gen::arbitrary<std::uint64_t>()); }

// Closed, with no symmetry left: no two distances or depths are equal by design, and no ray runs
// through an edge.
inline TestMesh random_closed_mesh(Random& random) {
  const TestMesh meshes[] = {make_tetrahedron(1.2),      make_cube(1, 2),  make_icosphere(0.6, 1),
                             make_torus(0.5, 0.2, 9, 6), make_rod(2, 0.2), make_l(1)};
  return jittered(meshes[random.below(6)], 0.02, random.next());
}

inline TestScene random_pair(Random& random) {
  const TestMesh a = random_closed_mesh(random), b = random_closed_mesh(random);
  const TestPose pa = random.pose(0.35);
  return one_pair(a, pa, b, random.pose(0.35));
}

inline std::vector<Contact> collide(const TestScene& scene) {
  static Collider* const collider = new Collider({});  // never destroyed, as Rig::shared()
  return collider->collide(scene.scene, nullptr).contacts;
}

// The candidates of the only pair.
inline std::vector<Candidate> candidates_of(const TestScene& scene) {
  return Rig::shared()
      .run_with_edges(scene.scene, Organization::kPipelined, {8, 64}, true)
      .candidates_of(0);
}

// By how much (in multiples of the smaller mesh's radius) the choice of contacts was clear.
inline double reduction_margin(const TestScene& scene, const std::vector<Candidate>& candidates) {
  return ReferenceReduce(candidates, scene, 0).run(16).margin;
}

}  // namespace ode_ext::test
