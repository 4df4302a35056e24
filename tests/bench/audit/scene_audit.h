// SPDX-License-Identifier: BSD-3-Clause
// Is what the collider says of a scene true? Every pair of the broad phase is put to FCL, which
// tells whether the surfaces intersect, to the penetration oracle, which tells whether a vertex of
// one mesh is inside the other, and to the region oracle, which tells in how many places they are.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <span>
#include <vector>

#include "simulation/scene.h"

namespace ode_ext::audit {

struct Shape;

// Numbers of pairs.
struct Findings {
  long long pairs = 0;
  long long intersecting = 0;  // surfaces cross (FCL)
  long long contained = 0;     // they do not, and one mesh is inside the other
  long long in_contact = 0;    // the collider gave at least one contact
  long long found = 0;         // of the intersecting and contained
  // Errors.
  long long overlooked = 0;      // intersecting or contained, a vertex inside, and no contact
  long long false_contacts = 0;  // a contact, but neither intersecting nor contained
  // Where the two disagree without either being wrong.
  long long fragile = 0;  // FCL's answer changes with 1e-5 of the smaller mesh's size, or rounding
  long long edges_only = 0;  // intersecting, no vertex inside by more than rounding, no contact

  // Regions of overlap, and those without a contact, of pairs that have contacts: as Answers.
  long long regions = 0, bare = 0, bare_full = 0, bare_slight = 0, bare_beyond = 0;

  long long errors() const { return overlooked + false_contacts; }
  Findings& operator+=(const Findings& other);
};

class SceneAudit {
 public:
  explicit SceneAudit(const falling_objects::Scene& scene, int max_contacts = 16);
  ~SceneAudit();

  // `contacts` are those of a pass over the scene's space at its present poses.
  Findings look(std::span<const dContactGeom> contacts) const;

 private:
  struct Placed;

  Placed place(dGeomID geom) const;
  void look_at_pair(const Placed& a, const Placed& b, std::span<const dContactGeom> contacts,
                    Findings& findings) const;

  const falling_objects::Scene& scene_;
  int max_contacts_;
  std::vector<std::unique_ptr<Shape>> shapes_;  // those of the scene, then the ground
};

}  // namespace ode_ext::audit
