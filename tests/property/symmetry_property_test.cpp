// SPDX-License-Identifier: BSD-3-Clause
// What may change nothing: where the pair is, which mesh comes first, how its triangles are listed.
#include <gtest/gtest.h>

#include <numeric>

#include "property/random_pair.h"
#include "reference/reference_crossings.h"
#include "reference/reference_hits.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

// Whether single precision may decide about a ray of this pair either way: true of one in
// thousands.
bool has_ambiguous_rays(const TestScene& scene) {
  const auto rays = reference_rays(scene.mesh_of(0, 0), scene.pose_of(0, 0), scene.mesh_of(0, 1),
                                   scene.pose_of(0, 1));
  return std::any_of(rays.begin(), rays.end(), [](const auto& ray) { return ray.ambiguous; });
}

double tolerance_of(const TestScene& scene) {
  return comparison_tolerance(scene.mesh_of(0, 0), scene.pose_of(0, 0), scene.mesh_of(0, 1),
                              scene.pose_of(0, 1));
}

RC_GTEST_PROP(ContactProperty, MovesWithThePair, ()) {
  Random random = random_numbers();
  const TestScene scene = random_pair(random);
  if (has_ambiguous_rays(scene)) return;
  const TestPose motion = random.pose(10);
  const TestScene moved = one_pair(scene.mesh_of(0, 0), composed(motion, scene.pose_of(0, 0)),
                                   scene.mesh_of(0, 1), composed(motion, scene.pose_of(0, 1)));
  const double tolerance = 2 * tolerance_of(scene);  // the two scenes round differently
  const auto candidates = candidates_of(scene);
  const auto moved_candidates = candidates_of(moved);
  RC_CLASSIFY(!candidates.empty(), "in contact");
  RC_ASSERT(moved_candidates.size() == candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    RC_ASSERT(moved_candidates[i].side_kind == candidates[i].side_kind);
    RC_ASSERT(moved_candidates[i].vertex == candidates[i].vertex);
  }
  // Distances and depths are off by the tolerance each, cosines by as many roundings of 1.
  const bool near_tie = reduction_margin(scene, candidates) < 4 * std::max(tolerance, 1e-6);
  RC_CLASSIFY(near_tie, "near tie");
  if (near_tie) return;
  const auto contacts = collide_vertices(scene), moved_contacts = collide_vertices(moved);
  RC_ASSERT(moved_contacts.size() == contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact &a = contacts[i], &b = moved_contacts[i];
    RC_ASSERT(a.triangles == b.triangles);
    RC_ASSERT(distance(to_world(motion, point_of(a.position)), point_of(b.position)) < 1e-9);
    RC_ASSERT(distance(rotate(motion, point_of(a.normal)), point_of(b.normal)) < 1e-9);
    RC_ASSERT(std::fabs(a.depth - b.depth) < 16 * tolerance);  // 16: of slivers, see ray_step_test
  }
}

RC_GTEST_PROP(ContactProperty, IsTurnedRoundWhenThePairIs, ()) {
  Random random = random_numbers();
  const TestScene scene = random_pair(random);
  if (has_ambiguous_rays(scene)) return;
  const TestScene swapped =
      one_pair(scene.mesh_of(0, 1), scene.pose_of(0, 1), scene.mesh_of(0, 0), scene.pose_of(0, 0));
  const auto candidates = candidates_of(scene);
  RC_CLASSIFY(!candidates.empty(), "in contact");
  const bool near_tie = reduction_margin(scene, candidates) < 1e-5;
  RC_CLASSIFY(near_tie, "near tie");
  if (near_tie) return;
  const auto contacts = collide_vertices(scene), turned_round = collide_vertices(swapped);
  RC_ASSERT(turned_round.size() == contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact &a = contacts[i], &b = turned_round[i];
    RC_ASSERT(a.position == b.position);
    RC_ASSERT(a.normal == -b.normal);
    RC_ASSERT(a.depth == b.depth);
    RC_ASSERT(a.triangles[0] == b.triangles[1]);
    RC_ASSERT(a.triangles[1] == b.triangles[0]);
  }
}

// The triangles in another order; triangle i of the result is triangle order[i] of the mesh.
TestMesh reordered(const TestMesh& mesh, const std::vector<std::size_t>& order) {
  TestMesh result{mesh.vertices, {}};
  for (const std::size_t t : order)
    for (std::size_t k = 0; k < 3; ++k) result.indices.push_back(mesh.indices[3 * t + k]);
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

// What vertices and edges say of the only pair, before it is reduced to contacts. In the world; the
// normal points into the first body.
struct Said {
  Point position, normal;
  double depth;
  ox_u32 side_kind;
};

std::vector<Said> all_said(const TestScene& scene) {
  const StepRecords records = Rig::shared().run_with_edges(scene.scene, Organisation::kPipelined);
  const TestPose& frame = scene.pose_of(0, 1);
  std::vector<Said> said;
  for (ox_u32 i = 0; i < records.found[0].hits; ++i) {
    const ox_candidate& c = records.candidates.at(records.found[0].first_candidate + i);
    if ((c.side_kind & OX_HIT_KIND) == OX_HIT_NONE) continue;
    // Of a point on both surfaces rounding decides whether it is said.
    if ((c.side_kind & OX_HIT_POINT) != 0 && static_cast<double>(c.depth) < 4 * tolerance_of(scene))
      continue;
    said.push_back({to_world(frame, point_of(c.position)), rotate(frame, point_of(c.normal)),
                    static_cast<double>(c.depth), c.side_kind});
  }
  return said;
}

// An edge must cross an edge at more than 3 degrees, so that their common normal and with it where
// they pass is known 20 times as badly as their ends; depths of vertices as in ray_step_test.
bool are_alike(const Said& a, const Said& b, double tolerance) {
  return a.side_kind == b.side_kind && distance(a.position, b.position) < 32 * tolerance &&
         distance(a.normal, b.normal) < 32 * 0x1p-20 &&
         std::fabs(a.depth - b.depth) < 32 * tolerance;
}

void log(const char* which, const Said& said) {
  RC_LOG() << which << " kind " << said.side_kind << " depth " << said.depth << " at";
  for (const double x : said.position) RC_LOG() << ' ' << x;
  RC_LOG() << " normal";
  for (const double x : said.normal) RC_LOG() << ' ' << x;
  RC_LOG() << '\n';
}

bool are_alike(const std::vector<Said>& all, std::vector<Said> others, double tolerance) {
  bool alike = true;
  for (const Said& one : all) {
    const auto found = std::find_if(others.begin(), others.end(), [&](const Said& other) {
      return are_alike(one, other, tolerance);
    });
    if (found != others.end()) {
      others.erase(found);
      continue;
    }
    alike = false;
    log("only the one:", one);
  }
  for (const Said& other : others) log("only the other:", other);
  return alike && others.empty();
}

bool is_ambiguous(const TestScene& scene) {
  const auto crossings = reference_crossings(scene.mesh_of(0, 0), scene.pose_of(0, 0),
                                             scene.mesh_of(0, 1), scene.pose_of(0, 1));
  return has_ambiguous_rays(scene) ||
         std::any_of(crossings.begin(), crossings.end(), [](const auto& c) { return c.ambiguous; });
}

bool has_points(const std::vector<Said>& said) {
  return std::any_of(said.begin(), said.end(),
                     [](const Said& s) { return (s.side_kind & OX_HIT_POINT) != 0; });
}

RC_GTEST_PROP(EdgeProperty, MovesWithThePair, ()) {
  Random random = random_numbers();
  const TestScene scene = random_pair(random);
  if (is_ambiguous(scene)) return;
  const TestPose motion = random.pose(2);
  const TestScene moved = one_pair(scene.mesh_of(0, 0), composed(motion, scene.pose_of(0, 0)),
                                   scene.mesh_of(0, 1), composed(motion, scene.pose_of(0, 1)));
  std::vector<Said> expected = all_said(scene);
  for (Said& said : expected) {
    said.position = to_world(motion, said.position);
    said.normal = rotate(motion, said.normal);
  }
  RC_CLASSIFY(has_points(expected), "contacts of edges");
  RC_ASSERT(are_alike(expected, all_said(moved), 2 * tolerance_of(scene)));
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
  RC_ASSERT(are_alike(expected, all_said(one_pair(a, scene.pose_of(0, 0), b, scene.pose_of(0, 1))),
                      tolerance_of(scene)));
}

}  // namespace
}  // namespace ode_ext::test
