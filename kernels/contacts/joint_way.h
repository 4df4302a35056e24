// SPDX-License-Identifier: BSD-3-Clause
// The shortest way past several planes. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_JOINT_WAY_H
#define ODE_EXT_KERNELS_CONTACTS_JOINT_WAY_H

#include "contacts/ways.h"

// Planes of which none separates a unit alone, and which may do so together: at the foot of a wall
// it is behind the floor too.
typedef struct {
  ox_plane_choice first;  // the least of them
  ox_plane plane[OX_FEW];
  float depth[OX_FEW];  // [m] of the unit
  float far[OX_FEW];    // [m] how far it has to go along each
  float share[OX_FEW];  // [m] of the way along each
  float3 way;           // the sum of these: the shortest past all
  uint count;
} ox_joint_choice;

static inline ox_joint_choice ox_begin_joint(void) {
  ox_joint_choice joint;
  joint.first = ox_no_choice();
  joint.way = (float3)(0.0f);
  joint.count = 0u;
  return joint;
}

// So often each share is mended for what the others are (Gauss-Seidel, on the dual of the least
// norm), or until none is: where planes meet at 30 degrees, to within 2^-13 of the way, which is
// lengthened by what is lacking then.
#define OX_SWEEPS 32u

static inline void ox_add_to_joint(const ox_region_view* r, const ox_plane* plane, float depth,
                                   ox_joint_choice* joint) {
  const uint last = joint->count++;
  joint->plane[last] = *plane;
  joint->depth[last] = depth;
  joint->far[last] = ox_way_past(r, depth);
  joint->share[last] = 0.0f;
  bool is_mended = true;
  for (uint sweep = 0u; sweep < OX_SWEEPS && is_mended; ++sweep) {
    is_mended = false;
    for (uint i = 0u; i <= last; ++i) {
      const float lacking = joint->far[i] - ox_dot(joint->way, joint->plane[i].normal);
      const float share = ox_max(joint->share[i] + lacking, 0.0f);
      is_mended |= share != joint->share[i];
      joint->way += (share - joint->share[i]) * joint->plane[i].normal;
      joint->share[i] = share;
    }
  }
}

// How many times as long the way has to be to be past all; infinite: it never is. Half of what each
// is longer by than the depth may be lacking.
static inline float ox_lengthened(const ox_region_view* r, const ox_joint_choice* joint) {
  float longer = 1.0f;
  for (uint i = 0u; i < joint->count; ++i) {
    const float along = ox_dot(joint->way, joint->plane[i].normal);
    if (along + 0.5f * ox_way_past(r, 0.0f) >= joint->far[i]) continue;
    longer = along > 0.0f ? ox_max(longer, joint->far[i] / along) : INFINITY;
  }
  return longer;
}

#endif
