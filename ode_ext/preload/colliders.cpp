// SPDX-License-Identifier: BSD-3-Clause
#include "preload/colliders.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <string>

#include "api/params.h"
#include "ode/messages.h"
#include "ode/registry.h"
#include "ode_ext/ode_ext.h"

namespace ode_ext {
namespace {

// To find a collider that other threads leave free. Each has its own soon, so one is mostly enough.
constexpr int kAttempts = 16;

std::atomic<bool> cannot_create{false};
std::atomic<double> seconds{0};

// What a program would say in code: settings of the environment.
struct Settings {
  dBatchColliderParams params;
  std::string wrong;  // what of it is no setting, or ""

  Settings() {
    dBatchColliderParamsInit(&params);
    params.max_contacts =
        number("ODE_EXT_MAX_CONTACTS", params.max_contacts, 1, static_cast<int>(kMaxContacts));
    params.trust_meshes = number("ODE_EXT_TRUST_MESHES", 0, 0, 1);
    params.config = std::getenv("ODE_EXT_CONFIG");
  }

 private:
  int number(const char* name, int otherwise, int least, int most) {
    const char* text = std::getenv(name);
    if (text == nullptr || *text == '\0') return otherwise;
    char* end = nullptr;
    const long value = std::strtol(text, &end, 10);
    if (*end == '\0' && value >= least && value <= most) return static_cast<int>(value);
    wrong = std::string(name) + " is '" + text + "', expected " + std::to_string(least) + " to " +
            std::to_string(most);
    return otherwise;
  }
};

// Null: it cannot be, which is said once and not tried again; or there is one, `only_the_first`.
dBatchColliderID create(bool only_the_first = false) {
  static std::mutex one_at_a_time;
  const HeldMessages held;
  const std::lock_guard lock(one_at_a_time);
  if (cannot_create || (only_the_first && !live_colliders().empty())) return nullptr;
  const auto start = std::chrono::steady_clock::now();
  const Settings settings;
  const dBatchColliderID collider =
      settings.wrong.empty() ? dBatchColliderCreate(&settings.params) : nullptr;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  seconds = seconds + took.count();
  if (collider == nullptr) {
    cannot_create = true;
    std::string why = settings.wrong.empty() ? dBatchColliderGetLastErrorMessage() : settings.wrong;
    while (why.ends_with('\n') || why.ends_with('.')) why.pop_back();
    // A list of devices has a line each.
    why += why.find('\n') == std::string::npos ? ". " : "\n";
    log(LogLevel::kError, why + "The program goes on with ODE's own collider.");
  }
  return collider;
}

dBatchColliderID handle_of(const std::shared_ptr<BatchCollider>& collider) {
  return reinterpret_cast<dBatchColliderID>(collider.get());
}

// As dBatchColliderSpaceCollide. -1: another thread passes with this collider, or memory is short.
int collide_by(dBatchColliderID collider, const PassRoot& root, void* data,
               dNearCallback* callback) {
  return root.second == nullptr
             ? dBatchColliderSpaceCollide(collider, reinterpret_cast<dSpaceID>(root.first), data,
                                          callback)
             : dBatchColliderSpaceCollide2(collider, root.first, root.second, data, callback);
}

}  // namespace

bool collide_by_a_free_collider(const PassRoot& root, void* data, dNearCallback* callback) {
  // The one this thread had last: it is passing with it, or what it knows is of this thread's
  // spaces.
  thread_local dBatchColliderID last = nullptr;
  const auto try_it = [&](dBatchColliderID collider) {
    const dBatchColliderID before = last;
    last = collider;  // already during the pass, whose callback may make others
    const int result = collide_by(collider, root, data, callback);
    if (result != 1) last = before;
    return result;
  };
  if (last != nullptr) {
    const int result = try_it(last);
    if (result >= 0) return result == 1;
  }
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    bool all_are_passing = true;
    for (const auto& collider : live_colliders()) {
      if (collider->is_passing()) continue;  // to try it would be to wait for its batch
      const int result = try_it(handle_of(collider));
      if (result >= 0) return result == 1;
      all_are_passing = all_are_passing && collider->is_passing();
    }
    if (!all_are_passing) continue;  // one came free meanwhile
    const dBatchColliderID another = create();
    if (another == nullptr) return false;
    const int result = try_it(another);
    if (result >= 0) return result == 1;
  }
  return false;
}

void have_a_collider() {
  if (live_colliders().empty() && !cannot_create) create(true);
}

double seconds_of_starting() { return seconds; }

}  // namespace ode_ext
