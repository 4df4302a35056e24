// SPDX-License-Identifier: BSD-3-Clause
// A mesh as the graphics card keeps it.
#pragma once

#include "view/frame.h"
#include "view/gl_object.h"
#include "view/shaded_mesh.h"

namespace view {

struct GpuInstance {
  Pose pose;
  glm::vec4 color;
};

class GpuMesh {
 public:
  // `closed`: nobody sees its triangles from behind.
  GpuMesh(const ShadedMesh& shaded, bool closed);

  void refill(const ShadedMesh& shaded);
  bool closed() const { return closed_; }
  bool empty() const { return count_ == 0; }
  // `count` of the instances in a buffer, from `first` on.
  void draw(const GlObject& instances, std::size_t first, std::size_t count,
            GLenum primitive) const;

 private:
  GlObject vertices_, triangles_, array_;
  GLsizei count_ = 0;  // of indices
  bool closed_;
};

}  // namespace view
