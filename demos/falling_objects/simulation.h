// SPDX-License-Identifier: BSD-3-Clause
// One step: collide, make contact joints, advance the world.
#pragma once

#include <cstdint>

#include "falling_objects/collision.h"
#include "falling_objects/contact_list.h"
#include "falling_objects/options.h"
#include "falling_objects/scene.h"
#include "falling_objects/sheets.h"
#include "falling_objects/step_record.h"

namespace falling_objects {

// Makes contact joints of these contacts, and a step of the world. Returns what the solver
// alone took [ms].
double advance_world(Scene& scene, dJointGroupID joints, std::span<const dContactGeom> contacts,
                     double hz);

class Simulation {
 public:
  // `sheets` may be null.
  Simulation(const Options& options, Scene& scene, Collision& collision, Sheets* sheets);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  StepRecord step();

  // The contacts that drove the last step.
  std::span<const dContactGeom> contacts() const { return contacts_.contacts(); }
  // Over all contacts of all steps so far.
  std::uint64_t hash() const { return hash_; }

 private:
  void collide(StepRecord& record);
  void show_sheets(StepRecord& record);
  void move_sheets(StepRecord& record);
  void advance(StepRecord& record);

  const Options& options_;
  Scene& scene_;
  Collision& collision_;
  Sheets* sheets_;
  ContactList contacts_;
  ContactList compared_;
  dJointGroupID joints_;
  int steps_ = 0;
  std::uint64_t hash_ = kHashStart;
};

}  // namespace falling_objects
