// SPDX-License-Identifier: BSD-3-Clause
// Draws a frame: all objects of a mesh at once, in sun and shadow.
#pragma once

#include <span>
#include <vector>

#include "view/camera.h"
#include "view/frame.h"
#include "view/gl_object.h"
#include "view/gpu_mesh.h"
#include "view/image.h"
#include "view/quality.h"
#include "view/sight.h"

namespace view {

// Pixels from the bottom left.
struct Viewport {
  int x = 0, y = 0;
  Size size;
  float aspect() const { return static_cast<float>(size.width) / static_cast<float>(size.height); }
};

class Renderer {
 public:
  // Needs a current context of OpenGL 3.3, as all else here.
  explicit Renderer(const Quality& quality);

  // `closed`: nobody sees its triangles from behind.
  MeshId add_mesh(std::span<const glm::vec3> positions, std::span<const unsigned> triangles,
                  bool closed);

  // Onto the framebuffer that is bound.
  void draw(const Frame& frame, const Camera& camera, const Viewport& viewport);

 private:
  // Instances of one mesh that follow one another in the buffer.
  struct Batch {
    const GpuMesh* mesh;
    std::size_t first, count;
  };
  using Batches = std::vector<Batch>;
  // A mesh as it is, and with fewer triangles for where it is small in the picture.
  struct Detail {
    GpuMesh mesh;
    float error;  // [m] that it is off by
  };
  struct Kind {
    std::vector<Detail> details;  // the finest first
    GpuMesh border;               // lines
    float radius;                 // [m] about its origin
  };

  Batches queue(const std::vector<Instance>& instances, const Sight& sight, const Sight& seen);
  Batches queue_borders(const std::vector<Instance>& instances);
  Batches queue_cloths(const std::vector<Cloth>& cloths);
  Batches queue_arrows(const std::vector<Arrow>& arrows, float thickness);
  Batches queue_boxes(const std::vector<Box>& boxes);
  Batches queue_patches(const std::vector<Patch>& patches, bool over_all);
  void draw_batches(const Batches& batches, GLenum primitive = GL_TRIANGLES) const;
  void draw_shadows(const std::vector<Batches>& all, const glm::mat4& clip_from_world) const;
  void draw_sky() const;

  Quality quality_;
  GlObject solid_program_, ground_program_, flat_program_, shadow_program_, sky_program_;
  GlObject shadow_map_, shadow_buffer_;
  GlObject instance_buffer_, empty_array_;
  std::vector<Kind> kinds_;
  GpuMesh arrow_, box_;
  std::vector<GpuMesh> cloths_, patches_;  // filled anew for each frame
  std::vector<GpuInstance> instances_;     // of the frame that is being drawn
};

}  // namespace view
