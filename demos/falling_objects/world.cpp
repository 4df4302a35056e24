// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/world.h"

#include "falling_objects/usage_error.h"
#include "falling_objects/waiting.h"
#include "scene_file/user_meshes.h"

namespace falling_objects {
namespace {

SceneDescription with_meshes(const Options& options) {
  SceneDescription description = options.description;
  try {
    use_meshes(description, options.meshes);
  } catch (const std::runtime_error& e) {
    throw UsageError(e.what());
  }
  return description;
}

// ODE has one state of random numbers for all worlds.
class OwnRandom {
 public:
  explicit OwnRandom(unsigned long& own) : own_(own), others_(dRandGetSeed()) { dRandSetSeed(own); }
  ~OwnRandom() {
    own_ = dRandGetSeed();
    dRandSetSeed(others_);
  }
  OwnRandom(const OwnRandom&) = delete;
  OwnRandom& operator=(const OwnRandom&) = delete;

 private:
  unsigned long& own_;
  unsigned long others_;
};

}  // namespace

World::World(const Options& options, bool both_colliders)
    : options_(options), both_colliders_(both_colliders) {
  const OwnRandom random(random_);
  scene_ = std::make_unique<Scene>(with_meshes(options_), options_.seed, warnings_);
  Options colliders = options_;
  colliders.compare |= both_colliders;
  {
    const Waiting waiting(options_.quiet,
                          "the driver builds the kernels: the first time that may take a minute");
    collision_ = std::make_unique<Collision>(colliders, scene_->space());
  }
  if (options_.has_sheets()) {
    sheets_ =
        std::make_unique<Sheets>(static_cast<std::size_t>(options_.sheets), options_.seed, *scene_);
    sheets_->introduce(collision_->batch());
  }
  simulation_ = std::make_unique<Simulation>(options_, *scene_, *collision_, sheets_.get());
}

StepRecord World::step() {
  const OwnRandom random(random_);
  return simulation_->step();
}

}  // namespace falling_objects
