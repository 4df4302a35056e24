// SPDX-License-Identifier: BSD-3-Clause
#include "view/studio.h"

namespace view {

std::vector<Viewport> side_by_side(Size size, std::size_t count) {
  std::vector<Viewport> parts;
  const auto edge = [&](std::size_t i) {
    return static_cast<int>(static_cast<std::size_t>(size.width) * i / count);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const int gap = i + 1 < count ? 2 : 0;  // [pixels]
    parts.push_back({edge(i), 0, {edge(i + 1) - edge(i) - gap, size.height}});
  }
  return parts;
}

Studio::Studio(Size size)
    : quality_(quality_of_driver(false)),
      canvas_(size, quality_.samples),
      renderer_(quality_),
      gui_(size, nullptr) {}

Image Studio::draw(std::span<const Frame> frames, const Camera& camera) {
  const auto parts = side_by_side(canvas_.size(), frames.size());
  canvas_.begin();
  glClearColor(1, 1, 1, 1);  // between the parts
  glClear(GL_COLOR_BUFFER_BIT);
  for (std::size_t i = 0; i < frames.size(); ++i) renderer_.draw(frames[i], camera, parts[i]);
  canvas_.resolve();
  gui_.begin();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    gui_.caption(frames[i].caption, parts[i], canvas_.size().height);
  }
  gui_.end();
  return canvas_.read();
}

}  // namespace view
