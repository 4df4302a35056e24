// SPDX-License-Identifier: BSD-3-Clause
// A scene and all that moves it, so that there can be two of them, and that one can begin again.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "falling_objects/options.h"
#include "simulation/collision.h"
#include "simulation/scene.h"
#include "simulation/sheets.h"
#include "simulation/simulation.h"

namespace falling_objects {

class World {
 public:
  // Throws UsageError or NoDevice.
  // `both_colliders`: either may drive it.
  explicit World(const Options& options, bool both_colliders = false);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // The same whatever other worlds do meanwhile: the numbers that ODE draws at random are this
  // world's own.
  StepRecord step();

  const Options& options() const { return options_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  Scene& scene() { return *scene_; }
  const Scene& scene() const { return *scene_; }
  const Collision& collision() const { return *collision_; }
  const Sheets* sheets() const { return sheets_.get(); }
  const Simulation& simulation() const { return *simulation_; }

  bool has_both_colliders() const { return both_colliders_; }
  // From the next step on.
  void drive_by(Collider collider) { options_.collider = collider; }

 private:
  Options options_;
  bool both_colliders_;
  std::vector<std::string> warnings_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<Collision> collision_;
  std::unique_ptr<Sheets> sheets_;
  std::unique_ptr<Simulation> simulation_;
  unsigned long random_ = 0;  // the state of ODE's random numbers
};

}  // namespace falling_objects
