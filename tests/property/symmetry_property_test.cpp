// SPDX-License-Identifier: BSD-3-Clause
// What may change nothing: where the pair is, which mesh comes first, how its triangles are listed.
#include <gtest/gtest.h>

#include <numeric>
#include <sstream>
#include <string>

#include "property/random_pair.h"
#include "reference/reference_crossings.h"
#include "reference/reference_hits.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

double tolerance_of(const TestScene& scene) {
  return comparison_tolerance(scene.mesh_of(0, 0), scene.pose_of(0, 0), scene.mesh_of(0, 1),
                              scene.pose_of(0, 1));
}

// Whether single precision may decide about a crossing of this pair either way, or how much larger
// A is taken.
bool is_ambiguous(const TestScene& scene) {
  const auto crossings = reference_crossings(
      ReferenceSurface(scene.mesh_of(0, 0)), scene.pose_of(0, 0),
      ReferenceSurface(scene.mesh_of(0, 1)), scene.pose_of(0, 1), 2 * tolerance_of(scene));
  return std::any_of(crossings.begin(), crossings.end(), [](const auto& c) { return c.ambiguous; });
}

// What of the only pair may become a contact, before it is reduced. In the world; the normal points
// into the first body.
struct Said {
  Point position, normal;
  double depth;
  ox_u32 side_kind;
};

std::vector<Said> all_said(const TestScene& scene, const std::vector<Candidate>& candidates) {
  const TestPose& frame = scene.pose_of(0, 1);
  std::vector<Said> said;
  for (const Candidate& c : candidates)
    said.push_back({to_world(frame, point_of(c.position)), rotate(frame, point_of(c.normal)),
                    static_cast<double>(c.depth), c.side_kind});
  return said;
}

std::vector<Said> all_said(const TestScene& scene) { return all_said(scene, candidates_of(scene)); }

std::vector<Said> moved_by(const TestPose& motion, std::vector<Said> all) {
  for (Said& said : all) {
    said.position = to_world(motion, said.position);
    said.normal = rotate(motion, said.normal);
  }
  return all;
}

// An edge of a pair of edges may cross the other, or the face it goes through, at as little as
// 0.01 radians, so that where they meet is known 100 times as badly as their ends.
bool are_alike(const Said& a, const Said& b, double tolerance) {
  return a.side_kind == b.side_kind && distance(a.position, b.position) < 128 * tolerance &&
         distance(a.normal, b.normal) < 128 * 0x1p-20 &&
         std::fabs(a.depth - b.depth) < 32 * tolerance;
}

void describe(std::ostream& out, const char* which, const Said& said) {
  out << which << " kind " << said.side_kind << " depth " << said.depth << " at";
  for (const double x : said.position) out << ' ' << x;
  out << " normal";
  for (const double x : said.normal) out << ' ' << x;
  out << '\n';
}

// What is said of one and not of the other; empty: nothing.
std::string unmatched(const std::vector<Said>& all, std::vector<Said> others, double tolerance) {
  std::ostringstream out;
  for (const Said& one : all) {
    const auto found = std::find_if(others.begin(), others.end(), [&](const Said& other) {
      return are_alike(one, other, tolerance);
    });
    if (found != others.end()) {
      others.erase(found);
      continue;
    }
    describe(out, "only the one:", one);
  }
  for (const Said& other : others) describe(out, "only the other:", other);
  return out.str();
}

bool has_points(const std::vector<Said>& said) {
  return std::any_of(said.begin(), said.end(),
                     [](const Said& s) { return (s.side_kind & OX_HIT_POINT) != 0; });
}

TestScene scene_moved_by(const TestPose& motion, const TestScene& scene) {
  return one_pair(scene.mesh_of(0, 0), composed(motion, scene.pose_of(0, 0)), scene.mesh_of(0, 1),
                  composed(motion, scene.pose_of(0, 1)));
}

RC_GTEST_PROP(ContactProperty, MovesWithThePair, ()) {
  Random random = random_numbers();
  const TestScene scene = random_pair(random);
  if (is_ambiguous(scene)) return;
  const TestPose motion = random.pose(2);
  const TestScene moved = scene_moved_by(motion, scene);
  const auto candidates = candidates_of(scene);
  const std::vector<Said> expected = moved_by(motion, all_said(scene, candidates));
  RC_CLASSIFY(!candidates.empty(), "in contact");
  RC_CLASSIFY(has_points(expected), "contacts of edges");
  const double tolerance = 2 * tolerance_of(scene);  // the two scenes round differently
  RC_ASSERT(unmatched(expected, all_said(moved), tolerance) == "");
  // Distances and depths are off by the tolerance each, cosines by as many roundings of 1.
  const bool near_tie = reduction_margin(scene, candidates) < 4 * std::max(tolerance, 1e-6);
  RC_CLASSIFY(near_tie, "near tie");
  if (near_tie) return;
  const auto contacts = collide(scene), moved_contacts = collide(moved);
  RC_ASSERT(moved_contacts.size() == contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact &a = contacts[i], &b = moved_contacts[i];
    RC_ASSERT(a.triangles == b.triangles);
    RC_ASSERT(distance(to_world(motion, point_of(a.position)), point_of(b.position)) <
              128 * tolerance);
    RC_ASSERT(distance(rotate(motion, point_of(a.normal)), point_of(b.normal)) < 128 * 0x1p-20);
    RC_ASSERT(std::fabs(a.depth - b.depth) < 32 * tolerance);
  }
}

// Of each of these pairs two units are as deep as one another, and a pair of edges clears the one
// with all that is left, or the other alone.
TEST(ContactSymmetry, UnitsThatAreAsDeepAreClearedInOneOrderWhereverThePairIs) {
  for (const std::uint64_t seed : {184309598u, 947830216u, 837369511u, 128258u}) {
    Random random(seed);
    const TestScene scene = random_pair(random);
    const TestPose motion = random.pose(2);
    EXPECT_EQ(unmatched(moved_by(motion, all_said(scene)), all_said(scene_moved_by(motion, scene)),
                        2 * tolerance_of(scene)),
              "");
  }
}

// Of few pairs another one: it is the first mesh that is taken larger, and of units as deep as one
// another its own are cleared first. What a program asks is put in one order before.
TEST(ContactSymmetry, IsAsDeepWhenThePairIsTurnedRoundInAllButOneOfAHundred) {
  const auto deepest = [](const TestScene& of) {
    double depth = 0;
    for (const Said& said : all_said(of)) depth = std::max(depth, said.depth);
    return depth;
  };
  Random random(4);
  int colliding = 0, different = 0;
  for (int i = 0; i < 1500; ++i) {
    const TestScene scene = random_pair(random);
    if (is_ambiguous(scene)) continue;
    const TestScene swapped = one_pair(scene.mesh_of(0, 1), scene.pose_of(0, 1),
                                       scene.mesh_of(0, 0), scene.pose_of(0, 0));
    const double one = deepest(scene), other = deepest(swapped);
    EXPECT_EQ(one > 0, other > 0) << "pair " << i;
    colliding += one > 0;
    different += std::fabs(one - other) >= 32 * tolerance_of(scene);
  }
  EXPECT_GT(colliding, 1000);
  EXPECT_LE(different, colliding / 100);
}

// The triangles in another order, and each from another corner on; triangle i of the result is
// triangle order[i] of the mesh.
TestMesh reordered(const TestMesh& mesh, const std::vector<std::size_t>& order) {
  TestMesh result{mesh.vertices, {}};
  for (const std::size_t t : order)
    for (std::size_t k = 0; k < 3; ++k)
      result.indices.push_back(mesh.indices[3 * t + (k + order[0] + t) % 3]);
  return result;
}

std::vector<std::size_t> random_order(int count, Random& random) {
  std::vector<std::size_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int i = count; i > 1; --i)
    std::swap(order[static_cast<std::size_t>(i - 1)],
              order[static_cast<std::size_t>(random.below(i))]);
  return order;
}

bool has_corner(const TestScene& scene, std::size_t side, std::uint32_t triangle, Vec3d position) {
  double nearest = 1;
  for (std::size_t k = 0; k < 3; ++k)
    nearest = std::min(nearest, distance(to_world(scene.pose_of(0, side),
                                                  scene.mesh_of(0, side).corner(triangle, k)),
                                         point_of(position)));
  return nearest < 1e-9;
}

RC_GTEST_PROP(ContactProperty, DoesNotDependOnTheOrderOfTriangles, ()) {
  Random random = random_numbers();
  const TestScene scene = random_pair(random);
  const std::vector<std::size_t> orders[] = {
      random_order(scene.mesh_of(0, 0).triangle_count(), random),
      random_order(scene.mesh_of(0, 1).triangle_count(), random)};
  const TestScene permuted =
      one_pair(reordered(scene.mesh_of(0, 0), orders[0]), scene.pose_of(0, 0),
               reordered(scene.mesh_of(0, 1), orders[1]), scene.pose_of(0, 1));
  const auto contacts = collide(scene), of_permuted = collide(permuted);
  RC_CLASSIFY(!contacts.empty(), "in contact");
  RC_ASSERT(of_permuted.size() == contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact &a = contacts[i], &b = of_permuted[i];
    RC_ASSERT(a.position == b.position);
    RC_ASSERT(a.normal == b.normal);
    RC_ASSERT(a.depth == b.depth);
    // On the vertex's side any triangle there will do, on the other it is the same one.
    for (std::size_t side = 0; side < 2; ++side)
      RC_ASSERT(orders[side][b.triangles[side]] == a.triangles[side] ||
                has_corner(permuted, side, b.triangles[side], b.position));
  }
}

// As a program asks: of the meshes the same one is always the first.
TEST(EdgeProperty, IsTurnedRoundExactlyWhenThePairIs) {
  Random random(91);
  OdeWorld world;
  const BatchCollider collider;
  std::size_t contacts = 0;
  for (int i = 0; i < 100; ++i) {
    const TestScene scene = random_pair(random);
    dGeomID geoms[2];
    for (std::size_t side = 0; side < 2; ++side)
      geoms[side] = world.geom(world.mesh(scene.mesh_of(0, side)), scene.pose_of(0, side), nullptr);
    const Contacts answer = collide(geoms[0], geoms[1]);
    contacts += answer.size();
    EXPECT_EQ(difference(flipped(collide(geoms[1], geoms[0])), answer), "") << i;
  }
  EXPECT_GT(contacts, 300u);
}

RC_GTEST_PROP(EdgeProperty, DoesNotDependOnTheOrderOfTriangles, ()) {
  Random random = random_numbers();
  const TestScene scene = random_pair(random);
  const auto shuffled = [&](std::size_t side) {
    const TestMesh& mesh = scene.mesh_of(0, side);
    return reordered(mesh, random_order(mesh.triangle_count(), random));
  };
  const TestMesh a = shuffled(0), b = shuffled(1);
  const auto expected = all_said(scene);
  RC_CLASSIFY(has_points(expected), "contacts of edges");
  const auto said = all_said(one_pair(a, scene.pose_of(0, 0), b, scene.pose_of(0, 1)));
  RC_ASSERT(unmatched(expected, said, tolerance_of(scene)) == "");
}

}  // namespace
}  // namespace ode_ext::test
