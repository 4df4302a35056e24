// SPDX-License-Identifier: BSD-3-Clause
#include "view/spots.h"

#include <algorithm>
#include <cmath>

namespace view_tests {
namespace {

bool above(int one, int other, int another) { return one > 40 + 3 * std::max(other, another) / 2; }

}  // namespace

bool is_red(const Pixel& p) { return above(p.red, p.green, p.blue); }
bool is_green(const Pixel& p) { return above(p.green, p.red, p.blue); }
bool is_blue(const Pixel& p) { return above(p.blue, p.red, p.green); }

Pixel pixel(const view::Image& image, int x, int y) {
  const auto at = static_cast<std::size_t>(3 * (y * image.size.width + x));
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

int area(const view::Image& image, const Mask& mask) {
  int count = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) count += mask(pixel(image, x, y));
  }
  return count;
}

int spots(const view::Image& image, const Mask& mask, int least) {
  const auto [width, height] = image.size;
  const auto index = [width = width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  std::vector<bool> left(index(0, height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) left[index(x, y)] = mask(pixel(image, x, y));
  }
  int count = 0;
  std::vector<std::array<int, 2>> open;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!left[index(x, y)]) continue;
      int size = 0;
      left[index(x, y)] = false;
      open.push_back({x, y});
      while (!open.empty()) {
        const auto [u, v] = open.back();
        open.pop_back();
        ++size;
        for (const auto& [i, j] : {std::array{u - 1, v}, {u + 1, v}, {u, v - 1}, {u, v + 1}}) {
          if (i < 0 || j < 0 || i >= width || j >= height || !left[index(i, j)]) continue;
          left[index(i, j)] = false;
          open.push_back({i, j});
        }
      }
      count += size >= least;
    }
  }
  return count;
}

bool is_near(const view::Image& image, const Mask& mask, const view::Camera& camera,
             glm::vec3 place, int reach) {
  const auto [width, height] = image.size;
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const glm::vec4 clip = camera.clip_from_world(aspect) * glm::vec4(place, 1);
  const auto at = [](float from_middle, int size) {
    return static_cast<int>(std::lround((from_middle + 1) / 2 * static_cast<float>(size)));
  };
  const int x = at(clip.x / clip.w, width), y = at(-clip.y / clip.w, height);
  for (int j = std::max(0, y - reach); j <= std::min(height - 1, y + reach); ++j) {
    for (int i = std::max(0, x - reach); i <= std::min(width - 1, x + reach); ++i) {
      if (mask(pixel(image, i, j))) return true;
    }
  }
  return false;
}

}  // namespace view_tests
