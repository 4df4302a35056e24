// SPDX-License-Identifier: BSD-3-Clause
// What a program's dTriTriMergeCallback and dTriCallback have to say of contacts.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <numbers>
#include <set>
#include <stdexcept>
#include <thread>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

using ::testing::HasSubstr;

struct MergeCall {
  dGeomID geom;
  int first, second, answer;
};
std::vector<MergeCall> merge_calls;

// An index that no triangle has, and that tells which call gave it.
int record_merge(dGeomID geom, int first, int second) {
  merge_calls.push_back({geom, first, second, 1000 + static_cast<int>(merge_calls.size())});
  return merge_calls.back().answer;
}
int merge_into_nonsense(dGeomID, int, int) { return -2147483647; }
int throw_in_merge(dGeomID, int, int) { throw std::runtime_error("no such triangle"); }

struct TriCall {
  dGeomID geom, other;
  int triangle;
};
std::vector<TriCall> tri_calls;
std::set<int> refused;

int refuse_some(dGeomID geom, dGeomID other, int triangle) {
  tri_calls.push_back({geom, other, triangle});
  return refused.contains(triangle) ? 0 : 1;
}
int refuse_all(dGeomID, dGeomID, int) { return 0; }
int throw_in_tri(dGeomID, dGeomID, int) { throw 7; }
int array_calls = 0;
void count_array(dGeomID, dGeomID, const int*, int) { ++array_calls; }

// The triangles with all of the corners that lie, in the frame of the mesh, at the given points.
std::vector<int> triangles_at(const TestMesh& mesh, const std::vector<Point>& points) {
  std::vector<int> triangles;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const auto has = [&](const Point& p) {
      for (std::size_t k = 0; k < 3; ++k)
        if (distance(mesh.corner(static_cast<std::size_t>(t), k), p) < 1e-6) return true;
      return false;
    };
    if (std::all_of(points.begin(), points.end(), has)) triangles.push_back(t);
  }
  return triangles;
}

void switch_on_triangle_callbacks(dBatchColliderParams& params) { params.triangle_callbacks = 1; }

class ApiCallbacks : public ::testing::Test {
 protected:
  void SetUp() override {
    merge_calls.clear();
    tri_calls.clear();
    refused.clear();
    array_calls = 0;
  }

  // The calls for one contact: as many as it has triangles of that geom, but one.
  static void expect_folded(dGeomID geom, const std::vector<int>& triangles, int side) {
    const auto last = std::find_if(merge_calls.begin(), merge_calls.end(),
                                   [&](const MergeCall& call) { return call.answer == side; });
    ASSERT_NE(last, merge_calls.end()) << "side " << side << " is no answer of the callback";
    ASSERT_GE(last - merge_calls.begin() + 2, static_cast<long>(triangles.size()));
    auto call = last - static_cast<long>(triangles.size()) + 2;
    int first = triangles[0];
    for (std::size_t i = 1; i < triangles.size(); ++i, ++call) {
      EXPECT_EQ(call->geom, geom);
      EXPECT_EQ(call->first, first);
      EXPECT_EQ(call->second, triangles[i]);
      first = call->answer;
    }
  }

  OdeWorld world;
  const TestMesh cube = make_cube(2), block = make_box({6, 6, 2});
  const TestPose on_block = turned({0, 0, 1}, 0.3, {0.1, 0.2, 1.9});
  const dGeomID upper = world.geom(world.mesh(cube), on_block);
  const dGeomID lower = world.geom(world.mesh(block), {});
};

TEST_F(ApiCallbacks, MergeAllTrianglesAtAVertexInAscendingOrderAndNameTheSide) {
  const BatchCollider collider;
  const Contacts plain = collide(upper, lower);
  dGeomTriMeshSetTriMergeCallback(upper, &record_merge);
  for (const bool swapped : {false, true}) {
    merge_calls.clear();
    const Contacts contacts = swapped ? flipped(collide(lower, upper)) : collide(upper, lower);
    ASSERT_EQ(contacts.size(), plain.size());
    int at_vertices = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const auto triangles = triangles_at(cube, {to_local(on_block, pos(contacts[i]))});
      if (triangles.empty()) continue;
      ++at_vertices;
      ASSERT_GE(triangles.size(), 3u);
      expect_folded(upper, triangles, contacts[i].side1);
      EXPECT_EQ(contacts[i].side2, plain[i].side2) << "the block has no callback";
    }
    EXPECT_GE(at_vertices, 3);
    for (const MergeCall& call : merge_calls) {
      EXPECT_EQ(call.geom, upper);
      EXPECT_GE(call.second, 0);
      EXPECT_LT(call.second, cube.triangle_count());
    }
  }
}

// Two square rods, edge on edge.
TEST_F(ApiCallbacks, MergeTheTwoTrianglesAtAnEdge) {
  const TestMesh rod = make_rod(2, 0.2);
  const TestPose on_edge = turned({1, 0, 0}, std::numbers::pi / 4);
  // The lowest edge of the upper one is 0.02 below the top one of the lower.
  const TestPose across =
      composed(turned({0, 0, 1}, 1.2, {0.03, 0.05, 0.2 * std::numbers::sqrt2 - 0.02}), on_edge);
  const dGeomID g1 = world.geom(world.mesh(rod), across), g2 = world.geom(world.mesh(rod), on_edge);
  // The ends of the edge that is lowest or topmost there.
  const auto ends = [&](const TestPose& pose, double up) {
    std::vector<Point> corners;
    for (std::size_t v = 0; v < 8; ++v) corners.push_back(rod.vertex(v));
    std::sort(corners.begin(), corners.end(), [&](const Point& a, const Point& b) {
      return up * rotate(pose, a)[2] > up * rotate(pose, b)[2];
    });
    return std::vector<Point>{corners[0], corners[1]};
  };
  const auto upper_two = triangles_at(rod, ends(across, -1));
  const auto lower_two = triangles_at(rod, ends(on_edge, 1));
  ASSERT_EQ(upper_two.size(), 2u);
  ASSERT_EQ(lower_two.size(), 2u);

  const BatchCollider collider;
  ASSERT_EQ(collide(g1, g2).size(), 1u);
  dGeomTriMeshSetTriMergeCallback(g1, &record_merge);
  dGeomTriMeshSetTriMergeCallback(g2, &record_merge);
  for (const bool swapped : {false, true}) {
    const Contacts contacts = swapped ? flipped(collide(g2, g1)) : collide(g1, g2);
    ASSERT_EQ(contacts.size(), 1u);
    expect_folded(g1, upper_two, contacts[0].side1);
    expect_folded(g2, lower_two, contacts[0].side2);
  }
}

// A callback's answer is the program's own business; all else of the contact stays.
TEST_F(ApiCallbacks, MergingIntoNonsenseChangesTheSideAlone) {
  const BatchCollider collider;
  Contacts plain = collide(upper, lower);
  dGeomTriMeshSetTriMergeCallback(upper, &merge_into_nonsense);
  Contacts contacts = collide(upper, lower);
  EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(),
                          [](const dContactGeom& c) { return c.side1 == -2147483647; }));
  for (Contacts* all : {&plain, &contacts})
    for (dContactGeom& c : *all) c.side1 = 0;
  EXPECT_EQ(difference_with_geoms(contacts, plain), "");
}

TEST_F(ApiCallbacks, ThatThrowInAMergeAreCaughtAndCountAsNotMade) {
  const BatchCollider collider;
  const Contacts plain = collide(upper, lower);
  dGeomTriMeshSetTriMergeCallback(upper, &throw_in_merge);
  Contacts contacts;
  EXPECT_NO_THROW(contacts = collide(upper, lower));
  EXPECT_EQ(difference_with_geoms(contacts, plain), "");
  EXPECT_THAT(last_error(), HasSubstr("no such triangle"));
  EXPECT_EQ(collider.stats().pairs_stock, 0);
}

TEST_F(ApiCallbacks, AreNotMadeByThePassButByTheAnswer) {
  const BatchCollider collider;
  const dSpaceID space = world.space(SpaceKind::Hash);
  const dGeomID g1 = world.geom(world.mesh(cube), on_block, space);
  world.geom(world.mesh(block), {}, space);
  dGeomTriMeshSetTriMergeCallback(g1, &record_merge);
  Collected collected;
  EXPECT_EQ(dBatchColliderSpaceCollide(collider, space, &collected, &collect_order_only), 1);
  EXPECT_EQ(collected.order.size(), 1u);
  EXPECT_TRUE(merge_calls.empty());
  collider.pass(space);
  EXPECT_FALSE(merge_calls.empty());
}

TEST_F(ApiCallbacks, AreMadeForGivenPairsAsForDCollide) {
  const BatchCollider collider(&switch_on_triangle_callbacks);
  dGeomTriMeshSetCallback(lower, &refuse_some);
  refused.insert(collide(upper, lower).at(0).side2);
  dGeomTriMeshSetTriMergeCallback(upper, &record_merge);
  const Contacts asked = collide(upper, lower);
  merge_calls.clear();
  const dGeomID pairs[] = {upper, lower};
  Contacts contacts(64);
  int count = 0;
  const int total = dBatchColliderCollidePairs(collider, pairs, 1, 64, contacts.data(),
                                               sizeof(dContactGeom), &count);
  EXPECT_EQ(total, count);
  contacts.resize(static_cast<std::size_t>(count));
  merge_calls.clear();
  EXPECT_EQ(contacts.size(), asked.size());
  for (std::size_t i = 0; i < std::min(contacts.size(), asked.size()); ++i) {
    EXPECT_EQ(pos(contacts[i]), pos(asked[i]));
    EXPECT_EQ(contacts[i].side2, asked[i].side2);
    EXPECT_EQ(contacts[i].side1 >= 1000, asked[i].side1 >= 1000);
  }
}

// What ODE's own collider does with the same callbacks.
TEST_F(ApiCallbacks, OfMergingAreMadeByOdeItselfTooAndOfTrianglesNever) {
  for (const dGeomID geom : {upper, lower}) {
    dGeomTriMeshSetTriMergeCallback(geom, &record_merge);
    dGeomTriMeshSetCallback(geom, &refuse_all);
  }
  const Contacts contacts = collide(upper, lower);
  EXPECT_FALSE(contacts.empty());
  EXPECT_FALSE(merge_calls.empty());
  EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(),
                          [](const dContactGeom& c) { return c.side1 >= 1000; }));
}

TEST_F(ApiCallbacks, OfTrianglesAreNotMadeUnlessAskedFor) {
  const BatchCollider collider;
  const Contacts plain = collide(upper, lower);
  dGeomTriMeshSetCallback(upper, &refuse_all);
  dGeomTriMeshSetCallback(lower, &refuse_all);
  EXPECT_FALSE(plain.empty());
  EXPECT_EQ(difference_with_geoms(collide(upper, lower), plain), "");
}

TEST_F(ApiCallbacks, ThatRefuseEveryTriangleLeaveNothing) {
  const BatchCollider collider(&switch_on_triangle_callbacks);
  EXPECT_FALSE(collide(upper, lower).empty());
  for (const dGeomID geom : {upper, lower}) {
    dGeomTriMeshSetCallback(geom, &refuse_all);
    dContactGeom untouched[2] = {};
    EXPECT_EQ(dCollide(upper, lower, 2, untouched, sizeof(dContactGeom)), 0);
    EXPECT_EQ(untouched[0].g1, nullptr);
    EXPECT_TRUE(collide(lower, upper).empty());
    dGeomTriMeshSetCallback(geom, nullptr);
  }
  EXPECT_FALSE(collide(upper, lower).empty());
}

// Corners on a face: one triangle of the block each.
TEST_F(ApiCallbacks, LeaveOutWhatIsOnARefusedTriangleAndKeepTheRest) {
  const BatchCollider collider(&switch_on_triangle_callbacks);
  const Contacts plain = collide(upper, lower);
  std::set<int> met;
  for (const dContactGeom& c : plain) met.insert(c.side2);
  ASSERT_GE(met.size(), 2u) << "corners on both halves of the top";
  dGeomTriMeshSetCallback(lower, &refuse_some);
  for (const int triangle : met) {
    refused = {triangle};
    tri_calls.clear();
    Contacts expected;
    for (const dContactGeom& c : plain)
      if (c.side2 != triangle) expected.push_back(c);
    const Contacts left = collide(upper, lower);
    ASSERT_EQ(left.size(), expected.size()) << triangle;
    for (const dContactGeom& c : left) {
      EXPECT_NE(c.side2, triangle);
      EXPECT_LE(c.depth, left[0].depth);
    }
    EXPECT_EQ(difference_with_geoms(collide(lower, upper), flipped(left)), "");
    for (std::size_t limit = 1; limit <= plain.size(); ++limit)
      EXPECT_EQ(difference_with_geoms(
                    collide(upper, lower, static_cast<int>(limit)),
                    {left.begin(), left.begin() + static_cast<long>(std::min(limit, left.size()))}),
                "");
    for (const TriCall& call : tri_calls) {
      EXPECT_EQ(call.geom, lower);
      EXPECT_EQ(call.other, upper);
      EXPECT_TRUE(call.triangle >= 0 && call.triangle < block.triangle_count());
    }
    EXPECT_FALSE(tri_calls.empty());
  }
}

// With the deepest gone the next deepest takes its place, at any limit.
TEST_F(ApiCallbacks, LeaveTheDeepestOfTheRestInFront) {
  const BatchCollider collider([](dBatchColliderParams& params) {
    params.triangle_callbacks = 1;
    params.max_contacts = 64;
  });
  const dGeomID torus =
      world.geom(world.mesh(make_torus(1, 0.4, 24, 16)), turned({1, 2, 3}, 1, {0.3, 0.2, 0.4}));
  const dGeomID target = world.geom(world.mesh(make_cube(2, 6)), {});
  dGeomTriMeshSetCallback(target, &refuse_some);
  const Contacts all = collide(torus, target);
  ASSERT_GE(all.size(), 40u);
  Contacts left = all;
  bool moved_up = false;  // another than the next
  for (int i = 0; i < 10; ++i) {
    const Contacts before = left;
    refused.insert(left[0].side2);
    left = collide(torus, target);
    ASSERT_FALSE(left.empty());
    EXPECT_LE(left.size(), before.size());  // on an edge the other triangle may still take it
    for (const dContactGeom& c : left) {
      EXPECT_LE(c.depth, left[0].depth);
      EXPECT_FALSE(refused.contains(c.side2));
    }
    for (const int limit : {1, 3, 20})
      EXPECT_EQ(
          difference_with_geoms(
              collide(torus, target, limit),
              {left.begin(), left.begin() + std::min<long>(limit, static_cast<long>(left.size()))}),
          "");
    EXPECT_EQ(difference_with_geoms(collide(target, torus), flipped(left)), "");
    const auto next = std::find_if(
        all.begin(), all.end(), [&](const dContactGeom& c) { return !refused.contains(c.side2); });
    moved_up = moved_up || (next != all.end() && pos(*next) != pos(left[0]));
  }
  EXPECT_LT(left.size() + 5, all.size());
  EXPECT_TRUE(moved_up);
}

// A corner is on several faces: it is gone when all of its triangles are.
TEST_F(ApiCallbacks, KeepAVertexWhileOneOfItsTrianglesIsAccepted) {
  const BatchCollider collider(&switch_on_triangle_callbacks);
  const Contacts plain = collide(upper, lower);
  const auto corner = std::find_if(plain.begin(), plain.end(), [&](const dContactGeom& c) {
    return !triangles_at(cube, {to_local(on_block, pos(c))}).empty();
  });
  ASSERT_NE(corner, plain.end());
  const auto triangles = triangles_at(cube, {to_local(on_block, pos(*corner))});
  dGeomTriMeshSetCallback(upper, &refuse_some);
  const auto find_corner = [&](const Contacts& contacts) {
    return std::find_if(contacts.begin(), contacts.end(),
                        [&](const dContactGeom& c) { return pos(c) == pos(*corner); });
  };
  refused = {triangles.begin(), triangles.end() - 1};
  const Contacts some = collide(upper, lower);
  ASSERT_NE(find_corner(some), some.end());
  EXPECT_EQ(find_corner(some)->side1, triangles.back());
  refused.insert(triangles.back());
  const Contacts none = collide(upper, lower);
  EXPECT_EQ(find_corner(none), none.end());
}

TEST_F(ApiCallbacks, OfTrianglesThatThrowAreCaughtAndRefuseNothing) {
  const BatchCollider collider(&switch_on_triangle_callbacks);
  const Contacts plain = collide(upper, lower);
  dGeomTriMeshSetCallback(upper, &throw_in_tri);
  Contacts contacts;
  EXPECT_NO_THROW(contacts = collide(upper, lower));
  EXPECT_EQ(difference_with_geoms(contacts, plain), "");
  EXPECT_THAT(last_error(), HasSubstr("dTriCallback threw"));
}

TEST_F(ApiCallbacks, OfTriangleArraysAreNeverMade) {
  const BatchCollider collider(&switch_on_triangle_callbacks);
  dGeomTriMeshSetArrayCallback(upper, &count_array);
  dGeomTriMeshSetArrayCallback(lower, &count_array);
  EXPECT_FALSE(collide(upper, lower).empty());
  EXPECT_EQ(array_calls, 0);
}

dGeomID nested_pair[2];
int collide_in_merge(dGeomID, int first, int) {
  dContactGeom contact;
  return dCollide(nested_pair[0], nested_pair[1], 1, &contact, sizeof contact) == 1 ? 77 : first;
}

TEST_F(ApiCallbacks, MayAskForAnotherPair) {
  const BatchCollider collider;
  nested_pair[0] = world.geom(world.mesh(cube), on_block);
  nested_pair[1] = lower;
  dGeomTriMeshSetTriMergeCallback(upper, &collide_in_merge);
  const Contacts contacts = collide(upper, lower);
  EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(),
                          [](const dContactGeom& c) { return c.side1 == 77; }));
}

const BatchCollider* asked_elsewhere = nullptr;
bool was_answered_elsewhere = false;
std::thread other_thread;
int wait_for_another_thread(dGeomID, int first, int) {
  if (other_thread.joinable()) return first;
  const auto done = std::make_shared<std::promise<void>>();
  std::future<void> answered = done->get_future();
  other_thread = std::thread([done] {
    asked_elsewhere->stats();
    done->set_value();
  });
  was_answered_elsewhere = answered.wait_for(std::chrono::seconds(20)) == std::future_status::ready;
  return first;
}

TEST_F(ApiCallbacks, KeepNoOtherThreadFromTheCollider) {
  const BatchCollider collider;
  asked_elsewhere = &collider;
  dGeomTriMeshSetTriMergeCallback(upper, &wait_for_another_thread);
  collide(upper, lower);
  ASSERT_TRUE(other_thread.joinable());
  other_thread.join();
  EXPECT_TRUE(was_answered_elsewhere);

  was_answered_elsewhere = false;
  const dGeomID pair[] = {upper, lower};
  Contacts contacts(64);
  dBatchColliderCollidePairs(collider, pair, 1, 64, contacts.data(), sizeof(dContactGeom), nullptr);
  ASSERT_TRUE(other_thread.joinable());
  other_thread.join();
  EXPECT_TRUE(was_answered_elsewhere);
}

// A shape of a mesh that moves has the triangles of the mesh as it was built.
TEST_F(ApiCallbacks, MergeTheTrianglesOfADeformableMesh) {
  const BatchCollider collider;
  OdeMesh& soft = world.mesh(cube);
  dBatchColliderTriMeshDataSetDeformable(collider, soft.id(), 1);
  const dGeomID geom = world.geom(soft, on_block);
  collide(geom, lower);
  for (float& x : soft.edit().vertices) x *= 1.01f;
  dGeomTriMeshDataUpdate(soft.id());
  dBatchColliderTriMeshDataUpdate(collider, soft.id());
  dGeomTriMeshSetTriMergeCallback(geom, &record_merge);
  const Contacts contacts = collide(geom, lower);
  int at_vertices = 0;
  for (const dContactGeom& c : contacts) {
    const auto triangles = triangles_at(soft.mesh(), {to_local(on_block, pos(c))});
    if (triangles.empty()) continue;
    ++at_vertices;
    expect_folded(geom, triangles, c.side1);
  }
  EXPECT_GE(at_vertices, 3);
}

}  // namespace
}  // namespace ode_ext::test
