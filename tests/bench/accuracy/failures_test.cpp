// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/failures.h"

#include <gtest/gtest.h>

namespace ode_ext::accuracy {
namespace {

dContactGeom upwards(double depth) {
  dContactGeom contact{};
  contact.depth = depth;
  contact.normal[2] = 1;
  return contact;
}

TEST(Failures, SayWhatIsWrongWithTheDeepestContact) {
  const dContactGeom deep = upwards(0.15), shallow = upwards(0.05);
  EXPECT_EQ(describe(&deep, {0, 0, 1}, 0.1), "50 % too deep, 0 degrees off");
  EXPECT_EQ(describe(&shallow, {1, 0, 0}, 0.1), "50 % too shallow, 90 degrees off");
  EXPECT_EQ(describe(nullptr, {0, 0, 1}, 0.1), "no contact");
}

TEST(Failures, AreCountedBeyondThoseThatAreKeptWithTheirPoses) {
  test::OdeWorld world;
  const test::OdeMesh& cube = world.mesh(test::make_cube(1));
  const test::GeomPair pair{world.geom(cube, test::at(1, 2, 3)), world.geom(cube, {})};
  Failures failures;
  EXPECT_EQ(failures.json().at("count"), 0);
  for (int i = 0; i < 150; ++i) failures.add("wrong", pair);
  const nlohmann::json json = failures.json();
  EXPECT_EQ(json.at("count"), 150);
  ASSERT_EQ(json.at("first").size(), 100u);
  EXPECT_EQ(json.at("first")[0].at("what"), "wrong");
  EXPECT_EQ(json.at("first")[0].at("poses").at("g1").at("position"),
            (nlohmann::json{1.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace ode_ext::accuracy
