// SPDX-License-Identifier: BSD-3-Clause
// Two meshes in known poses, together in any frame.
#pragma once

#include <algorithm>
#include <vector>

#include "collide/collider.h"
#include "support/fcl_oracle.h"
#include "support/moving_scene.h"

namespace ode_ext::test {

inline Collider& collider() {
  static Collider* const collider = new Collider({});  // never destroyed, as in Rig
  return *collider;
}

// Everything in a frame of its own; results are taken back from it.
struct Placed {
  TestMesh a, b;
  TestPose pa, pb;

  std::vector<Contact> contacts(const TestPose& frame) const {
    const TestScene scene = one_pair(a, composed(frame, pa), b, composed(frame, pb));
    std::vector<Contact> found = collider().collide(scene.scene, nullptr).contacts;
    for (Contact& c : found) {
      const Point p = to_local(frame, point_of(c.position));
      const Point n = rotate_back(frame, point_of(c.normal));
      c.position = {p[0], p[1], p[2]};
      c.normal = {n[0], n[1], n[2]};
    }
    return found;
  }
  // How much larger A is taken shows where edges cross, and so how deep that is; besides it rounds.
  double tolerance(const TestPose& frame) const {
    return (kInflation + 2) *
           pair_epsilon(one_pair(a, composed(frame, pa), b, composed(frame, pb)), 0);
  }
  bool intersect_after(const Contact& contact, double distance) const {
    TestPose moved = pa;
    moved.position = moved.position + distance * point_of(contact.normal);
    return surfaces_intersect(a, moved, b, pb);
  }
};

inline double deepest(const std::vector<Contact>& contacts) {
  double depth = 0;
  for (const Contact& c : contacts) depth = std::max(depth, static_cast<double>(c.depth));
  return depth;
}

inline std::vector<TestPose> some_frames(int turned = 6) {
  Random random(81);
  std::vector<TestPose> frames{at(0, 0, 0), at(3, -4, 5)};
  for (int i = 0; i < turned; ++i) frames.push_back(random.pose(2));
  return frames;
}

}  // namespace ode_ext::test
