// SPDX-License-Identifier: BSD-3-Clause
// What is drawn on: four samples a pixel, made one before the picture is read or shown.
#pragma once

#include "view/gl_object.h"
#include "view/image.h"

namespace view {

class Canvas {
 public:
  explicit Canvas(Size size);

  Size size() const { return size_; }
  void begin();  // what is drawn from here on is drawn here
  // Makes one sample of four. What is drawn from here on is drawn over the picture, pixel by pixel.
  void resolve();
  Image read() const;
  // Copies the picture to the window of the current context.
  void show() const;

 private:
  Size size_;
  GlObject color_, depth_, samples_;
  GlObject resolved_color_, resolved_;
};

}  // namespace view
