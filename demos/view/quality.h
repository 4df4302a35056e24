// SPDX-License-Identifier: BSD-3-Clause
// How much is drawn, by what draws it.
#pragma once

#include <string>

namespace view {

struct Quality {
  int samples = 4;         // of a pixel
  int shadow_size = 2048;  // texels along a side of the shadows
  bool soft_shadows = true;
  float error = 0.35F;  // [pixels] that a mesh may be off by where it is drawn with fewer triangles
};

// What draws, as the driver calls itself. Needs a current context, as does the next.
std::string renderer_name();

// A film has time, a window has not: where the processor draws it, it gets less.
Quality quality_of_driver(bool for_window);

}  // namespace view
