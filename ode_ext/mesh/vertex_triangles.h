// SPDX-License-Identifier: BSD-3-Clause
// Which triangles are at a vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "mesh/triangle.h"

namespace ode_ext {

class VertexTriangles {
 public:
  VertexTriangles() = default;
  VertexTriangles(std::size_t vertex_count, const std::vector<Triangle>& triangles);

  // Ascending.
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(triangles_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
  }

 private:
  std::vector<std::uint32_t> starts_, triangles_;
};

// Made when they are first asked for, by whichever thread; few programs need them. A copy makes its
// own.
class LazyVertexTriangles {
 public:
  LazyVertexTriangles() = default;
  LazyVertexTriangles(const LazyVertexTriangles&) {}
  LazyVertexTriangles& operator=(const LazyVertexTriangles&) = delete;

  // The same triangles at every call.
  const VertexTriangles& of(std::size_t vertex_count,
                            const std::vector<Triangle>& triangles) const {
    std::call_once(once_, [&] { made_ = {vertex_count, triangles}; });
    return made_;
  }

 private:
  mutable std::once_flag once_;
  mutable VertexTriangles made_;
};

}  // namespace ode_ext
