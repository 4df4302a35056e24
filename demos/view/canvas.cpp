// SPDX-License-Identifier: BSD-3-Clause
#include "view/canvas.h"

#include <algorithm>
#include <stdexcept>

namespace view {
namespace {

GlObject make_storage(GLenum format, GLsizei samples, Size size) {
  GlObject storage = make_renderbuffer();
  glBindRenderbuffer(GL_RENDERBUFFER, storage.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size.width, size.height);
  return storage;
}

void attach(GLenum point, const GlObject& storage) {
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, storage.id());
}

}  // namespace

Canvas::Canvas(Size size, int samples)
    : size_(size),
      color_(make_storage(GL_RGBA8, samples > 1 ? samples : 0, size)),
      depth_(make_storage(GL_DEPTH_COMPONENT24, samples > 1 ? samples : 0, size)),
      samples_(make_framebuffer()),
      resolved_color_(make_storage(GL_RGBA8, 0, size)),
      resolved_(make_framebuffer()) {
  glBindFramebuffer(GL_FRAMEBUFFER, samples_.id());
  attach(GL_COLOR_ATTACHMENT0, color_);
  attach(GL_DEPTH_ATTACHMENT, depth_);
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
  attach(GL_COLOR_ATTACHMENT0, resolved_color_);
  if (!complete || glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("no room for a picture of " + std::to_string(size.width) + "x" +
                             std::to_string(size.height) + " pixels");
  }
}

void Canvas::begin() { glBindFramebuffer(GL_FRAMEBUFFER, samples_.id()); }

void Canvas::resolve() {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, samples_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
  glViewport(0, 0, size_.width, size_.height);
}

Image Canvas::read() const {
  const std::size_t row = 3 * static_cast<std::size_t>(size_.width);
  const auto rows = static_cast<std::size_t>(size_.height);
  Image image{size_, std::vector<std::uint8_t>(row * rows)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size_.width, size_.height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  for (std::size_t i = 0; i < rows / 2; ++i) {  // OpenGL begins at the bottom
    const auto from = image.rgb.begin() + static_cast<std::ptrdiff_t>(i * row);
    std::swap_ranges(from, from + static_cast<std::ptrdiff_t>(row),
                     image.rgb.begin() + static_cast<std::ptrdiff_t>((rows - 1 - i) * row));
  }
  return image;
}

void Canvas::show() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace view
