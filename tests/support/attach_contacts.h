// SPDX-License-Identifier: BSD-3-Clause
// Contacts of one step of ODE's, as joints.
#pragma once

#include "support/ode_world.h"

namespace ode_ext::test {

inline void attach_contacts(dWorldID world, dJointGroupID joints, const Contacts& contacts) {
  for (const dContactGeom& geom : contacts) {
    dContact contact{};
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = 0.5;
    contact.geom = geom;
    dJointAttach(dJointCreateContact(world, joints, &contact), dGeomGetBody(geom.g1),
                 dGeomGetBody(geom.g2));
  }
}

}  // namespace ode_ext::test
