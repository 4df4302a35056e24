// SPDX-License-Identifier: BSD-3-Clause
// Depths and normals where they are known otherwise: of a corner pressed into a face, of spheres,
// and as far as convex bodies say.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/mesh_oracle.h"
#include "property/random_pair.h"
#include "reference/reference_hits.h"
#include "support/ccd_oracle.h"
#include "support/fcl_oracle.h"

namespace ode_ext::test {
namespace {

// A convex body over a slab, its lowest corner `depth` under the slab's face and no other;
// everything in a frame of its own.
struct Pressed {
  TestScene scene;
  TestPose frame;
  double depth = 0;  // [m]
  Point corner{};    // world
  bool usable = false;
};

Pressed press(Random& random) {
  const TestMesh bodies[] = {make_tetrahedron(1), make_cube(1), make_rod(1.5, 0.3),
                             make_icosphere(0.6, 1), make_box({1, 0.5, 0.3})};
  const TestMesh& body = bodies[random.below(5)];
  const TestMesh slab = make_box({6, 6, 1}, 2, 3, 1);
  Pressed pressed;
  pressed.depth = random.uniform(0.002, 0.02);
  TestPose pose = random.pose(0.2);
  std::vector<std::pair<double, std::size_t>> heights;
  for (std::size_t i = 0; i < static_cast<std::size_t>(body.vertex_count()); ++i)
    heights.emplace_back(rotate(pose, body.vertex(i))[2], i);
  std::sort(heights.begin(), heights.end());
  // The next corner well above the face, and the corner not so flat that its ray leaves elsewhere.
  pressed.usable = heights[1].first - heights[0].first > 1.5 * pressed.depth;
  const std::size_t lowest = heights[0].second;
  pose.position[2] = 0.5 - pressed.depth - heights[0].first;
  pressed.frame = random.pose(5);
  pressed.corner = to_world(pressed.frame, to_world(pose, body.vertex(lowest)));
  pressed.scene = one_pair(body, composed(pressed.frame, pose), slab, pressed.frame);
  return pressed;
}

RC_GTEST_PROP(DepthProperty, OfACornerInAFaceIsThatOfLibccd, ()) {
  Random random = random_numbers();
  const Pressed pressed = press(random);
  if (!pressed.usable) return;
  const TestScene& scene = pressed.scene;
  const auto contacts = collide(scene);
  RC_ASSERT(contacts.size() == 1u);
  const double tolerance = comparison_tolerance(scene.mesh_of(0, 0), scene.pose_of(0, 0),
                                                scene.mesh_of(0, 1), scene.pose_of(0, 1));
  const Point up = rotate(pressed.frame, {0, 0, 1});
  RC_ASSERT(std::fabs(contacts[0].depth - pressed.depth) < tolerance);
  RC_ASSERT(distance(point_of(contacts[0].normal), up) < 1e-6);  // a float normal
  RC_ASSERT(distance(point_of(contacts[0].position), pressed.corner) < tolerance);

  const ConvexPenetration ccd = convex_penetration(scene.mesh_of(0, 0), scene.pose_of(0, 0),
                                                   scene.mesh_of(0, 1), scene.pose_of(0, 1));
  RC_ASSERT(ccd.overlap);
  // One time in hundreds libccd stops early, with a depth a tenth of the true one. A depth that
  // does not part the two is no oracle.
  const double slack = tolerance + 6 * kEpaTolerance;
  TestPose parted = scene.pose_of(0, 0);
  parted.position = parted.position + (ccd.depth + slack) * ccd.direction;
  const bool astray =
      surfaces_intersect(scene.mesh_of(0, 0), parted, scene.mesh_of(0, 1), scene.pose_of(0, 1));
  RC_CLASSIFY(astray, "libccd astray");
  if (astray) return;
  RC_ASSERT(std::fabs(ccd.depth - contacts[0].depth) < slack);
  RC_ASSERT(dot(ccd.direction, point_of(contacts[0].normal)) > 0.999);
}

RC_GTEST_PROP(DepthProperty, AlongTheNormalClearsACornerFromAFace, ()) {
  Random random = random_numbers();
  const Pressed pressed = press(random);
  if (!pressed.usable) return;
  const TestScene& scene = pressed.scene;
  const Contact contact = collide(scene).at(0);
  const auto intersect_after = [&](double distance) {
    TestPose moved = scene.pose_of(0, 0);
    moved.position = moved.position + distance * point_of(contact.normal);
    return surfaces_intersect(scene.mesh_of(0, 0), moved, scene.mesh_of(0, 1), scene.pose_of(0, 1));
  };
  const double tolerance = comparison_tolerance(scene.mesh_of(0, 0), scene.pose_of(0, 0),
                                                scene.mesh_of(0, 1), scene.pose_of(0, 1));
  RC_ASSERT(intersect_after(0));
  RC_ASSERT(intersect_after(contact.depth - tolerance));
  RC_ASSERT(!intersect_after(contact.depth + tolerance));
}

// Of a closed mesh with many triangles: what is inside is so, and no plane of a convex mesh is
// nearer than its surface.
RC_GTEST_PROP(DepthProperty, IsAtLeastTheDistanceToTheSurfaceOfAConvexTarget, ()) {
  Random random = random_numbers();
  const TestMesh convex[] = {make_tetrahedron(1.2), make_cube(1, 2), make_icosphere(0.6, 2),
                             make_rod(2, 0.3)};
  const TestMesh& target = convex[random.below(4)];
  const TestMesh source = random_closed_mesh(random);
  const TestPose ps = random.pose(0.3), pt = random.pose(0.3);
  const TestScene scene = one_pair(source, ps, target, pt);
  const oracle::Mesh surface(target.vertices, target.indices);
  const double tolerance = comparison_tolerance(source, ps, target, pt);
  double farthest_in = 0;
  for (const Candidate& c : candidates_of(scene)) {
    if ((c.side_kind & (OX_HIT_SIDE | OX_HIT_POINT)) != 0) continue;  // no vertex of the source
    const double distance = -surface.signed_distance({static_cast<double>(c.position[0]),
                                                      static_cast<double>(c.position[1]),
                                                      static_cast<double>(c.position[2])});
    RC_ASSERT(distance > -kDoubt * tolerance);
    RC_ASSERT(static_cast<double>(c.depth) > distance - 2 * tolerance);
    farthest_in = std::max(farthest_in, distance);
  }
  RC_CLASSIFY(farthest_in > 0, "a vertex inside");
  if (farthest_in == 0) return;
  const auto contacts = collide(scene);
  RC_ASSERT(!contacts.empty());
  RC_ASSERT(contacts.front().depth >= farthest_in - 2 * tolerance);
}

// Facets of a sphere lie within s = r(1 - cos a) of it, a being the angle from a facet's middle
// to its corners. Let h be the overlap. A vertex inside is at most h deep under the other sphere
// and its ray, along the radius, leaves through a facet below that sphere: at most h deep, and
// the facet's plane, tilted by at most a against the radius there, adds 1 / cos a at most; the
// deepest vertex is within a of the line of centres, so at least h - 2s deep under the sphere and
// h - 3s under a facet.
RC_GTEST_PROP(DepthProperty, OfSpheresIsTheAnalyticOneWithinAFacet, ()) {
  Random random = random_numbers();
  const double ra = random.uniform(0.4, 1), rb = random.uniform(0.4, 1);
  const TestMesh a = make_icosphere(ra, 3), b = make_icosphere(rb, 3);
  // 20 * 4^3 facets, edges of at most 63.4 / 8 * 1.2 degrees: circumradius below 5.5 degrees.
  const double angle = 5.5 * 0.017453292519943295;
  const double sag = std::max(ra, rb) * (1 - std::cos(angle));
  const double overlap = random.uniform(0.04, 0.1);
  const TestPose pb = random.pose(3);
  TestPose pa = random.pose(0);
  const Point line = random.direction();
  pa.position = pb.position + (ra + rb - overlap) * line;
  const auto contacts = collide(one_pair(a, pa, b, pb));
  RC_ASSERT(!contacts.empty());
  const Contact& deepest = contacts.front();
  RC_ASSERT(deepest.depth < overlap / std::cos(2 * angle) + sag);
  RC_ASSERT(deepest.depth > overlap - 3 * sag);
  // A facet that a vertex within a of the line of centres leaves through is itself within 2a of it.
  RC_ASSERT(dot(point_of(deepest.normal), line) > std::cos(4 * angle));
  // All vertices in the lens are: its rim is where the spheres cross.
  const double rim = std::acos(1 - overlap / std::min(ra, rb));
  for (const Contact& contact : contacts)
    RC_ASSERT(dot(point_of(contact.normal), line) > std::cos(rim + 2 * angle));
}

}  // namespace
}  // namespace ode_ext::test
