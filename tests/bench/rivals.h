// SPDX-License-Identifier: BSD-3-Clause
// Other libraries that collide triangle meshes, behind one interface, to be timed beside this one.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::bench {

class Rival {
 public:
  virtual ~Rival() = default;
  virtual const char* name() const = 0;

  // Meshes and objects are numbered as they are added; nothing of this is timed.
  virtual void add_mesh(const test::TestMesh& mesh) = 0;
  virtual void add_object(std::size_t mesh) = 0;

  virtual void place(std::size_t object, const test::TestPose& pose) = 0;
  // Whether anything was found.
  virtual bool collide(std::size_t a, std::size_t b) = 0;
};

// FCL with boxes that are oriented: every contact, or yes and no.
std::unique_ptr<Rival> make_fcl_all();
std::unique_ptr<Rival> make_fcl_any();
// Bullet's collider of moving triangle meshes, in single precision as Debian builds it; it gives
// contacts of triangles nearer than a margin, here none.
std::unique_ptr<Rival> make_gimpact();

// All of the above.
std::vector<std::unique_ptr<Rival>> make_rivals();

}  // namespace ode_ext::bench
