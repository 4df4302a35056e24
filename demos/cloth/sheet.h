// SPDX-License-Identifier: BSD-3-Clause
// A sheet of cloth as ODE and the collider see it.
#pragma once

#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <vector>

#include "cloth/cloth.h"

namespace falling_objects {

// GRAPP section 6: square sheets of 8,192 triangles.
inline constexpr unsigned kSheetQuads = 64;
inline constexpr double kSheetSize = 1.6;  // [m]
inline constexpr double kSheetSpacing = kSheetSize / kSheetQuads;

// How far sheets stay away from meshes [m]: vertices, so that triangles stay outside. Where two
// faces meet at a right angle and the diagonal of a quad, spacing * sqrt(2), lies across their edge
// with its ends a margin away from either face, its middle is outside of the edge while it is
// shorter than 2 sqrt(2) margins. So half the spacing would just do; the rest is for sheets that
// are stretched or pressed in a little.
inline constexpr double kSheetMargin = 0.65 * kSheetSpacing;

// How near two sheets see each other [m]. A sheet that falls on another at 1.6 m/s moves by 27 mm
// in a step: it is seen at least once from one side or the other.
inline constexpr double kSheetReach = 0.016;

class Sheet {
 public:
  // Its geom has no body: impulses on it are the cloth's own business.
  Sheet(dSpaceID space, Vector gravity);
  ~Sheet();
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  Cloth& cloth() { return cloth_; }
  const Cloth& cloth() const { return cloth_; }
  dGeomID geom() const { return geom_; }
  dTriMeshDataID data() const { return data_; }
  // The vertices as the collider saw them last [m, world].
  Vector seen(std::size_t vertex) const;

  // Shows all colliders these vertices, which are where the cloth is to be collided.
  void show(const std::vector<Vector>& vertices);

 private:
  Cloth cloth_;
  std::vector<float> vertices_;  // relative to the geom's position
  dTriMeshDataID data_;
  dGeomID geom_;
  Vector origin_;  // the geom's position [m]
};

}  // namespace falling_objects
