// SPDX-License-Identifier: BSD-3-Clause
// All sheets of the scene: shown to the collider before a pass, moved by its contacts after it.
#pragma once

#include <ode/ode.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cloth/sheet.h"
#include "simulation/scene.h"
#include "simulation/sheet_contacts.h"

namespace falling_objects {

class Sheets {
 public:
  // `count` sheets in layers above the objects of the scene.
  Sheets(std::size_t count, std::uint64_t seed, Scene& scene);
  // Tells a collider that they are deformable, before its first pass.
  void introduce(dBatchColliderID collider) const;

  // Where the sheets get to in `dt` [s] if nothing holds them, pressed on by what held them last.
  void show(double dt);
  // Moves the sheets by `dt` against these contacts and pushes the bodies back.
  void step(double dt, std::span<const dContactGeom> contacts);

  const std::vector<std::unique_ptr<Sheet>>& all() const { return sheets_; }
  // Vertex of any sheet in the last step [m/s].
  double fastest() const { return fastest_; }

 private:
  void place(std::uint64_t seed);
  void for_all(const std::function<void(std::size_t)>& use);  // in threads
  void push_bodies(double dt);

  Scene& scene_;
  std::vector<std::unique_ptr<Sheet>> sheets_;
  SheetContacts contacts_;
  double fastest_ = 0;
};

}  // namespace falling_objects
