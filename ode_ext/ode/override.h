// SPDX-License-Identifier: BSD-3-Clause
// The trimesh-trimesh entry of ODE's collider table.
#pragma once

namespace ode_ext {

// Makes ODE ask this library for mesh pairs. Repeated at every call that needs ODE to be
// initialised, since ODE rebuilds its table in dInitODE and tells nobody. There is no way to read
// what was there before.
void install_override();

}  // namespace ode_ext
