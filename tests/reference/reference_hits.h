// SPDX-License-Identifier: BSD-3-Clause
// The vertex-ray rule as an oracle: brute force, double precision, single thread, no shared code.
//
// From each vertex of the source a ray goes along minus its normal at the target. What it meets
// first after leaving the surface the vertex may lie on decides: a back face means that the vertex
// is inside (Hermann 2008; GRAPP section 3).
#pragma once

#include <vector>

#include "reference/reference_mesh.h"

namespace ode_ext::test {

enum class HitKind {
  None,      // outside, or the source's own surface ends the ray and the target is open
  Contact,   // inside, and the ray leaves the target before it leaves the source
  Fallback,  // inside a closed target, but the ray leaves the source first
  Touching   // on the target's surface and pointing out of it: depth 0
};

struct ReferenceHit {
  int side;        // 0: a vertex of a against b; 1: a vertex of b against a
  Point vertex;    // of the source, in its own frame
  Point position;  // the same in the world
  int triangle;    // of the target, as in its TestMesh; -1 for None
  double t;        // [m] along the ray
  double depth;    // [m] to the plane of the triangle, along its normal
  Point normal;    // unit, world, into a: moving a by depth * normal brings the vertex to the plane
  double exit;     // [m] where the ray leaves the source itself
  HitKind kind;
  bool ambiguous;  // single precision may decide otherwise: exclude (and count) when comparing
};

// One entry per vertex ray, None included: first those of a's vertices, then those of b's.
std::vector<ReferenceHit> reference_rays(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                         const TestPose& pb, double open_thickness = 0);

// Those that are not None.
std::vector<ReferenceHit> reference_hits(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                         const TestPose& pb, double open_thickness = 0);

// Within how much [m] of the reference a single-precision position or depth of this pair must be.
double comparison_tolerance(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                            const TestPose& pb);

}  // namespace ode_ext::test
