// SPDX-License-Identifier: BSD-3-Clause
// The meter looks at few pairs and few vertices, and misses none.
#include "judging/penetration.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "meshes/random.h"
#include "meshes/shapes.h"
#include "simulation/pose.h"

namespace falling_objects {
namespace {

using ode_ext::oracle::Mesh;
using ode_ext::oracle::Pose;

double deepest_vertex(const Mesh& source, const Pose& pose, const Mesh& target,
                      const Pose& target_pose) {
  double deepest = 0;
  for (const auto& vertex : source.vertices()) {
    const auto p = target_pose.to_local(pose.to_world(vertex));
    deepest = std::max(deepest, -target.signed_distance(p));
  }
  return deepest;
}

struct BruteForce {
  double deepest = 0;
  std::size_t pairs = 0;  // of which one has a vertex inside the other
  void look(const Mesh& a, const Pose& pose_a, const Mesh& b, const Pose& pose_b) {
    const double depth =
        std::max(deepest_vertex(a, pose_a, b, pose_b), deepest_vertex(b, pose_b, a, pose_a));
    deepest = std::max(deepest, depth);
    pairs += depth > 0;
  }
};

class Meter : public testing::Test {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }
};

TEST_F(Meter, FindsWhatBruteForceFindsInAHeapOnTheGround) {
  SimulationSettings options;
  options.objects = 24;
  std::vector<std::string> warnings;
  const Scene scene({{"jack", make_jack()}, {"gear", make_gear()}}, options, warnings);
  Random random(5);
  for (const Object& object : scene.objects()) {
    dBodySetPosition(object.body, random.between(-1, 1), random.between(-1, 1),
                     random.between(0, 1));
  }
  const PenetrationMeter meter(scene);
  const auto mesh_of = [](const TriangleMesh& mesh) { return Mesh(mesh.vertices, mesh.indices); };
  const Mesh ground = mesh_of(scene.ground().mesh());
  std::vector<Mesh> shapes;
  for (const Shape& shape : scene.shapes()) shapes.push_back(mesh_of(shape.mesh));
  BruteForce expected;
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    const Object& object = scene.objects()[i];
    expected.look(shapes[object.shape], pose_of(object.body), ground, {});
    for (std::size_t j = 0; j < i; ++j) {
      const Object& other = scene.objects()[j];
      expected.look(shapes[object.shape], pose_of(object.body), shapes[other.shape],
                    pose_of(other.body));
    }
  }
  EXPECT_GT(expected.pairs, 30U);
  EXPECT_EQ(meter.all_depths().size(), expected.pairs);
  EXPECT_NEAR(meter.measure().deepest, expected.deepest, 1e-12);
}

}  // namespace
}  // namespace falling_objects
