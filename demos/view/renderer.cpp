// SPDX-License-Identifier: BSD-3-Clause
#include "view/renderer.h"

#include <algorithm>
#include <array>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "view/marks.h"
#include "view/shaders.h"
#include "view/simplify.h"

namespace view {
namespace {

const glm::vec3 kToSun = glm::normalize(glm::vec3(0.62F, -0.25F, 0.85F));
constexpr float kSmall = 56;     // [pixels] across, below which nobody sees a mesh's every triangle
constexpr float kHidden = 0.5F;  // opacity of marks behind something

void set(const GlObject& program, const char* name, const glm::mat4& value) {
  glUniformMatrix4fv(uniform(program, name), 1, GL_FALSE, glm::value_ptr(value));
}

void set(const GlObject& program, const char* name, const glm::vec3& value) {
  glUniform3fv(uniform(program, name), 1, glm::value_ptr(value));
}

void set(const GlObject& program, const char* name, float value) {
  glUniform1f(uniform(program, name), value);
}

// Parallel, along the sun's light, around the ball in which shadows fall.
glm::mat4 sun_from_world(const Frame& frame) {
  const float r = frame.radius;
  return glm::ortho(-r, r, -r, r, r, 5 * r) *
         glm::lookAt(frame.center + 3 * r * kToSun, frame.center, glm::vec3(0, 0, 1));
}

// From -1 to 1 to a texture's 0 to 1.
glm::mat4 texture_from_clip() {
  return glm::translate(glm::mat4(1), glm::vec3(0.5F)) * glm::scale(glm::mat4(1), glm::vec3(0.5F));
}

template <class T>
void fill(GLenum target, const std::vector<T>& values, GLenum usage) {
  glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), usage);
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

Renderer::Renderer(const Quality& quality)
    : shadow_size_(quality.shadow_size),
      mesh_program_(make_program(kMeshVertexShader, kMeshFragmentShader)),
      shadow_program_(make_program(kShadowVertexShader, kShadowFragmentShader)),
      sky_program_(make_program(kSkyVertexShader, kSkyFragmentShader)),
      shadow_map_(make_texture()),
      shadow_buffer_(make_framebuffer()),
      instance_buffer_(make_buffer()),
      empty_array_(make_vertex_array()),
      arrow_(make_mesh(arrow_mesh(), true)),
      box_(make_mesh(box_mesh(), false)) {
  glBindTexture(GL_TEXTURE_2D, shadow_map_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, shadow_size_, shadow_size_, 0,
               GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_buffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_map_.id(), 0);
  glDrawBuffer(GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
}

MeshId Renderer::add_mesh(std::span<const glm::vec3> positions, std::span<const unsigned> triangles,
                          bool closed) {
  float radius = 0;
  for (const glm::vec3& p : positions) radius = std::max(radius, glm::length(p));
  kinds_.push_back({make_mesh(shade(positions, triangles), closed),
                    make_mesh(shade(positions, simplify(positions, triangles)), closed), radius});
  return kinds_.size() - 1;
}

Renderer::Mesh Renderer::make_mesh(const ShadedMesh& shaded, bool closed) const {
  Mesh mesh{make_buffer(), make_buffer(), make_vertex_array(), 0, closed};
  glBindVertexArray(mesh.array.id());
  refill(mesh, shaded);
  constexpr GLsizei kStride = sizeof(ShadedMesh::Vertex);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride, nullptr);
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, kStride, offset(sizeof(glm::vec3)));
  for (GLuint i = 0; i <= 6; ++i) glEnableVertexAttribArray(i);
  for (GLuint i = 2; i <= 6; ++i) glVertexAttribDivisor(i, 1);
  return mesh;
}

// Needs the mesh's array bound.
void Renderer::refill(Mesh& mesh, const ShadedMesh& shaded) const {
  glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices.id());
  fill(GL_ARRAY_BUFFER, shaded.vertices, GL_STREAM_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.triangles.id());
  fill(GL_ELEMENT_ARRAY_BUFFER, shaded.triangles, GL_STREAM_DRAW);
  mesh.count = static_cast<GLsizei>(shaded.triangles.size());
}

Renderer::Batches Renderer::queue(const std::vector<Instance>& instances, const Scale& scale) {
  struct Entry {
    const Mesh* mesh;
    const Instance* instance;
  };
  std::vector<Entry> entries;
  for (const Instance& instance : instances) {
    const Kind& kind = kinds_.at(instance.mesh);
    const bool small = 2 * kind.radius * scale(instance.pose[3]) < kSmall;
    entries.push_back({small ? &kind.coarse : &kind.fine, &instance});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return std::less<>()(a.mesh, b.mesh); });
  Batches batches;
  for (const auto& [mesh, instance] : entries) {
    if (batches.empty() || batches.back().mesh != mesh) {
      batches.push_back({mesh, instances_.size(), 0});
    }
    ++batches.back().count;
    instances_.push_back({instance->pose, glm::vec4(instance->color, 1)});
  }
  return batches;
}

Renderer::Batches Renderer::queue_cloths(const std::vector<Cloth>& cloths) {
  while (cloths_.size() < cloths.size()) cloths_.push_back(make_mesh({}, false));
  Batches batches;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    glBindVertexArray(cloths_[i].array.id());
    refill(cloths_[i], shade_smoothly(cloths[i].vertices, cloths[i].triangles));
    batches.push_back({&cloths_[i], instances_.size(), 1});
    instances_.push_back({Pose(1), glm::vec4(cloths[i].color, 1)});
  }
  return batches;
}

Renderer::Batches Renderer::queue_arrows(const std::vector<Arrow>& arrows, float thickness) {
  const Batch batch{&arrow_, instances_.size(), arrows.size()};
  for (const Arrow& arrow : arrows) {
    instances_.push_back({arrow_pose(arrow, thickness), glm::vec4(arrow.color, 1)});
  }
  return {batch};
}

Renderer::Batches Renderer::queue_boxes(const std::vector<Box>& boxes) {
  const Batch batch{&box_, instances_.size(), boxes.size()};
  for (const Box& box : boxes) {
    const glm::vec3 size = box.high - box.low;
    instances_.push_back(
        {Pose(glm::vec3(size.x, 0, 0), glm::vec3(0, size.y, 0), glm::vec3(0, 0, size.z), box.low),
         glm::vec4(box.color, 1)});
  }
  return {batch};
}

Renderer::Batches Renderer::queue_patches(const std::vector<Patch>& patches, bool over_all) {
  while (patches_.size() < patches.size()) patches_.push_back(make_mesh({}, false));
  Batches batches;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches[i].over_all != over_all) continue;
    ShadedMesh mesh;
    for (const glm::vec3& corner : patches[i].corners) {
      mesh.triangles.push_back(static_cast<unsigned>(mesh.vertices.size()));
      mesh.vertices.push_back({corner, glm::vec3(0, 0, 1)});
    }
    glBindVertexArray(patches_[i].array.id());
    refill(patches_[i], mesh);
    batches.push_back({&patches_[i], instances_.size(), 1});
    instances_.push_back({Pose(1), glm::vec4(patches[i].color, 1)});
  }
  return batches;
}

void Renderer::draw_batches(const Batches& batches, GLenum primitive) const {
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.id());
  for (const Batch& batch : batches) {
    if (batch.count == 0 || batch.mesh->count == 0) continue;
    glBindVertexArray(batch.mesh->array.id());
    const std::size_t start = batch.first * sizeof(GpuInstance);
    for (GLuint i = 0; i < 4; ++i) {
      glVertexAttribPointer(2 + i, 3, GL_FLOAT, GL_FALSE, sizeof(GpuInstance),
                            offset(start + i * sizeof(glm::vec3)));
    }
    glVertexAttribPointer(6, 4, GL_FLOAT, GL_FALSE, sizeof(GpuInstance),
                          offset(start + sizeof(Pose)));
    (batch.mesh->closed ? glEnable : glDisable)(GL_CULL_FACE);
    glDrawElementsInstanced(primitive, batch.mesh->count, GL_UNSIGNED_INT, nullptr,
                            static_cast<GLsizei>(batch.count));
  }
}

void Renderer::draw_shadows(const std::vector<Batches>& all,
                            const glm::mat4& clip_from_world) const {
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_buffer_.id());
  glViewport(0, 0, shadow_size_, shadow_size_);
  glClear(GL_DEPTH_BUFFER_BIT);
  glUseProgram(shadow_program_.id());
  set(shadow_program_, "clip_from_world", clip_from_world);
  // Farther than it is, so that no surface throws a shadow on itself.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2.5F, 512.0F);
  for (const Batches& batches : all) draw_batches(batches);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void Renderer::draw_sky() const {
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_CULL_FACE);
  glUseProgram(sky_program_.id());
  glBindVertexArray(empty_array_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::draw(const Frame& frame, const Camera& camera, const Viewport& viewport) {
  GLint canvas = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &canvas);
  instances_.clear();
  const Scale in_picture = [&](glm::vec3 place) {
    return static_cast<float>(std::min(viewport.size.width, viewport.size.height)) /
           camera.extent_at(place);
  };
  const Batches grounds = queue(frame.grounds, in_picture);
  const Batches objects = queue(frame.objects, in_picture);
  const Batches cloths = queue_cloths(frame.cloths), boxes = queue_boxes(frame.boxes);
  const Batches arrows = queue_arrows(frame.arrows, 0.003F * camera.distance);
  const Batches touched = queue_patches(frame.patches, false);
  const Batches over_all = queue_patches(frame.patches, true);
  const Batches shown_through = queue(frame.shown_through, in_picture);
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.id());
  fill(GL_ARRAY_BUFFER, instances_, GL_STREAM_DRAW);

  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  const glm::mat4 sun = sun_from_world(frame);
  // The same triangles as are seen: others would throw shadows on them.
  draw_shadows({objects, cloths}, sun);

  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(canvas));
  const auto [x, y, size] = viewport;
  glViewport(x, y, size.width, size.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, size.width, size.height);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_MULTISAMPLE);

  const glm::mat4 clip_from_world = camera.clip_from_world(viewport.aspect());
  glUseProgram(mesh_program_.id());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shadow_map_.id());
  set(mesh_program_, "clip_from_world", clip_from_world);
  set(mesh_program_, "shadow_from_world", texture_from_clip() * sun);
  set(mesh_program_, "eye", camera.eye());
  set(mesh_program_, "to_sun", kToSun);
  set(mesh_program_, "lit", 1);
  set(mesh_program_, "grid", 0);
  draw_batches(objects);
  draw_batches(cloths);
  set(mesh_program_, "grid", 1);
  draw_batches(grounds);
  draw_sky();

  glUseProgram(mesh_program_.id());
  set(mesh_program_, "lit", 0);
  set(mesh_program_, "grid", 0);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1, -2);
  draw_batches(touched);
  glDisable(GL_POLYGON_OFFSET_FILL);
  draw_batches(boxes, GL_LINES);
  // Arrows point into things: faint through what is in front, then as they are where they are seen.
  // Patches are where things touch, and what is inside something is hidden by it.
  glEnable(GL_BLEND);
  glBlendColor(0, 0, 0, kHidden);
  glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER);
  draw_batches(shown_through);
  draw_batches(over_all);
  draw_batches(arrows);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  draw_batches(over_all);
  set(mesh_program_, "lit", 1);
  draw_batches(arrows);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace view
