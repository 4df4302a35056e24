// SPDX-License-Identifier: BSD-3-Clause
// The colliders of a program that knows of none: one, and where several threads make passes at a
// time as many as these.
#pragma once

#include <ode/ode.h>

#include "ode/pair_gather.h"

namespace ode_ext {

// Makes the pass by a collider that no other thread passes with. False: there is none, since the
// device cannot be used, as was said; nothing was done.
bool collide_by_a_free_collider(const PassRoot& root, void* data, dNearCallback* callback);

// Creates one if there is none yet.
void have_a_collider();

double seconds_of_starting();  // creating them

}  // namespace ode_ext
