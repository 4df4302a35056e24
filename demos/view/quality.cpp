// SPDX-License-Identifier: BSD-3-Clause
#include "view/quality.h"

#include <epoxy/gl.h>

namespace view {

std::string renderer_name() { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

Quality quality_of_driver(bool for_window) {
  const std::string name = renderer_name();
  for (const char* on_processor : {"llvmpipe", "softpipe", "swrast", "SWR"}) {
    if (name.find(on_processor) == std::string::npos) continue;
    return for_window ? Quality{1, 768, false, 1} : Quality{4, 1024, true, 0.5F};
  }
  return {};
}

}  // namespace view
