// SPDX-License-Identifier: BSD-3-Clause
#include "view/gpu_mesh.h"

namespace view {
namespace {

template <class T>
void fill(GLenum target, const std::vector<T>& values) {
  glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(),
               GL_STREAM_DRAW);
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

GpuMesh::GpuMesh(const ShadedMesh& shaded, bool closed)
    : vertices_(make_buffer()),
      triangles_(make_buffer()),
      array_(make_vertex_array()),
      closed_(closed) {
  refill(shaded);
  constexpr GLsizei kStride = sizeof(ShadedMesh::Vertex);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride, nullptr);
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, kStride, offset(sizeof(glm::vec3)));
  for (GLuint i = 0; i <= 6; ++i) glEnableVertexAttribArray(i);
  for (GLuint i = 2; i <= 6; ++i) glVertexAttribDivisor(i, 1);
}

void GpuMesh::refill(const ShadedMesh& shaded) {
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  fill(GL_ARRAY_BUFFER, shaded.vertices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.id());
  fill(GL_ELEMENT_ARRAY_BUFFER, shaded.triangles);
  count_ = static_cast<GLsizei>(shaded.triangles.size());
}

void GpuMesh::draw(const GlObject& instances, std::size_t first, std::size_t count,
                   GLenum primitive) const {
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, instances.id());
  const std::size_t start = first * sizeof(GpuInstance);
  for (GLuint i = 0; i < 4; ++i) {
    glVertexAttribPointer(2 + i, 3, GL_FLOAT, GL_FALSE, sizeof(GpuInstance),
                          offset(start + i * sizeof(glm::vec3)));
  }
  glVertexAttribPointer(6, 4, GL_FLOAT, GL_FALSE, sizeof(GpuInstance),
                        offset(start + sizeof(Pose)));
  glDrawElementsInstanced(primitive, count_, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(count));
}

}  // namespace view
