// SPDX-License-Identifier: BSD-3-Clause
// Contacts by separating planes: the truth where it is known, the reference where it is not, and
// the same bytes whatever decides how long a step takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "collide/collider.h"
#include "reference/reference_contacts.h"
#include "support/convex_makers.h"
#include "support/points.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

std::vector<Contact> plane_contacts_of(const TestScene& scene) {
  // One for all: building the kernels takes a second. Never destroyed: the driver may be gone.
  static Collider* const collider = new Collider({});
  return collider->collide(scene.scene, nullptr).contacts;
}

// [m] the deepest of those that push up, or aside.
double deepest_along(const std::vector<Contact>& contacts, const Vec3d& direction) {
  double deepest = 0;
  for (const Contact& c : contacts)
    if (dot(c.normal, direction) > 0.99) deepest = std::max(deepest, c.depth);
  return deepest;
}

TEST(SeparatingPlanes, OfACubeOnACubeAreItsFourCorners) {
  const auto contacts = plane_contacts_of(
      one_pair(make_cube(1, 1), at(0.1, 0.2, 0.99), make_cube(1, 1), at(0, 0, 0)));
  ASSERT_EQ(contacts.size(), 4u);
  for (const Contact& c : contacts) {
    EXPECT_NEAR(c.normal.z, 1, 1e-6);
    EXPECT_NEAR(c.depth, 0.01, 1e-5);
  }
}

TEST(SeparatingPlanes, OfBoxesThatOnlyTouchAreOfNoDepth) {
  const auto contacts =
      plane_contacts_of(one_pair(make_cube(1, 1), at(0, 0, 1), make_cube(1, 1), at(0, 0, 0)));
  ASSERT_FALSE(contacts.empty());
  for (const Contact& c : contacts) EXPECT_NEAR(c.depth, 0, 1e-6);
}

// Two plates of one mesh, each 10 mm deep in opposite rims of a block 0.2 m high.
TEST(SeparatingPlanes, LeadEachOfTwoPlatesOutByTheRimThatItIsIn) {
  for (const int cuts : {1, 20}) {
    TestMesh upright;
    for (const double z : {0.19, -0.19})
      upright = merged(upright, moved(make_box({0.2, 0.005, 0.2}, cuts, 1, cuts), {0, 0, z}));
    const auto contacts =
        plane_contacts_of(one_pair(upright, at(0, 0, 0), make_box({0.4, 0.4, 0.2}), at(0, 0, 0)));
    EXPECT_NEAR(deepest_along(contacts, {0, 0, 1}), 0.01, 0.0005) << cuts;
    EXPECT_NEAR(deepest_along(contacts, {0, 0, -1}), 0.01, 0.0005) << cuts;
    for (const Contact& c : contacts) EXPECT_LT(c.depth, 0.0105) << cuts;
  }
}

// One part is wholly inside the block, 40 mm from being out; the other 10 mm deep in its top.
TEST(SeparatingPlanes, LeadOutWhatIsInsideAndWhatIsNot) {
  for (const int cuts : {1, 8}) {
    const TestMesh parts = merged(moved(make_cube(0.03, cuts), {-0.1, 0, 0.075}),
                                  moved(make_cube(0.05, cuts), {0.1, 0, 0.115}));
    const auto contacts =
        plane_contacts_of(one_pair(parts, at(0, 0, 0), make_box({0.4, 0.4, 0.2}), at(0, 0, 0)));
    double inside = 0, on_top = 0;
    for (const Contact& c : contacts) {
      EXPECT_GT(c.normal.z, 0.99) << cuts;
      (c.position.x < 0 ? inside : on_top) = std::max(c.position.x < 0 ? inside : on_top, c.depth);
    }
    EXPECT_NEAR(inside, 0.04, 0.002) << cuts;
    EXPECT_NEAR(on_top, 0.01, 0.0005) << cuts;
  }
}

// Its far side is inside the other, and so are all corners there: through it the other goes on.
TEST(SeparatingPlanes, LeadBodiesOutThatReachThroughOneAnother) {
  for (const double slip : {0.0, 0.03}) {
    const auto contacts = plane_contacts_of(
        one_pair(make_cube(1), at(0.1, slip, slip / 2), make_cube(1), at(0, 0, 0)));
    ASSERT_FALSE(contacts.empty()) << slip;
    EXPECT_NEAR(contacts[0].depth, 0.9, 1e-4) << slip;
    EXPECT_GT(contacts[0].normal.x, 0.999) << slip;
  }
}

// A level plate, 5 mm thick, 10 mm below the top of a block, whose end reaches askew across the rim
// from a corner just inside one side to beyond the next side. Its own lower face would lead the
// block out of it by half the way, and the block would be in it still.
TEST(SeparatingPlanes, LeadAPlateUpThatReachesAskewAcrossARim) {
  for (const int cells : {1, 5})
    for (const TestPose& pose : {turned({0, 0, 1}, 0.219, {0.2265, 0.08538, 0.0925}),
                                 turned({0, 0, 1}, -0.2368, {0.23309, -0.00541, 0.0925})}) {
      const auto contacts =
          plane_contacts_of(one_pair(make_box({0.3, 0.15, 0.005}, 2 * cells, cells), pose,
                                     make_cube(0.2, cells), at(0, 0, 0)));
      ASSERT_FALSE(contacts.empty()) << cells;
      EXPECT_NEAR(contacts[0].depth, 0.01, 1e-5) << cells;
      EXPECT_NEAR(contacts[0].normal.z, 1, 1e-6) << cells;
    }
}

// The upper cube is as wide as the lower one to within rounding. Only edges of the lower one cross,
// and a corner of the upper one seems to be inside by rounding: it is not all of it that is.
TEST(SeparatingPlanes, DoNotTakeABodyForInsideByACornerOnTheSurface) {
  TestPose lower, upper;
  lower.position = {4.4999983879725933, 2.4296669449577407e-05, 0.099976506614070204};
  lower.rotation = {0.99999999990132793,    -1.4041001590236904e-05, -4.4099642433685403e-07,
                    1.4041102491647419e-05, 0.99999997353352221,     0.00022964277104935653,
                    4.3777199815174154e-07, -0.00022964277721877318, 0.99999997363200133};
  upper.position = {4.5000044075096248, 6.3613699027123134e-05, 0.29997375099231982};
  upper.rotation = {0.99999999859948818,     -8.9351425050858347e-06, 5.2164996309191239e-05,
                    8.9266840466617067e-06,  0.99999998681447066,     0.00016214614607344281,
                    -5.2166444420289965e-05, -0.00016214568018591488, 0.99999998549372016};
  const TestMesh cube = make_box({0.2, 0.2, 0.2});
  const auto contacts = plane_contacts_of(one_pair(cube, upper, cube, lower));
  ASSERT_GE(contacts.size(), 3u);
  for (const Contact& c : contacts) {
    EXPECT_GT(c.normal.z, 0.999);
    EXPECT_LT(c.depth, 1e-4);
  }
}

// Through the near side of its part the rod is out by half the way, and in the other part. By as
// much as the rod is wide it is in its own part still.
TEST(SeparatingPlanes, DoNotLeadARodFromOnePartIntoAnother) {
  const TestMesh parts =
      merged(moved(make_box({1, 2, 4}), {0.5, 0, 2}), moved(make_box({1.8, 2, 4}), {2.1, 0, 2}));
  const TestMesh rod = make_box({0.25, 0.2, 10});
  for (const double roll : {0.05, 0.4, 3.0})
    for (const double lean : {-0.01, 0.0, 0.01}) {
      TestPose pose = composed(turned({0, 1, 0}, lean), turned({0, 0, 1}, roll));
      pose.position = {0.7, 0.03, 2};
      const double across = 0.125 * std::fabs(std::cos(roll)) + 0.1 * std::fabs(std::sin(roll));
      const double way = pose.position[0] + across + 2 * std::fabs(std::sin(lean));
      for (const bool is_first : {true, false}) {
        const auto contacts = plane_contacts_of(is_first ? one_pair(rod, pose, parts, at(0, 0, 0))
                                                         : one_pair(parts, at(0, 0, 0), rod, pose));
        ASSERT_FALSE(contacts.empty()) << roll << " " << lean;
        EXPECT_LT((is_first ? 1 : -1) * contacts[0].normal.x, 0.5) << roll << " " << lean;
        EXPECT_NEAR(contacts[0].depth, way, 0.001) << roll << " " << lean;
      }
    }
}

// Of one layer: its own faces have nothing of the block in front of them.
TEST(SeparatingPlanes, LeadACardThatStandsInABlockUp) {
  const TestMesh block = moved(make_box({1, 1, 1}), {0, 0, -0.5});
  for (const TestMesh& card : {make_sheet(0.2, 1), make_sheet(0.2, 6), make_triangle(0.2)})
    for (const double lean : {0.0, 0.3})
      for (const double roll : {0.0, 0.7}) {
        TestPose pose = composed(
            turned({0, 0, 1}, 0.05),
            composed(turned({1, 0, 0}, std::acos(-1.0) / 2 - lean), turned({0, 0, 1}, roll)));
        double lowest = 0;
        for (std::size_t i = 0; i < card.vertices.size() / 3; ++i)
          lowest = std::min(lowest, rotate(pose, card.vertex(i))[2]);
        pose.position = {0.01, 0.02, -0.03 - lowest};
        for (const bool is_first : {true, false}) {
          const auto contacts =
              plane_contacts_of(is_first ? one_pair(card, pose, block, at(0, 0, 0))
                                         : one_pair(block, at(0, 0, 0), card, pose));
          ASSERT_FALSE(contacts.empty());
          EXPECT_NEAR(contacts[0].depth, 0.03, 1e-5);
          EXPECT_NEAR(contacts[0].normal.z, is_first ? 1 : -1, 1e-6);
        }
      }
}

TEST(SeparatingPlanes, AreThereOfBodiesInOnePlace) {
  for (const TestMesh& mesh : {make_cube(1), make_cube(1, 3), make_torus(0.5, 0.2, 24, 12),
                               make_icosphere(0.5, 2), make_l(1), make_cone(0.5, 1, 16)}) {
    Random random(7);
    for (int i = 0; i < 20; ++i) {
      const TestPose pose = random.pose(i % 2 == 0 ? 0.0 : 1.0);
      EXPECT_FALSE(plane_contacts_of(one_pair(mesh, pose, mesh, pose)).empty()) << i;
    }
  }
}

TEST(SeparatingPlanes, AreAsDeepAsThoseOfTheReference) {
  const std::vector<TestMesh> shapes = {make_cube(1, 1), make_cube(0.8, 3), make_icosphere(0.6, 1),
                                        make_tetrahedron(1), make_rod(2, 0.3)};
  Random random(17);
  int compared = 0, other = 0;
  for (int i = 0; i < 200; ++i) {
    const TestMesh& a = shapes[static_cast<std::size_t>(i) % shapes.size()];
    const TestMesh& b = shapes[static_cast<std::size_t>(i / 5) % shapes.size()];
    const TestPose pa = random.pose(0.45), pb = random.pose(0.45);
    const ReferenceContacts expected = reference_contacts(ContactMesh(a), pa, ContactMesh(b), pb);
    const auto contacts = plane_contacts_of(one_pair(a, pa, b, pb));
    EXPECT_EQ(contacts.empty(), expected.contacts.empty()) << i;
    if (contacts.empty() || expected.contacts.empty()) continue;
    ++compared;
    const double deepest = expected.contacts.front().depth;
    // The device proposes fewer planes: what is nearest to a vertex it seldom looks for.
    if (std::fabs(contacts.front().depth - deepest) > 0.02 * deepest + 1e-4) ++other;
  }
  EXPECT_GT(compared, 60);
  EXPECT_LE(10 * other, compared) << other << " of " << compared;
}

auto bits_with(const Scene& scene, const ColliderOptions& options) {
  Collider collider(options);
  return bits_of(collider.collide(scene, nullptr));
}

// One test for each size and width: kernels are compiled anew. In lanes and without builtins:
// SearchInLanes (search_test.cpp). Whole steps are in groups of one.
class SeparatingPlanesBySize : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(SeparatingPlanesBySize, AreTheSameBytes) {
  const TestScene scene = random_scene(200, 61);
  const auto expected = bits_with(scene.scene, {});
  for (const bool whole_steps : {true, false}) {
    ColliderOptions options;
    options.whole_steps = whole_steps;
    options.work_group_size = GetParam();
    EXPECT_EQ(bits_with(scene.scene, options), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(WorkGroups, SeparatingPlanesBySize, ::testing::Values(1u, 32u, 256u));

class SeparatingPlanesByWidth : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(SeparatingPlanesByWidth, AreTheSameBytes) {
  TestScene scene = random_scene(200, 61);
  // A tree of several levels.
  const std::uint32_t fine = scene.add_mesh(make_icosphere(0.6, 4));
  scene.add_pair(fine, at(30, 0, 0), fine, turned({1, 2, 3}, 0.4, {30.9, 0.1, 0.2}));
  ColliderOptions options;
  options.vector_width = GetParam();
  EXPECT_EQ(bits_with(scene.scene, options), bits_with(scene.scene, {}));
}

INSTANTIATE_TEST_SUITE_P(Vectors, SeparatingPlanesByWidth, ::testing::Values(1u, 4u, 8u, 16u));

TEST(SeparatingPlanes, AreTheSameBytesWhateverTheLaunchAndTheCompany) {
  const TestScene scene = random_scene(200, 61);
  const auto expected = bits_with(scene.scene, {});
  EXPECT_GT(std::count_if(expected.begin(), expected.end(),
                          [](const auto& pair) { return !pair.empty(); }),
            50);
  ColliderOptions exact;
  exact.launches = LaunchRule::kExact;
  EXPECT_EQ(bits_with(scene.scene, exact), expected);
  Collider alone({});
  for (std::size_t i = 0; i < scene.pairs.size(); i += 7) {
    Scene pair = scene.scene;
    pair.pairs = {scene.scene.pairs[i]};
    EXPECT_EQ(bits_of(alone.collide(pair, nullptr)).front(), expected[i]) << i;
  }
}

}  // namespace
}  // namespace ode_ext::test
