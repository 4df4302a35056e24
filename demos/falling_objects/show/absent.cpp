// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show.h"
#include "falling_objects/usage_error.h"

namespace falling_objects {
namespace {

[[noreturn]] void refuse() {
  throw UsageError(
      "this falling_objects draws nothing: libepoxy-dev, libglm-dev, libstb-dev, libimgui-dev, "
      "libmeshoptimizer-dev and libglfw3-dev were not all there when it was built "
      "(scripts/install-packages installs them)");
}

}  // namespace

std::unique_ptr<Spectator> make_film(const World& world) {
  if (world.options().pictures.has_film()) refuse();
  return nullptr;
}

bool can_show_window() { return false; }

int show_window(const Options&) { refuse(); }

}  // namespace falling_objects
