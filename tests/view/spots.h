// SPDX-License-Identifier: BSD-3-Clause
// What is in a picture: spots of one color, and where they are.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "view/camera.h"
#include "view/image.h"

namespace view_tests {

struct Pixel {
  int red, green, blue;
};

using Mask = std::function<bool(const Pixel&)>;

// One of its channels far above the others.
bool is_red(const Pixel& p);
bool is_green(const Pixel& p);
bool is_blue(const Pixel& p);

Pixel pixel(const view::Image& image, int x, int y);

// How many pixels.
int area(const view::Image& image, const Mask& mask);

// How many pieces that hang together (by their sides) of at least `least` pixels.
int spots(const view::Image& image, const Mask& mask, int least = 4);

// Whether any pixel is within `reach` of where a place of the world is seen.
bool is_near(const view::Image& image, const Mask& mask, const view::Camera& camera,
             glm::vec3 place, int reach);

}  // namespace view_tests
