// SPDX-License-Identifier: BSD-3-Clause
// The ids of contacts while bodies slide and roll: the same features keep their numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "mesh/mesh.h"
#include "ode/members.h"
#include "support/contact_ids.h"
#include "support/feature_watch.h"

namespace ode_ext::test {
namespace {

constexpr int kFrames = 60;

struct Frame {
  TestPose pose;  // of the body
  Contacts contacts;
  Ids ids;
};

// Open, facing up, with no two triangles in one plane.
TestMesh make_bumps(double size, int n) {
  TestMesh mesh = make_sheet(size, n);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    const double x = mesh.vertices[i], y = mesh.vertices[i + 1];
    mesh.vertices[i + 2] = static_cast<float>(0.12 * std::sin(2.3 * x + 0.4) * std::cos(1.9 * y) +
                                              0.04 * std::sin(7.1 * x + 3.3 * y));
  }
  return mesh;
}

// Rolls along x on z = 0, `deep` in it, by its lowest vertex.
TestPose rolled(const TestMesh& mesh, const TestPose& upright, double radius, double angle,
                double deep) {
  TestPose pose = composed(turned({0, 1, 0}, angle), upright);
  double lowest = 0;
  for (std::size_t v = 0; v < mesh.vertices.size() / 3; ++v)
    lowest = std::min(lowest, rotate(pose, mesh.vertex(v))[2]);
  pose.position = {radius * angle, 0.013, -lowest - deep};
  return pose;
}

class ApiContactIdsOfMotion : public ::testing::Test {
 protected:
  // What a body meets along its way.
  std::vector<Frame> run(const TestMesh& body, const TestMesh& ground,
                         const std::function<TestPose(int)>& pose) {
    const dGeomID moving = world.geom(world.mesh(body), {}),
                  still = world.geom(world.mesh(ground), {});
    std::vector<Frame> frames;
    for (int i = 0; i < kFrames; ++i) {
      set_pose(moving, pose(i));
      frames.push_back({pose(i), answer_of(collider, moving, still), {}});
      frames.back().ids = ids_of(collider, frames.back().contacts);
    }
    return frames;
  }

  static void expect_true(const std::vector<Frame>& frames, PairWatch& watch) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      ASSERT_FALSE(frames[i].contacts.empty()) << "frame " << i;
      ASSERT_EQ(watch.see(frames[i].contacts, frames[i].ids, frames[i].pose, {}), "")
          << "frame " << i;
    }
  }

  OdeWorld world;
  BatchCollider collider;
};

// Of contacts with one id in two frames: where they are.
template <class Visit>
int visit_kept(const Frame& before, const Frame& now, Visit visit) {
  int kept = 0;
  for (std::size_t i = 0; i < before.ids.size(); ++i)
    for (std::size_t k = 0; k < now.ids.size(); ++k)
      if (key(before.ids[i]) == key(now.ids[k])) {
        visit(now.ids[k], pos(before.contacts[i]), pos(now.contacts[k]));
        ++kept;
      }
  return kept;
}

TEST_F(ApiContactIdsOfMotion, OfACubeThatSlidesOverAFlatGroundAreTheSameInEveryFrame) {
  const TestMesh cube = make_cube(1), ground = make_plate(8, 0.5, 16);
  const auto frames = run(cube, ground, [](int i) {
    return turned({0, 0, 1}, 0.3, {-2 + 0.063 * i, -1 + 0.041 * i, 0.25 + 0.5 - 0.01});
  });
  PairWatch watch{FeatureWatch(cube), FeatureWatch(ground)};
  expect_true(frames, watch);
  EXPECT_EQ(watch.first.count(dBatchFeatureVertex), 4u);
  EXPECT_EQ(watch.second.count(dBatchFeatureFacet), 1u);
  std::set<int> triangles;
  for (const Frame& frame : frames) {
    EXPECT_EQ(set_of(frame.ids), set_of(frames[0].ids));
    EXPECT_EQ(frame.ids.size(), 4u);
    for (const dContactGeom& contact : frame.contacts) triangles.insert(contact.side2);
  }
  EXPECT_GT(triangles.size(), 40u) << "it is to slide over many triangles";
}

// A contact with the same id is of the same corner, of the same edge and plane: in the frame of the
// cube it goes on by no more than the cube does, over the sine at which an edge meets a plane.
TEST_F(ApiContactIdsOfMotion, OfACubeThatSlidesOverBumpsAreOfTheSameFeaturesInEveryFrame) {
  const TestMesh cube = make_cube(1), ground = make_bumps(6, 20);
  const Point step{0.05, 0.021, 0.001};
  const auto frames = run(cube, ground, [&](int i) {
    return turned({0.02, 0.03, 1}, 0.4, Point{-1.5, -0.6, 0.48} + double(i) * step);
  });
  PairWatch watch{FeatureWatch(cube), FeatureWatch(ground)};
  expect_true(frames, watch);
  EXPECT_EQ(watch.first.count(dBatchFeatureVertex), 4u);
  EXPECT_GT(watch.first.count(dBatchFeatureEdge), 3u);
  EXPECT_GT(watch.second.count(dBatchFeatureFacet), 20u);
  EXPECT_GT(watch.second.count(dBatchFeatureVertex), 20u);
  int kept = 0, crossings = 0;
  for (std::size_t i = 1; i < frames.size(); ++i)
    kept +=
        visit_kept(frames[i - 1], frames[i], [&](auto id, const Point& before, const Point& now) {
          const double gone =
              distance(to_local(frames[i].pose, now), to_local(frames[i - 1].pose, before));
          if (kind_of(id.feature1) == dBatchFeatureVertex) {
            EXPECT_LT(gone, 1e-6);
          } else if (kind_of(id.feature2) == dBatchFeatureVertex) {
            EXPECT_NEAR(gone, length(step), 1e-6);
          } else if (kind_of(id.feature1) != kind_of(id.feature2)) {
            const auto of_cube = watch.first.direction(id.feature1);
            const auto of_ground = watch.second.direction(id.feature2);
            if (!of_cube || !of_ground) return;
            const double sine = std::fabs(dot(rotate(frames[i].pose, *of_cube), *of_ground));
            EXPECT_LT(gone, length(step) * (1 + 1 / sine) + 1e-4);
            ++crossings;
          }
        });
  EXPECT_GT(kept, 3 * kFrames);
  EXPECT_GT(crossings, 20);
}

void expect_rolling(const std::vector<Frame>& frames) {
  std::set<std::pair<unsigned, unsigned>> all;
  int kept = 0, changed = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    all.merge(set_of(frames[i].ids));
    if (i == 0) continue;
    kept += visit_kept(frames[i - 1], frames[i], [](auto...) {});
    changed += set_of(frames[i].ids) != set_of(frames[i - 1].ids) ? 1 : 0;
  }
  EXPECT_GT(all.size(), 20u) << "other features come down as it rolls";
  EXPECT_GT(changed, 10);
  EXPECT_GT(kept, kFrames) << "and stay for a while";
}

TEST_F(ApiContactIdsOfMotion, OfASphereThatRollsAreOfTheSameCornersWhileTheyTouch) {
  const TestMesh sphere = make_icosphere(0.5, 2),
                 ground = moved(make_plate(8, 0.5, 16), {0, 0, -0.25});
  const TestPose askew = turned({1, 2, 3}, 0.7);
  const auto frames =
      run(sphere, ground, [&](int i) { return rolled(sphere, askew, 0.5, -2 + 0.07 * i, 0.01); });
  PairWatch watch{FeatureWatch(sphere), FeatureWatch(ground)};
  expect_true(frames, watch);
  EXPECT_GT(watch.first.count(dBatchFeatureVertex), 20u);
  expect_rolling(frames);
}

TEST_F(ApiContactIdsOfMotion, OfAPrismThatRollsOverBumpsAreOfTheSameCornersAndEdges) {
  const TestMesh prism = make_cylinder(0.5, 1.5, 12), ground = make_bumps(8, 24);
  const TestPose lying = turned({1, 0, 0}, std::numbers::pi / 2);
  const auto frames =
      run(prism, ground, [&](int i) { return rolled(prism, lying, 0.5, -2 + 0.07 * i, 0.04); });
  PairWatch watch{FeatureWatch(prism), FeatureWatch(ground)};
  expect_true(frames, watch);
  EXPECT_GT(watch.first.count(dBatchFeatureVertex), 5u);
  EXPECT_GT(watch.first.count(dBatchFeatureEdge), 5u);
  EXPECT_GT(watch.second.count(dBatchFeatureEdge), 5u);
  expect_rolling(frames);
}

PairMember member(const TestMesh& mesh, const TestPose& pose) {
  TriangleSoup soup;
  for (const unsigned i : mesh.indices) {
    const Point p = mesh.vertex(i);
    soup.push_back({float(p[0]), float(p[1]), float(p[2])});
  }
  PairMember result;
  result.mesh = std::make_shared<const Mesh>(build_mesh(soup));
  result.pose.position = {pose.position[0], pose.position[1], pose.position[2]};
  result.pose.rotation = pose.rotation;
  return result;
}

// Copies are ordered by where they are: which of them is A changes as one passes the other.
TEST_F(ApiContactIdsOfMotion, OfTwoCopiesThatPassOneAnotherFollowTheGeoms) {
  const TestMesh mesh = make_icosphere(0.5, 1);
  const TestPose still = turned({3, 1, 2}, 1.1);
  const auto pose = [](int i) { return turned({1, 2, 3}, 0.3, {-0.3 + 0.01 * i, 0.7, -0.419}); };
  ASSERT_NE(in_canonical_order(member(mesh, pose(0)), member(mesh, still)),
            in_canonical_order(member(mesh, pose(kFrames - 1)), member(mesh, still)));
  const dGeomID moving = world.geom(world.mesh(mesh), {}),
                other = world.geom(world.mesh(mesh), still);
  PairWatch watch{FeatureWatch(mesh), FeatureWatch(mesh)};
  for (int i = 0; i < kFrames; ++i) {
    set_pose(moving, pose(i));
    const Contacts contacts = answer_of(collider, moving, other);
    ASSERT_FALSE(contacts.empty());
    ASSERT_EQ(watch.see(contacts, ids_of(collider, contacts), pose(i), still), "") << "frame " << i;
  }
  for (const FeatureWatch& of_one : {watch.first, watch.second})
    EXPECT_GT(of_one.count(dBatchFeatureVertex) + of_one.count(dBatchFeatureEdge), 3u);
}

// As they come to rest one on the other, moved and turned by what rounding leaves.
TEST_F(ApiContactIdsOfMotion, OfACopyStackedOnAnotherStayAsItTrembles) {
  const TestMesh mesh = make_cube(1);
  const dGeomID upper = world.geom(world.mesh(mesh), {}), lower = world.geom(world.mesh(mesh), {});
  Random random(7);
  std::vector<Ids> all;
  for (int i = 0; i < kFrames; ++i) {
    const auto noise = [&] { return random.uniform(-1e-9, 1e-9); };
    set_pose(upper, turned({noise(), noise(), 1}, 0.3 + noise(), {noise(), noise(), 0.995}));
    const Contacts contacts = answer_of(collider, upper, lower);
    ASSERT_FALSE(contacts.empty());
    all.push_back(ids_of(collider, contacts));
  }
  for (const Ids& ids : all) EXPECT_EQ(set_of(ids), set_of(all.front()));
}

// ODE takes the box of a mesh when it is built: two corners far out hold all of its shapes.
class ApiContactIdsOfShapes : public ApiContactIdsOfMotion {
 protected:
  ApiContactIdsOfShapes() {
    TestMesh wide = rest;
    for (std::size_t k = 0; k < 3; ++k) wide.vertices[k] = -2, wide.vertices[3 + k] = 2;
    cloth = &world.mesh(wide);
    soft = world.geom(*cloth, {});
    bend(0);
  }
  void bend(double time) {
    auto& vertices = cloth->edit().vertices;
    for (std::size_t i = 0; i < vertices.size(); i += 3) {
      const double x = rest.vertices[i], y = rest.vertices[i + 1];
      vertices[i] = static_cast<float>(x + 0.02 * std::sin(3 * y + time));
      vertices[i + 1] = static_cast<float>(y + 0.02 * std::sin(4 * x + time));
      vertices[i + 2] = static_cast<float>(0.32 + 0.1 * std::sin(4 * x + 3 * y + time));
    }
    dGeomTriMeshDataUpdate(cloth->id());
  }
  Contacts asked(const BatchCollider& by) const {
    dBatchColliderTriMeshDataSetDeformable(by, cloth->id(), 1);
    Contacts contacts(1000);
    const dGeomID pair[] = {soft, hard};
    int count = 0;
    EXPECT_GE(dBatchColliderCollidePairs(by, pair, 1, 1000, contacts.data(), sizeof(dContactGeom),
                                         &count),
              0);
    contacts.resize(static_cast<std::size_t>(count));
    return contacts;
  }

  const TestMesh rest = make_sheet(1.6, 16), cube = make_cube(0.8);
  OdeMesh* cloth = nullptr;
  dGeomID soft = nullptr;
  const dGeomID hard = world.geom(world.mesh(cube), {});
};

TEST_F(ApiContactIdsOfShapes, OfADeformableMeshStayWithItsVerticesWhileTheyMove) {
  PairWatch watch{FeatureWatch(rest, true), FeatureWatch(cube)};
  int kept = 0;
  IdSet before;
  for (int i = 0; i < kFrames; ++i) {
    bend(0.05 * i);
    watch.first.reshape(cloth->mesh());
    const Contacts contacts = asked(collider);
    ASSERT_GT(contacts.size(), 16u);
    const Ids ids = ids_of(collider, contacts);
    ASSERT_EQ(watch.see(contacts, ids, {}, {}), "") << "frame " << i;
    const IdSet now = set_of(ids);
    for (const auto& id : now) kept += before.contains(id) ? 1 : 0;
    before = now;
  }
  EXPECT_GT(watch.first.count(dBatchFeatureVertex), 40u);
  EXPECT_GT(kept, 10 * kFrames);
}

TEST_F(ApiContactIdsOfShapes, OfADeformableMeshDoNotDependOnTheShapeItWasFirstMetIn) {
  asked(collider);
  bend(2);
  const Contacts contacts = asked(collider);
  const Ids ids = ids_of(collider, contacts);
  const BatchCollider fresh;
  const Contacts again = asked(fresh);
  ASSERT_EQ(difference(again, contacts), "");
  ASSERT_GT(contacts.size(), 16u);
  EXPECT_EQ(keys(ids_of(fresh, again)), keys(ids));
}

}  // namespace
}  // namespace ode_ext::test
