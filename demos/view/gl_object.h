// SPDX-License-Identifier: BSD-3-Clause
// Names of OpenGL that are given back when they go out of scope. The context they were made in must
// be current then.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <utility>
#include <vector>

namespace view {

class GlObject {
 public:
  using Free = void (*)(GLuint);

  GlObject() = default;
  GlObject(GLuint id, Free free) : id_(id), free_(free) {}
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)), free_(other.free_) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(free_, other.free_);
    return *this;
  }
  ~GlObject() {
    if (id_ != 0) free_(id_);
  }

  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
  Free free_ = nullptr;
};

GlObject make_buffer();
GlObject make_vertex_array();
GlObject make_texture();
GlObject make_renderbuffer();
GlObject make_framebuffer();

// Throws std::runtime_error with what the driver's compiler says.
GlObject make_program(const char* vertex_shader, const char* fragment_shader,
                      const std::vector<std::string>& defined = {});

GLint uniform(const GlObject& program, const char* name);

}  // namespace view
