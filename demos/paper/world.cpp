// SPDX-License-Identifier: BSD-3-Clause
#include "paper/world.h"

#include <string>
#include <vector>

#include "meshes/shapes.h"
#include "simulation/simulation.h"

namespace paper {
namespace {

falling_objects::Scene make_scene(const falling_objects::SimulationSettings& settings) {
  std::vector<std::string> warnings;  // of open meshes: the four shapes are closed
  return {falling_objects::make_shapes(), settings, warnings};
}

}  // namespace

World::World(const falling_objects::SimulationSettings& settings)
    : settings_(settings), scene_(make_scene(settings)), joints_(dJointGroupCreate(0)) {
  if (settings.has_sheets())
    sheets_ = std::make_unique<falling_objects::Sheets>(static_cast<std::size_t>(settings.sheets),
                                                        settings.seed, scene_);
}

World::~World() { dJointGroupDestroy(joints_); }

void World::introduce(dBatchColliderID collider) const {
  if (sheets_ != nullptr) sheets_->introduce(collider);
}

void World::prepare() {
  if (sheets_ != nullptr) sheets_->show(1 / settings_.hz);
  dSpaceClean(scene_.space());
}

void World::advance(std::span<const dContactGeom> contacts) {
  if (sheets_ != nullptr) sheets_->step(1 / settings_.hz, contacts);
  falling_objects::advance_world(scene_, joints_, contacts, settings_.hz);
}

}  // namespace paper
