// SPDX-License-Identifier: BSD-3-Clause
#include "paper/world.h"

#include <string>
#include <vector>

#include "falling_objects/shapes.h"
#include "falling_objects/simulation.h"

namespace paper {
namespace {

falling_objects::Scene make_scene(const falling_objects::Options& options) {
  std::vector<std::string> warnings;  // of open meshes: the four shapes are closed
  return {falling_objects::make_shapes(), options, warnings};
}

}  // namespace

World::World(const falling_objects::Options& options)
    : options_(options), scene_(make_scene(options)), joints_(dJointGroupCreate(0)) {
  if (options.has_sheets())
    sheets_ = std::make_unique<falling_objects::Sheets>(static_cast<std::size_t>(options.sheets),
                                                        options.seed, scene_);
}

World::~World() { dJointGroupDestroy(joints_); }

void World::introduce(dBatchColliderID collider) const {
  if (sheets_ != nullptr) sheets_->introduce(collider);
}

void World::prepare() {
  if (sheets_ != nullptr) sheets_->show(1 / options_.hz);
  dSpaceClean(scene_.space());
}

void World::advance(std::span<const dContactGeom> contacts) {
  if (sheets_ != nullptr) sheets_->step(1 / options_.hz, contacts);
  falling_objects::advance_world(scene_, joints_, contacts, options_.hz);
}

}  // namespace paper
