// SPDX-License-Identifier: BSD-3-Clause
// Text and panels over a picture (Dear ImGui), with a window or without one.
#pragma once

#include <string>
#include <vector>

#include "view/image.h"
#include "view/renderer.h"

struct GLFWwindow;

namespace view {

class Gui {
 public:
  // Without a window its pictures are `size` large. `window` may be null.
  Gui(Size size, GLFWwindow* window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void begin();
  // Lines in the top left corner of a viewport of a picture `height` high, the first one larger.
  // Between begin and end.
  void caption(const std::vector<std::string>& lines, const Viewport& viewport, int height);
  // Draws what was said since begin, onto the framebuffer that is bound.
  void end();

 private:
  GLFWwindow* window_;
};

}  // namespace view
