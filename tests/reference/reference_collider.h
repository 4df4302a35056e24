// SPDX-License-Identifier: BSD-3-Clause
// The reference contacts in the place of ODE's collider of meshes, for programs that measure.
#pragma once

#include "reference/reference_contacts.h"
#include "support/ode_world.h"

namespace ode_ext::test {

// While it lives, dCollide of two meshes answers by reference_contacts. One at a time. Meshes are
// known by their handles and read once: none may change or be destroyed and made anew.
class ReferenceCollider {
 public:
  explicit ReferenceCollider(const ContactOptions& options = {});
  ~ReferenceCollider();
  ReferenceCollider(const ReferenceCollider&) = delete;
  ReferenceCollider& operator=(const ReferenceCollider&) = delete;

  // dCollide of two meshes.
  static Contacts collide(dGeomID g1, dGeomID g2, const ContactOptions& options);
  // Everything that is known of meshes is forgotten.
  static void forget();
};

}  // namespace ode_ext::test
