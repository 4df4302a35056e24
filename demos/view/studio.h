// SPDX-License-Identifier: BSD-3-Clause
// Draws one world, or several side by side, without a screen.
#pragma once

#include <span>
#include <vector>

#include "view/camera.h"
#include "view/canvas.h"
#include "view/frame.h"
#include "view/gui.h"
#include "view/headless_context.h"
#include "view/image.h"
#include "view/renderer.h"

namespace view {

// Equal parts of a picture, from left to right.
std::vector<Viewport> side_by_side(Size size, std::size_t count);

class Studio {
 public:
  // Throws NoPictures.
  explicit Studio(Size size);

  Renderer& renderer() { return renderer_; }
  Size size() const { return canvas_.size(); }
  Image draw(std::span<const Frame> frames, const Camera& camera);

 private:
  HeadlessContext context_;
  Quality quality_;
  Canvas canvas_;
  Renderer renderer_;
  Gui gui_;
};

}  // namespace view
