// SPDX-License-Identifier: BSD-3-Clause
// Bolts and nuts. Threads are right-handed, about z, and both have the middle of a crest of the
// bolt's thread where z is a multiple of the pitch on the x axis: a nut fits wherever it stands a
// whole number of pitches above its bolt, turned as it is.
#pragma once

#include "meshes/triangle_mesh.h"

namespace falling_objects {

struct Thread {
  double major;    // radius of the bolt's crests [m]
  double minor;    // of its roots [m]
  double pitch;    // [m]
  unsigned sides;  // of a circle, a multiple of 6
  unsigned turns;  // of the thread
};

// The shaft begins at z = 0 and is 1.425 pitches longer than its turns; below it is a head of six
// sides, `head_height` high and `head_radius` from the middle to a corner [m]. A height of 0: none.
TriangleMesh make_bolt(const Thread& thread, double head_radius, double head_height);

// Its thread is `clearance` [m] away from the bolt's: radially at crests and roots, along z at the
// flanks. It is 1.2 pitches higher than its turns and begins just below z = 0, with a
// groove; `radius` [m] is from the middle to a corner.
TriangleMesh make_nut(const Thread& thread, double clearance, double radius);

}  // namespace falling_objects
