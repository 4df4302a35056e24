// SPDX-License-Identifier: BSD-3-Clause
// One step: collide, make contact joints, advance the world.
#pragma once

#include <cstdint>

#include "simulation/collision.h"
#include "simulation/contact_list.h"
#include "simulation/scene.h"
#include "simulation/sheets.h"
#include "simulation/simulation_settings.h"
#include "simulation/step_record.h"

namespace falling_objects {

// Makes contact joints of these contacts, and a step of the world. Returns what the solver
// alone took [ms].
double advance_world(Scene& scene, dJointGroupID joints, std::span<const dContactGeom> contacts,
                     double hz);

class Simulation {
 public:
  // `sheets` may be null.
  Simulation(const SimulationSettings& settings, Scene& scene, Collision& collision,
             Sheets* sheets);
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

  const SimulationSettings& settings_;
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
