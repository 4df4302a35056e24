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
    : options_(options), scene_(make_scene(options)), joints_(dJointGroupCreate(0)) {}

World::~World() { dJointGroupDestroy(joints_); }

void World::introduce(dBatchColliderID) const {}

void World::prepare() { dSpaceClean(scene_.space()); }

void World::advance(std::span<const dContactGeom> contacts) {
  falling_objects::advance_world(scene_, joints_, contacts, options_.hz);
}

}  // namespace paper
