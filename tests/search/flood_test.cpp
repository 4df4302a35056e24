// SPDX-License-Identifier: BSD-3-Clause
// Which vertices are inside follows from where edges cross. Inside closed meshes they are those
// that solid angles say; behind open ones those that rays of all vertices find, for a fraction of
// the rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include "collide/collider.h"
#include "search/inside_oracle.h"
#include "support/moving_scene.h"
#include "support/segment_crosses.h"

namespace ode_ext::test {
namespace {

ColliderOptions flooded() {
  ColliderOptions options;
  options.whole_steps = false;  // the kernel by itself
  return options;
}

std::uint64_t hits(const Collider& collider) {
  return collider.report().actual[static_cast<std::size_t>(List::kHits)];
}

// Whether it is below a ground that has one height everywhere.
bool lies_below(const Mesh& ground, const Point& p) {
  const Segment up{Vec3d{p[0], p[1], p[2]}, Vec3d{p[0], p[1], p[2] + 100}};
  const auto corner = [&](std::uint32_t vertex) {
    const Vec3f& v = ground.vertices[vertex];
    return Vec3d{v.x, v.y, v.z};
  };
  const auto& triangles = ground.topology->triangles;
  return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return crosses(up, {corner(t[0]), corner(t[1]), corner(t[2])});
  });
}

class Flood : public testing::Test {
 protected:
  void find(const Scene& scene) {
    Rig& rig = Rig::shared();
    const StepRecords all = rig.run(scene);
    records_ = rig.run_with_edges(scene, Organization::kPipelined, {8, 64}, true);
    for (const std::string& difference : oracles_.differences(scene, records_))
      ADD_FAILURE() << difference;
    EXPECT_EQ(behind_open(scene, records_, true), behind_open(scene, all, true));
    const auto found = behind_open(scene, records_, false), of_all = behind_open(scene, all, false);
    EXPECT_TRUE(std::includes(of_all.begin(), of_all.end(), found.begin(), found.end()));
    rays_ += records_.rays.size();
    rays_of_all_ += all.rays.size();
    hits_ += records_.hits.size();
    chunks_ += records_.tasks.size();
  }

  // Of vertices that are not near the surface: their ray's triangle and depth too. near_half: whose
  // rays get no farther than half through their own mesh; beyond, what is behind an open target
  // depends on its border (lib/border.h, ApiOpenTarget). Those whose rays do not get to the surface
  // are not listed: crossings tell that they are behind it, and they are below the ground.
  std::set<std::tuple<ox_u32, ox_u32, ox_u32, ox_f32>> behind_open(const Scene& scene,
                                                                   const StepRecords& records,
                                                                   bool near_half) {
    std::set<std::tuple<ox_u32, ox_u32, ox_u32, ox_f32>> found;
    for (const ox_hit& h : records.hits) {
      const auto& target =
          oracles_.of(scene.meshes[InsideOracles::mesh_of(scene, h.pair_side ^ 1)]);
      if (target.closed()) continue;
      const std::uint32_t source = InsideOracles::mesh_of(scene, h.pair_side);
      const Vec3f vertex =
          scene.meshes[source]->vertices[Rig::shared().local_vertex(source, h.vertex)];
      const Mesh& mesh = *scene.meshes[source];
      if (near_half && mesh.closed() &&
          h.t > 0.5f * mesh.exits[Rig::shared().local_vertex(source, h.vertex)])
        continue;
      const double doubt = kDoubt * static_cast<double>(records.pairs[h.pair_side >> 1].epsilon);
      const Point p = InsideOracles::in_target(scene, h.pair_side, vertex);
      if (target.is_near(p, doubt)) continue;
      if (std::isinf(h.t) && h.triangle != OX_NONE) {
        EXPECT_TRUE(lies_below(*scene.meshes[InsideOracles::mesh_of(scene, h.pair_side ^ 1)], p));
        ++below_;
        continue;
      }
      found.emplace(h.pair_side, h.vertex, h.triangle, h.depth);
    }
    return found;
  }

  InsideOracles oracles_;
  StepRecords records_;  // of the last scene
  Collider flood_{flooded()};
  std::uint64_t rays_ = 0, rays_of_all_ = 0, hits_ = 0, chunks_ = 0, below_ = 0;
};

TEST_F(Flood, FindsTheVerticesInsideOfSmoothMeshes) {
  MovingScene moving(smooth_meshes(), 40, 0.01, 1);
  for (int i = 0; i < 4; ++i, moving.advance()) find(moving.scene());
  EXPECT_GT(hits_, 4000u);
  EXPECT_EQ(rays_, hits_) << "each of a vertex inside";
  EXPECT_LT(100 * oracles_.near, hits_);
}

TEST_F(Flood, FindsTheVerticesInsideOfMeshesOfAllKinds) {
  MovingScene moving(small_closed_meshes(), 200, 0.02, 2);
  for (int i = 0; i < 10; ++i, moving.advance()) find(moving.scene());
  EXPECT_GT(hits_, 3000u);
}

// Facets of many triangles: the flood runs over edges that lie within them.
TEST_F(Flood, RunsAcrossFlatFaces) {
  const std::vector<TestMesh> meshes = {make_cube(1, 8), make_plate(1.5, 0.2, 9),
                                        make_box({0.5, 0.7, 1.2}, 3, 7, 11)};
  MovingScene moving(meshes, 60, 0.02, 3);
  for (int i = 0; i < 10; ++i, moving.advance()) find(moving.scene());
  EXPECT_GT(hits_, 3000u);
}

// A table with two legs in a block: each leg is a flood of its own, and all of it names one of its
// vertices, which has a hit itself.
TEST_F(Flood, NamesOneVertexOfAllThatHangsTogether) {
  const TestMesh table = merged(make_icosphere(0.3, 2), moved(make_icosphere(0.3, 2), {1, 0, 0}));
  const TestScene scene = one_pair(table, at(0, 0, 0.6), make_box({4, 4, 1}), at(0.5, 0, 0));
  find(scene.scene);
  std::map<ox_u32, std::set<ox_u32>> named;
  for (const ox_hit& h : records_.hits)
    if ((h.pair_side & 1) == 0) named[h.from].insert(h.vertex);
  ASSERT_EQ(named.size(), 2u);
  for (const auto& [from, vertices] : named) {
    EXPECT_TRUE(vertices.contains(from));
    EXPECT_GT(vertices.size(), 20u);
  }
}

TEST_F(Flood, FindsMeshesThatAreWhollyInside) {
  for (const Point& place : {Point{0, 0, 0}, Point{0.2, 0.1, -0.3}, Point{3, 0, 0}}) {
    const TestScene scene = one_pair(make_icosphere(1, 3), at(0, 0, 0), make_icosphere(0.3, 2),
                                     turned({1, 2, 3}, 0.4, place));
    hits_ = 0;
    find(scene.scene);
    EXPECT_EQ(hits_, place[0] < 1 ? 162u : 0u);
  }
}

// One part outside, one across the surface, one inside: the first two tell nothing of the third.
TEST_F(Flood, FindsPartsOfAMeshThatAreWhollyInside) {
  const TestMesh ball = make_icosphere(0.2, 2);
  const TestMesh parts =
      merged(merged(moved(ball, {2, 0, 0}), moved(ball, {1, 0, 0})), moved(ball, {0.3, 0.2, 0}));
  const TestScene scene = one_pair(make_icosphere(1, 3), at(0, 0, 0), parts, at(0, 0, 0));
  find(scene.scene);
  EXPECT_GT(hits_, 162u + 50u);
  EXPECT_LT(hits_, 2 * 162u);
}

// Its faces are pierced, its edges are not: all of its vertices are inside.
TEST_F(Flood, FindsAMeshWhoseFacesAloneCross) {
  // A ball with a spike inward that pierces a large face of the box inside.
  TestMesh ball = make_icosphere(2, 4);
  std::size_t top = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(ball.vertex_count()); ++i)
    if (ball.vertex(i)[2] > ball.vertex(top)[2]) top = i;
  ball.vertices[3 * top + 2] = 0.4f;
  const TestScene scene =
      one_pair(ball, at(0, 0, 0), make_cube(1), turned({0, 0, 1}, 0.3, {0.07, 0.03, 0}));
  find(scene.scene);
  EXPECT_GE(hits_, 8u);
}

TEST_F(Flood, FindsTheVerticesInsideOfSolidsThatCutThemselves) {
  const TestMesh crossed = merged(make_cube(1, 3), moved(make_cube(1, 3), {0.5, 0.2, 0.1}));
  for (int i = 0; i < 6; ++i) {
    const TestScene scene =
        one_pair(crossed, at(0, 0, 0), make_icosphere(0.6, 3), at(0.2 * i, 0.7, 0.1));
    find(scene.scene);
  }
  EXPECT_GT(hits_, 300u);
}

// In one part, and all about it the walls of the other: what a ray meets first is a front face.
TEST_F(Flood, FindsWhatIsWhollyInsideOfSolidsThatCutThemselves) {
  const TestMesh crossed = merged(make_cube(1), moved(make_cube(1), {0.5, 0.2, 0.1}));
  for (const Point& place : {Point{-0.2, -0.1, -0.2}, Point{0.7, 0.3, 0.3}, Point{0.25, 0.1, 0}}) {
    const TestScene scene =
        one_pair(crossed, at(0, 0, 0), make_icosphere(0.05, 2), at(place[0], place[1], place[2]));
    find(scene.scene);
    EXPECT_FALSE(records_.contacts.empty());
  }
}

// Its ends lie in one part each, and cross the walls of the other alone.
TEST_F(Flood, FindsBothEndsOfWhatLiesAcrossAWallInside) {
  const TestMesh crossed = merged(make_cube(1), moved(make_cube(1), {0.5, 0.2, 0.1}));
  TestMesh bar = make_box({0.8, 0.1, 0.1}, 8, 2, 2);
  const TestScene scene =
      one_pair(crossed, at(0, 0, 0), bar, turned({0, 0, 1}, 0.1, {0.2, 0.05, 0.02}));
  find(scene.scene);
  // All of its vertices are inside, and those on its edges have a ray.
  const auto bounds = bounding_vertices(*scene.scene.meshes[1], *scene.scene.meshes[0]);
  EXPECT_EQ(rays_, static_cast<std::uint64_t>(std::count(bounds.begin(), bounds.end(), true)));
}

// The bar of above with a ball of its own far off: what is outside by one crossing, and so far by
// no other, is asked all the same.
TEST_F(Flood, FindsBothEndsOfOneOfSeveralPartsThatLiesAcrossAWallInside) {
  const TestMesh crossed = merged(make_cube(1), moved(make_cube(1), {0.5, 0.2, 0.1}));
  const TestMesh bar =
      merged(make_box({0.8, 0.1, 0.1}, 8, 2, 2), moved(make_icosphere(0.05, 2), {5, 0, 0}));
  find(one_pair(crossed, at(0, 0, 0), bar, turned({0, 0, 1}, 0.1, {0.2, 0.05, 0.02})).scene);
  EXPECT_GT(hits_, 40u);
}

TEST_F(Flood, FindsTheVerticesInsideWhereBothMeshesHaveManyParts) {
  TestMesh boxes, balls, rods;
  Random random(75);
  for (int i = 0; i < 6; ++i) {
    const Point place{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4),
                      random.uniform(-0.4, 0.4)};
    boxes = merged(boxes, moved(make_box({0.6, 0.4, 0.3}, 2, 2, 1), place));
    balls = merged(balls, moved(jittered(make_icosphere(0.25, 1), 0.01, i), place));
    rods = merged(rods, moved(make_rod(1.2, 0.06), place));
  }
  MovingScene moving({boxes, balls, rods}, 80, 0.02, 8);
  for (int i = 0; i < 10; ++i, moving.advance()) find(moving.scene());
  EXPECT_GT(hits_, 3000u);
}

// A crate in the floor, its upper corners outside, and all but on the wall.
TEST_F(Flood, FindsNothingInsideBesideTheWallOfAnotherPart) {
  const TestMesh room = merged(moved(make_box({100, 100, 1}), {0, 0, -0.5}),
                               moved(make_box({1, 100, 21}), {10.5, 0, 9.5}));
  for (const bool swaps : {false, true})
    for (int i = 0; i < 24; ++i) {
      const double gap = 1e-5 * std::pow(1.25, i);
      const TestMesh crate = make_cube(1);
      const TestPose pose = at(9.5 - gap, 0.1, 0.49);
      find(swaps ? one_pair(crate, pose, room, TestPose{}).scene
                 : one_pair(room, TestPose{}, crate, pose).scene);
    }
  EXPECT_GT(hits_, 100u);
  EXPECT_GT(oracles_.near, 20u) << "too near the wall to tell";
}

// Each of its edges that crosses goes out of the one box where it goes into the other.
TEST_F(Flood, FindsWhatLiesAcrossWhereTwoPartsAbut) {
  const TestMesh stack =
      merged(moved(make_box({2, 2, 1}), {0, 0, -0.5}), moved(make_box({1, 1, 1}), {0, 0, 0.5}));
  for (const TestMesh& ball :
       {make_icosphere(0.2, 2),
        merged(make_icosphere(0.2, 2), moved(make_icosphere(0.1, 1), {0, 0, 3}))})
    find(one_pair(stack, TestPose{}, ball, at(0.03, 0.02, 0.01)).scene);
  EXPECT_GT(hits_, 2 * 150u);
}

// In the second of four layers: whatever way a ray goes it leaves that where it enters the next.
TEST_F(Flood, FindsWhatIsWhollyInsideWhereManyPartsAbut) {
  TestMesh stack;
  for (int i = 0; i < 4; ++i)
    stack = merged(stack, moved(make_box({6.0 - i, 6.0 - i, 1}), {0, 0, 0.5 + i}));
  find(one_pair(stack, TestPose{}, make_cube(0.5), at(0, 0, 1.5)).scene);
  EXPECT_EQ(hits_, 8u);
  EXPECT_FALSE(records_.contacts.empty());
}

// Buried with one corner just below the ground, the one that is asked first.
TEST_F(Flood, FindsACrateWhoseFirstCornerIsJustBelowTheSurface) {
  const TestMesh ground = moved(make_box({1000, 1000, 10}), {0, 0, -5});
  TestMesh crate = make_cube(1);
  const auto first = build_mesh(soup_of(crate)).vertices[0];
  // The corner up.
  const double tilt = std::acos(first.z / std::sqrt(0.75));
  const TestPose up = turned({first.y, -first.x, 0}, tilt, {0, 0, 0});
  const double height = rotate(up, {first.x, first.y, first.z})[2];
  ASSERT_GT(height, 0.86);
  for (int i = 0; i < 20; ++i) {
    TestPose pose = up;
    pose.position = {0.3, 0.2, -height - 1e-4 * std::pow(1.25, i)};
    find(one_pair(crate, pose, ground, TestPose{}).scene);
    EXPECT_GE(records_.hits.size(), 7u) << i;
  }
}

// Pairs round to more where both meshes reach from their own origins far out, or one is much larger
// and made of large triangles; not where one reaches far out, or only lies there.
TEST_F(Flood, FindsTheVerticesInsideWhereRoundingIsCoarse) {
  enum Reach { kNeither, kOne, kBoth };
  const struct {
    double offset;
    Reach reach;
  } cases[] = {{0, kNeither}, {1e2, kNeither}, {1e4, kNeither}, {1e2, kOne},
               {1e4, kOne},   {1e2, kBoth},    {1e4, kBoth}};
  for (const auto& [offset, reach] : cases) {
    const double scale = offset == 0 ? 1000 : 1;
    const Point far{offset, 0, 0};
    TestScene scene;
    for (const TestMesh& mesh : {jittered(make_icosphere(0.6, 2), 0.01, 1),
                                 jittered(make_torus(0.5, 0.2, 16, 10), 0.01, 2), make_l(1)})
      scene.add_mesh(reach == kNeither ? moved(mesh, far) : far_out(mesh, far));
    // What makes the cube as large is where nothing meets it.
    const TestMesh cube = scaled(make_cube(1, 4), scale);
    scene.add_mesh(reach == kBoth ? merged(cube, moved(make_tetrahedron(0.1), {0, offset, 0}))
                                  : cube);
    Random random(74);
    for (int i = 0; i < 150; ++i) {
      TestPose a = random.pose(0.4);
      if (scale != 1) a.position[2] += 0.5 * scale;
      a.position = a.position - rotate(a, far);
      scene.add_pair(static_cast<std::uint32_t>(random.below(3)), a, 3, TestPose{});
    }
    hits_ = 0;
    find(scene.scene);
    EXPECT_GT(hits_, 100u) << offset;
    const double epsilon = double{records_.pairs[0].epsilon};
    if (reach == kBoth) {
      EXPECT_GT(epsilon, 0x1p-20 * offset);
    } else if (offset != 0) {
      EXPECT_LT(epsilon, 0x1p-20 * 10);
    }
  }
}

// Hills of large triangles, the top of a closed slab or a sheet alone.
TestMesh hills(bool closed) {
  TestMesh mesh = closed ? make_box({8, 8, 1}, 16, 16, 1) : make_sheet(8, 16);
  const float top = closed ? 0.5f : 0;
  for (std::size_t i = 0; i + 2 < mesh.vertices.size(); i += 3)
    if (mesh.vertices[i + 2] == top)
      mesh.vertices[i + 2] +=
          0.2f * std::sin(1.5f * mesh.vertices[i]) * std::cos(mesh.vertices[i + 1]);
  return mesh;
}

TEST_F(Flood, FindsTheVerticesBehindOpenMeshes) {
  const TestMesh bodies[] = {jittered(make_icosphere(0.4, 3), 0.002, 1),
                             jittered(make_torus(0.4, 0.12, 24, 12), 0.002, 2),
                             make_plate(0.7, 0.02, 8), make_cube(0.5)};
  Random random(71);
  for (int i = 0; i < 120; ++i) {
    TestPose body = random.pose(0.5);
    body.position = {random.uniform(-3.5, 3.5), random.uniform(-3.5, 3.5),
                     random.uniform(-0.4, 0.7)};
    const TestScene scene = one_pair(bodies[i % 4], body, hills(false), TestPose{});
    find(scene.scene);
  }
  EXPECT_GT(hits_, 1000u);
  EXPECT_GT(below_, 50u);
  EXPECT_LT(rays_, rays_of_all_ / 2);
}

// There, over edges that do not cross, what is behind the surface leads to what is before it.
TEST_F(Flood, LeavesVerticesToTheVertexStepWhereItGetsRoundABorder) {
  const TestMesh ball = jittered(make_icosphere(0.4, 3), 0.002, 1);
  for (int i = 0; i < 8; ++i) {
    const TestScene scene = one_pair(ball, at(4, -3 + 0.8 * i, 0.05), hills(false), TestPose{});
    find(scene.scene);
  }
  EXPECT_GT(hits_, 500u);
  EXPECT_GT(chunks_, 100u);
}

// Vertices on either side of what pierces the face between them: rays of all would find some behind
// it, though nothing parts them from the rest.
TEST_F(Flood, LeavesToItsOwnVerticesWhatPiercesAFace) {
  const TestScene scene =
      one_pair(make_cube(1), at(0, 0, 0), make_triangle(0.2), turned({1, 0, 0}, 1.6, {0, 0, 0.45}));
  const PairContacts& found = flood_.collide(scene.scene, nullptr);
  EXPECT_EQ(hits(flood_), 2u);
  ASSERT_GE(found.contacts.size(), 1u);
  for (const Contact& contact : found.contacts) EXPECT_LT(std::fabs(contact.depth), 0.2);
}

// All of its lower vertices lie on the ground to within rounding.
TEST_F(Flood, FindsWhatIsBehindOpenGroundFromVerticesThatLieOnIt) {
  for (const double z : {0.0, 1e-8}) {
    TestMesh body = make_box({0.5, 0.5, 0.5}, 4, 4, 4);
    const TestScene scene = one_pair(body, at(0.03, 0.02, z), make_sheet(4, 3), TestPose{});
    find(scene.scene);
  }
  EXPECT_GT(hits_, 20u);
}

// Half a ball without its lid, whose wall faces inwards: behind it is all of the floor about
// it, of which nothing farther than it reaches can be in contact with it.
TEST_F(Flood, GoesNoFartherOverAnOpenFloorThanAnOpenBodyReaches) {
  TestMesh bowl = inverted(make_icosphere(0.4, 3));
  std::vector<unsigned> lower;
  for (std::size_t t = 0; t < static_cast<std::size_t>(bowl.triangle_count()); ++t)
    if (bowl.corner(t, 0)[2] + bowl.corner(t, 1)[2] + bowl.corner(t, 2)[2] < 0)
      lower.insert(lower.end(),
                   {bowl.indices[3 * t], bowl.indices[3 * t + 1], bowl.indices[3 * t + 2]});
  bowl.indices = lower;
  const auto words = [&](double size, int n) {
    const TestScene scene = one_pair(bowl, at(0.003, 0.002, 0.35), make_sheet(size, n), TestPose{});
    flood_.collide(scene.scene, nullptr);
    EXPECT_GT(flood_.report().actual[OX_LIST_CROSSINGS], 20u);
    return flood_.report().actual[OX_LIST_FLOOD_WORDS];
  };
  EXPECT_LT(words(20, 200), 2 * words(2, 20));
}

// In a valley, within the box of the hills and 12 cm above them.
TEST_F(Flood, CastsNoRayFromABodyJustAboveHills) {
  for (const bool closed : {true, false}) {
    const TestScene scene =
        one_pair(jittered(make_icosphere(0.1, 3), 0.001, 1),
                 at(-std::numbers::pi / 3, 0, (closed ? 0.5 : 0) - 0.2 + 0.12 + 0.1), hills(closed),
                 TestPose{});
    find(scene.scene);
    EXPECT_EQ(records_.bounded, 1u);
    EXPECT_EQ(rays_, 0u);
    EXPECT_GT(rays_of_all_, 0u);
    // Of the 1,280 triangles of the body, none reaches down as far as the hills below it do up.
    EXPECT_LT(records_.meshlet_tasks.size(), 200u);
    EXPECT_LT(records_.meshlet_pairs.size(), 200u);
    EXPECT_TRUE(records_.crossings.empty());
  }
}

TEST_F(Flood, GrowsWhatItNeedsRoomFor) {
  ColliderOptions tight = flooded();
  tight.initial_capacity = 1;
  Collider collider(tight);
  const TestScene scene = one_pair(make_icosphere(1, 5), at(0, 0, 0), make_icosphere(1, 5),
                                   turned({1, 2, 3}, 0.4, {0.1, 0.2, 0.3}));
  const auto expected = bits_of(flood_.collide(scene.scene, nullptr));
  EXPECT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected);
  EXPECT_GT(collider.report().redone, 0);
  // More than its first table held.
  EXPECT_GT(hits(collider), 4000u);
}

// Of a ball that all but fills a box its cap is out: few edges cross, and nearly all vertices are
// inside, so that the table grows with the edges in it.
TEST_F(Flood, KeepsCrossedEdgesWhereItsTableGrows) {
  find(one_pair(make_icosphere(1, 5), at(0.01, 0.02, 0.15), make_cube(2.2), TestPose{}).scene);
  EXPECT_GT(hits_, 9000u);
  EXPECT_LT(records_.crossings.size(), 400u);
}

// There the chunks of a source that is looked at in whole need room too.
TEST_F(Flood, GrowsWhatItNeedsRoomForAtABorder) {
  ColliderOptions tight = flooded();
  tight.initial_capacity = 1;
  Collider collider(tight);
  const TestScene scene =
      one_pair(make_icosphere(0.4, 4), at(4, 0.2, 0.05), hills(false), TestPose{});
  const auto expected = bits_of(flood_.collide(scene.scene, nullptr));
  EXPECT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected);
  EXPECT_GT(collider.report().redone, 0);
  EXPECT_GT(collider.report().actual[static_cast<std::size_t>(List::kChunks)], 20u);
}

TEST_F(Flood, FindsTheVerticesInsideOfADeformableMesh) {
  Scene scene;
  scene.meshes = {std::make_shared<const Mesh>(
                      build_mesh(soup_of(make_icosphere(0.6, 2)), {.deformable = true})),
                  std::make_shared<const Mesh>(build_mesh(soup_of(make_cube(1, 4))))};
  scene.objects = {{Pose{}, 0, 1}, {Pose{{0.1, 0.2, 0.8}}, 1, 2}};
  scene.pairs = {{0, 1}};
  find(scene);
  EXPECT_GT(hits_, 5u);
}

TEST_F(Flood, IsTheSameInGroupsOfAnySize) {
  MovingScene moving(smooth_meshes(), 30, 0.01, 5);
  const auto expected = bits_of(flood_.collide(moving.scene(), nullptr));
  for (const std::uint32_t size : {1u, 32u, 256u}) {
    ColliderOptions options = flooded();
    options.work_group_size = size;
    Collider collider(options);
    EXPECT_EQ(bits_of(collider.collide(moving.scene(), nullptr)), expected) << size;
  }
}

}  // namespace
}  // namespace ode_ext::test
