// SPDX-License-Identifier: BSD-3-Clause
// A scene of falling_objects that is collided from outside.
#pragma once

#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <memory>
#include <span>

#include "simulation/scene.h"
#include "simulation/sheets.h"
#include "simulation/simulation_settings.h"

namespace paper {

class World {
 public:
  // Between dInitODE2 and dCloseODE.
  explicit World(const falling_objects::SimulationSettings& settings);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  dSpaceID space() const { return scene_.space(); }
  // What a collider must be told of the scene before its first pass.
  void introduce(dBatchColliderID collider) const;
  // Before the step's collisions: sheets show where they are, and all boxes are brought up to date,
  // whoever collides first.
  void prepare();
  // After them.
  void advance(std::span<const dContactGeom> contacts);

 private:
  const falling_objects::SimulationSettings& settings_;
  falling_objects::Scene scene_;
  std::unique_ptr<falling_objects::Sheets> sheets_;  // null: none
  dJointGroupID joints_;
};

}  // namespace paper
