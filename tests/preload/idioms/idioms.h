// SPDX-License-Identifier: BSD-3-Clause
// Ways of programs to use ODE, each after one that exists. Each runs its scene and returns what it
// printed.
#pragma once

#include <string>

namespace idioms {

// --- callbacks.cpp
std::string in_the_callback();    // ODE's demos: dContact, a few contacts
std::string recursion();          // of the callback into spaces of spaces
std::string recorded();           // Gazebo: pairs noted in the callback, collided after the pass
std::string twice_and_swapped();  // Webots
std::string early_exit();         // DART: 250 contacts into a plain array, an end at the first pair
std::string prefilled();          // contacts within larger structs that are filled before
std::string disabled();           // geoms disabled by the callback
// --- geoms.cpp
std::string space_and_geom();  // dSpaceCollide2 of a space and a geom
std::string transform();       // dGeomTransform
std::string offset();          // geoms off their body
std::string many_geoms();      // of one body
std::string kinds_of_spaces();
// --- lives.cpp
std::string without_a_pass();  // OpenRAVE: dCollide of any two
std::string destroyed();       // bodies and meshes between passes
std::string updated();         // vertices moved in place, without and with passes
std::string reinitialized();   // DART: dInitODE and dCloseODE with each detector
std::string forked();          // and the child goes on
// --- worlds.cpp
std::string worlds();
std::string
threads();  // one after another unless contacts must be sound: ODE's mesh collider is not for two

}  // namespace idioms
