// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/measured_world.h"

#include <algorithm>
#include <cmath>

#include "falling_objects/usage_error.h"

namespace falling_objects {

StepRecord MeasuredWorld::step() {
  StepRecord record = world_.step();
  const int every = std::max(1, static_cast<int>(std::lround(0.1 * world_.options().hz)));
  if ((record.step + 1) % every == 0 && meter_.measures_any()) {
    record.deepest_penetration = meter_.measure().deepest;
  }
  return record;
}

Options options_beside(const Options& options) {
  if (options.has_sheets()) {
    throw UsageError("--beside ode: ODE's own collider knows no sheets with two sides");
  }
  if (options.collider == Collider::kOde) {
    throw UsageError("--beside ode: --collider ode would be on both sides");
  }
  if (!ode_exports_its_collider()) {
    throw UsageError("--beside ode: this ODE does not export its own trimesh collider");
  }
  Options beside = options;
  beside.collider = Collider::kOde;
  beside.compare = false;
  return beside;
}

}  // namespace falling_objects
