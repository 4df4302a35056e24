// SPDX-License-Identifier: BSD-3-Clause
// The live colliders, and which of them answers.
#pragma once

#include <ode/ode.h>

#include <memory>

#include "ode/batch_collider.h"

namespace ode_ext {

void register_collider(std::shared_ptr<BatchCollider> collider);
// Null if the handle is not that of a live collider. A handle is only ever compared.
std::shared_ptr<BatchCollider> find_collider(const void* handle);
// False if a pass of it is running.
bool unregister_collider(const std::shared_ptr<BatchCollider>& collider);

// Calls `visit(BatchCollider&)` for every live collider.
template <class Visit>
void for_each_collider(Visit visit);
std::vector<std::shared_ptr<BatchCollider>> live_colliders();
template <class Visit>
void for_each_collider(Visit visit) {
  for (const auto& collider : live_colliders()) visit(*collider);
}

// Of the passes that this thread makes, the last is by this collider.
void note_pass_here(const std::shared_ptr<BatchCollider>& collider);

// Answers dCollide(g1, g2) for two meshes: by the collider whose pass runs on this thread; else by
// that of the thread's last pass, or the latest created if it made none; but by the latest other
// one that holds the pair if that does not and the other is not at work. -1: ODE's own collider is
// to answer.
int answer_from_registry(dGeomID g1, dGeomID g2, int limit, dContactGeom* contacts, int skip);

}  // namespace ode_ext
