// SPDX-License-Identifier: BSD-3-Clause
// How much is drawn, by what draws it.
#pragma once

#include <string>

namespace view {

struct Quality {
  int samples = 4;         // of a pixel
  int shadow_size = 2048;  // texels along a side of the shadows
};

// What draws, as the driver calls itself. Needs a current context, as does the next.
std::string renderer_name();

// Where the processor draws, 1,000 objects take it 0.1 s with the least and 0.4 s with the most: a
// film has time, a window has not.
Quality quality_of_driver(bool for_window);

}  // namespace view
