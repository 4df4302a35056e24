// SPDX-License-Identifier: BSD-3-Clause
// Contacts as ODE wants them. The one place where a contact is turned round for swapped arguments.
#pragma once

#include <ode/ode.h>

#include <span>
#include <string>

#include "contacts/contact.h"

namespace ode_ext {

// What is wrong with a stride, "": nothing. Contacts would be written into one another.
std::string fault_of_stride(int skip);

// Writes at most `limit` of the contacts between `first` and `second` (whose contacts they are), as
// an answer to dCollide(g1, g2): {g1, g2} = {first, second} in either order. `skip` [bytes] is the
// stride; only the dContactGeom of what is returned is written. Returns how many.
int export_contacts(std::span<const Contact> contacts, dGeomID first, dGeomID g1, dGeomID g2,
                    int limit, dContactGeom* target, int skip);

// The same contact as seen with g1 and g2 exchanged.
void turn_round(dContactGeom& contact);

}  // namespace ode_ext
