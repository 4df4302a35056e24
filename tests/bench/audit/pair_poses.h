// SPDX-License-Identifier: BSD-3-Clause
// Random poses of two meshes, most of them colliding. The i-th depends on the seed, the meshes and
// i alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/mesh_oracle.h"
#include "support/mesh_makers.h"

namespace ode_ext::audit {

enum class Approach { kShallow, kDeep, kContained };
const char* name_of(Approach approach);

struct PosedPair {
  Approach approach;
  test::TestPose a, b;
};

oracle::Pose oracle_pose(const test::TestPose& pose);

// Brought to touch along a random direction: the planes that hold the meshes up to each other
// there overlap by up to 30 % or are up to 5 % apart.
PosedPair shallow_pair(const test::TestMesh& a, const test::TestMesh& b, test::Random& random);

// The origin of a is anywhere in the box of b.
PosedPair deep_pair(const test::TestMesh& a, const test::TestMesh& b, test::Random& random);

// Room for small meshes within a closed one.
class Hollow {
 public:
  // Nothing if `outer` is open.
  static std::optional<Hollow> find(const oracle::Mesh& outer, test::Random& random);

  // As much as `mesh` must be scaled to fit.
  double scale_for(const test::TestMesh& mesh) const;
  // A random pose of a mesh so scaled, in the outer one's frame.
  test::TestPose pose(test::Random& random) const;

 private:
  double room_ = 0;  // [m] the radius of balls about these points that do not touch the surface
  std::vector<test::Point> middles_;
};

}  // namespace ode_ext::audit
