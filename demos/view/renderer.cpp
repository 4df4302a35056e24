// SPDX-License-Identifier: BSD-3-Clause
#include "view/renderer.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>
#include <utility>

#include "view/marks.h"
#include "view/shaded_mesh.h"
#include "view/shaders.h"
#include "view/simplify.h"

namespace view {
namespace {

constexpr Color kBorder{0.32F, 0.31F, 0.30F};
constexpr float kHidden = 0.5F;    // opacity of marks behind something
constexpr float kNearWall = 0.2F;  // ... of a ground that is seen from behind, with things in it
constexpr float kGlass = 0.3F;

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
         glm::lookAt(frame.center + 3 * r * frame.to_sun, frame.center, glm::vec3(0, 0, 1));
}

// From -1 to 1 to a texture's 0 to 1.
glm::mat4 texture_from_clip() {
  return glm::translate(glm::mat4(1), glm::vec3(0.5F)) * glm::scale(glm::mat4(1), glm::vec3(0.5F));
}

std::vector<std::string> defined(const Quality& quality, bool grid) {
  std::vector<std::string> names;
  if (quality.soft_shadows) names.emplace_back("SOFT");
  if (grid) names.emplace_back("GRID");
  return names;
}

void set_opacity(float opacity) { glBlendColor(0, 0, 0, opacity); }

void see_through(float opacity) {
  set_opacity(opacity);
  glEnable(GL_BLEND);
  glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
  glDepthMask(GL_FALSE);
}

void cover() {
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

}  // namespace

Renderer::Renderer(const Quality& quality)
    : quality_(quality),
      solid_program_(make_program(kMeshVertexShader, kLitFragmentShader, defined(quality, false))),
      ground_program_(make_program(kMeshVertexShader, kLitFragmentShader, defined(quality, true))),
      flat_program_(make_program(kMeshVertexShader, kFlatFragmentShader)),
      shadow_program_(make_program(kShadowVertexShader, kShadowFragmentShader)),
      sky_program_(make_program(kSkyVertexShader, kSkyFragmentShader)),
      shadow_map_(make_texture()),
      shadow_buffer_(make_framebuffer()),
      instance_buffer_(make_buffer()),
      empty_array_(make_vertex_array()),
      arrow_(arrow_mesh(), true),
      box_(box_mesh(), false) {
  glBindTexture(GL_TEXTURE_2D, shadow_map_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, quality_.shadow_size, quality_.shadow_size,
               0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
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
  Kind kind{{}, GpuMesh(border_of(positions, triangles), false), 0};
  for (const glm::vec3& p : positions) kind.radius = std::max(kind.radius, glm::length(p));
  for (const auto& [some, error] : levels_of(positions, triangles)) {
    kind.details.push_back({GpuMesh(shade(positions, some), closed), error});
  }
  kinds_.push_back(std::move(kind));
  return kinds_.size() - 1;
}

// What is out of sight is left out. What casts a shadow has the triangles that are seen: others
// would throw shadows on them.
Renderer::Batches Renderer::queue(const std::vector<Instance>& instances, const Sight& sight,
                                  const Sight& seen) {
  struct Entry {
    MeshId kind;
    std::size_t detail;
    const Instance* instance;
  };
  std::vector<Entry> entries;
  entries.reserve(instances.size());
  for (const Instance& instance : instances) {
    const Kind& kind = kinds_.at(instance.mesh);
    const Pose& pose = instance.pose;
    const float size = std::max({glm::length(pose[0]), glm::length(pose[1]), glm::length(pose[2])});
    const float radius = size * kind.radius;
    if (!sight.sees(pose[3], radius)) continue;
    const Sight& judge = seen.sees(pose[3], radius) ? seen : sight;
    const float allowed = quality_.error / (size * judge.pixels_per_meter(pose[3], radius));
    std::size_t detail = 0;
    while (detail + 1 < kind.details.size() && kind.details[detail + 1].error <= allowed) ++detail;
    entries.push_back({instance.mesh, detail, &instance});
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.kind, a.detail) < std::pair(b.kind, b.detail);
  });
  Batches batches;
  for (const auto& [kind, detail, instance] : entries) {
    const GpuMesh* mesh = &kinds_[kind].details[detail].mesh;
    if (batches.empty() || batches.back().mesh != mesh) {
      batches.push_back({mesh, instances_.size(), 0});
    }
    ++batches.back().count;
    instances_.push_back({instance->pose, glm::vec4(instance->color, 1)});
  }
  return batches;
}

Renderer::Batches Renderer::queue_borders(const std::vector<Instance>& instances) {
  Batches batches;
  for (const Instance& instance : instances) {
    batches.push_back({&kinds_.at(instance.mesh).border, instances_.size(), 1});
    instances_.push_back({instance.pose, glm::vec4(kBorder, 1)});
  }
  return batches;
}

Renderer::Batches Renderer::queue_cloths(const std::vector<Cloth>& cloths) {
  while (cloths_.size() < cloths.size()) cloths_.emplace_back(ShadedMesh{}, false);
  Batches batches;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    cloths_[i].refill(shade_smoothly(cloths[i].vertices, cloths[i].triangles));
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
  while (patches_.size() < patches.size()) patches_.emplace_back(ShadedMesh{}, false);
  Batches batches;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches[i].over_all != over_all) continue;
    ShadedMesh mesh;
    for (const glm::vec3& corner : patches[i].corners) {
      mesh.triangles.push_back(static_cast<unsigned>(mesh.vertices.size()));
      mesh.vertices.push_back({corner, glm::vec3(0, 0, 1)});
    }
    patches_[i].refill(mesh);
    batches.push_back({&patches_[i], instances_.size(), 1});
    instances_.push_back({Pose(1), glm::vec4(patches[i].color, 1)});
  }
  return batches;
}

void Renderer::draw_batches(const Batches& batches, GLenum primitive) const {
  for (const Batch& batch : batches) {
    if (batch.count == 0 || batch.mesh->empty()) continue;
    (batch.mesh->closed() ? glEnable : glDisable)(GL_CULL_FACE);
    batch.mesh->draw(instance_buffer_, batch.first, batch.count, primitive);
  }
}

void Renderer::draw_shadows(const std::vector<Batches>& all,
                            const glm::mat4& clip_from_world) const {
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_buffer_.id());
  glViewport(0, 0, quality_.shadow_size, quality_.shadow_size);
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
  const glm::mat4 clip_from_world = camera.clip_from_world(viewport.aspect());
  const glm::mat4 sun = sun_from_world(frame);
  const Sight seen(clip_from_world, viewport.size);
  const Sight lit(sun, {quality_.shadow_size, quality_.shadow_size});
  const Batches grounds = queue(frame.grounds, seen, seen);
  const Batches objects = queue(frame.objects, seen, seen);
  const Batches borders = queue_borders(frame.grounds);
  const Batches glass = queue(frame.glass, seen, seen);
  // A bowl and hills would throw more on themselves than on others.
  std::vector<Instance> whole_grounds;
  std::copy_if(frame.grounds.begin(), frame.grounds.end(), std::back_inserter(whole_grounds),
               [&](const Instance& ground) { return kinds_.at(ground.mesh).border.empty(); });
  std::vector<Batches> casting{queue_cloths(frame.cloths)};
  for (const std::vector<Instance>* some :
       {&frame.objects, &frame.glass, &std::as_const(whole_grounds)}) {
    casting.push_back(queue(*some, lit, seen));
  }
  const Batches cloths = casting.front(), boxes = queue_boxes(frame.boxes);
  const Batches arrows = queue_arrows(frame.arrows, 0.003F * camera.distance);
  const Batches touched = queue_patches(frame.patches, false);
  const Batches over_all = queue_patches(frame.patches, true);
  const Batches shown_through = queue(frame.shown_through, seen, seen);
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances_.size() * sizeof(GpuInstance)),
               instances_.data(), GL_STREAM_DRAW);

  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  draw_shadows(casting, sun);

  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(canvas));
  const auto [x, y, size] = viewport;
  glViewport(x, y, size.width, size.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, size.width, size.height);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_MULTISAMPLE);

  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shadow_map_.id());
  for (const GlObject* program : {&flat_program_, &ground_program_, &solid_program_}) {
    glUseProgram(program->id());
    set(*program, "clip_from_world", clip_from_world);
    set(*program, "shadow_from_world", texture_from_clip() * sun);
    set(*program, "eye", camera.eye());
    set(*program, "pixel", seen.pixel_at_depth_one());
    set(*program, "to_sun", frame.to_sun);
  }
  draw_batches(objects);
  draw_batches(cloths);
  glUseProgram(ground_program_.id());
  draw_batches(grounds);
  draw_sky();

  // The near wall of a bowl: nothing behind it would be seen if it were drawn as it is.
  glDepthFunc(GL_LESS);
  glUseProgram(ground_program_.id());
  see_through(kNearWall);
  glCullFace(GL_FRONT);
  draw_batches(grounds);
  glUseProgram(solid_program_.id());
  set_opacity(kGlass);
  draw_batches(glass);
  glCullFace(GL_BACK);
  draw_batches(glass);
  cover();

  glUseProgram(flat_program_.id());
  draw_batches(borders, GL_LINES);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1, -2);
  draw_batches(touched);
  glDisable(GL_POLYGON_OFFSET_FILL);
  draw_batches(boxes, GL_LINES);
  // Arrows point into things: faint through what is in front, then as they are where they are seen.
  // Patches are where things touch, and what is inside something is hidden by it.
  see_through(kHidden);
  glDepthFunc(GL_GREATER);
  draw_batches(shown_through);
  draw_batches(over_all);
  draw_batches(arrows);
  cover();
  glDepthFunc(GL_LESS);
  draw_batches(over_all);
  glUseProgram(solid_program_.id());
  draw_batches(arrows);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace view
