// SPDX-License-Identifier: BSD-3-Clause
#include "ode/registry.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "ode/pass.h"
#include "ode/thread_state.h"

namespace ode_ext {
namespace {

struct Registry {
  std::mutex mutex;
  std::vector<std::shared_ptr<BatchCollider>> colliders;  // in the order of their creation
};

// Never destroyed: a program may ask from its own static destructors.
Registry& registry() {
  static auto* instance = new Registry;
  return *instance;
}

struct LastPass {
  std::weak_ptr<BatchCollider> collider;
};

}  // namespace

void note_pass_here(const std::shared_ptr<BatchCollider>& collider) {
  of_this_thread<LastPass>().collider = collider;
}

void register_collider(std::shared_ptr<BatchCollider> collider) {
  const std::lock_guard lock(registry().mutex);
  registry().colliders.push_back(std::move(collider));
}

std::shared_ptr<BatchCollider> find_collider(const void* handle) {
  for (const auto& collider : live_colliders())
    if (collider.get() == handle) return collider;
  return nullptr;
}

bool unregister_collider(const std::shared_ptr<BatchCollider>& collider) {
  const std::lock_guard lock(registry().mutex);
  if (collider->is_passing()) return false;
  std::erase(registry().colliders, collider);
  return true;
}

std::vector<std::shared_ptr<BatchCollider>> live_colliders() {
  const std::lock_guard lock(registry().mutex);
  return registry().colliders;
}

int answer_from_registry(dGeomID g1, dGeomID g2, int limit, dContactGeom* contacts, int skip) {
  BatchCollider* passing = Pass::collider_on_this_thread();
  if (passing != nullptr) return passing->answer(g1, g2, limit, contacts, skip);
  const auto colliders = live_colliders();
  if (colliders.empty()) return -1;
  const auto last = of_this_thread<LastPass>().collider.lock();
  const bool is_alive = std::find(colliders.begin(), colliders.end(), last) != colliders.end();
  const auto& likely = is_alive ? last : colliders.back();
  if (likely->holds(g1, g2, true)) return likely->answer(g1, g2, limit, contacts, skip);
  const auto one = std::find_if(colliders.rbegin(), colliders.rend(), [&](const auto& collider) {
    return collider != likely && collider->holds(g1, g2, false);
  });
  return (one != colliders.rend() ? *one : likely)->answer(g1, g2, limit, contacts, skip);
}

}  // namespace ode_ext
