// SPDX-License-Identifier: BSD-3-Clause
// What is drawn on: several samples a pixel, made one before the picture is read or shown.
#pragma once

#include "view/gl_object.h"
#include "view/image.h"

namespace view {

class Canvas {
 public:
  Canvas(Size size, int samples);

  Size size() const { return size_; }
  void begin();  // what is drawn from here on is drawn here
  // Makes one sample of several. What is drawn from here on is drawn over the picture.
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
