// SPDX-License-Identifier: BSD-3-Clause
// Pairs of meshes at a known depth, to time colliders by.
#pragma once

#include <string>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::bench {

using test::TestMesh;
using test::TestPose;

struct PosedPair {
  TestPose a, b;
};

// Two meshes in many poses relative to one another.
struct PairCase {
  std::string name;
  TestMesh a, b;
  std::vector<PosedPair> pairs;
};

// How far one mesh is moved towards the other from where they first touch, as a part of the smaller
// one's size: negative is apart. `spread`: each pair differs by up to so much either way.
struct Depth {
  std::string name;
  double depth, spread;
};

// `count` pairs in random orientations and directions, the same for every depth.
PairCase make_case(const std::string& name, const TestMesh& a, const TestMesh& b,
                   const Depth& depth, int count, std::uint64_t seed);

// The same, but A, turned anyhow, comes down on B: against B's +z, and not near its rim.
PairCase make_case_from_above(const std::string& name, const TestMesh& a, const TestMesh& b,
                              const Depth& depth, int count, std::uint64_t seed);

// A closed, bumpy ball, 1 m wide, of about so many triangles.
TestMesh make_rock(int triangles);

// An open mesh of about so many triangles: hills, 1 m wide, of which the top is +z.
TestMesh make_hills(int triangles);

// The same of 4 m, and less steep.
TestMesh make_ground(int triangles);

}  // namespace ode_ext::bench
