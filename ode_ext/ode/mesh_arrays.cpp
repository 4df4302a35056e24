// SPDX-License-Identifier: BSD-3-Clause
#include "ode/mesh_arrays.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace ode_ext {
namespace {

template <class T>
T load(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

// Where in a dTriMeshData each of these is [bytes].
struct Layout {
  std::size_t vertices, vertex_stride, vertex_count;
  std::size_t indices, index_stride, triangle_count;
  std::size_t is_single;
};

using Bytes = std::vector<unsigned char>;

// A mesh of which every number is its own.
class Probe {
 public:
  Probe(std::size_t vertex_count, std::size_t triangle_count, bool is_single)
      : vertex_stride_(static_cast<int>(sizeof(double) * (3 + vertex_count))),
        index_stride_(static_cast<int>(sizeof(dTriIndex) * (3 + triangle_count))),
        vertex_count_(static_cast<int>(vertex_count)),
        triangle_count_(static_cast<int>(triangle_count)),
        is_single_(is_single),
        vertices_(vertex_count * static_cast<std::size_t>(vertex_stride_)),
        indices_(triangle_count * static_cast<std::size_t>(index_stride_)),
        data_(dGeomTriMeshDataCreate()) {
    for (std::size_t v = 0; v < vertex_count; ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) put_coordinate(v, axis);
    for (std::size_t t = 0; t < triangle_count; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto index = static_cast<dTriIndex>((t + k) % vertex_count);
        std::memcpy(&indices_[t * static_cast<std::size_t>(index_stride_) + k * sizeof(index)],
                    &index, sizeof(index));
      }
  }
  ~Probe() { dGeomTriMeshDataDestroy(data_); }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  // What was built of `before` and then of this: what keeps the first arrays is not to be found.
  void build_after(const Probe& before) {
    before.build(data_);
    build(data_);
  }

  bool is_single() const { return is_single_; }

#ifdef __GLIBC__
  Bytes object() const {
    const auto* first = reinterpret_cast<const unsigned char*>(data_);
    return {first, first + malloc_usable_size(data_)};
  }
#endif

  bool has_vertices(const unsigned char* at) const {
    return load<const void*>(at) == vertices_.data();
  }
  bool has_indices(const unsigned char* at) const {
    return load<const void*>(at) == indices_.data();
  }
  bool has_vertex_stride(const unsigned char* at) const { return load<int>(at) == vertex_stride_; }
  bool has_index_stride(const unsigned char* at) const { return load<int>(at) == index_stride_; }
  bool has_vertex_count(const unsigned char* at) const { return load<int>(at) == vertex_count_; }
  bool has_triangle_count(const unsigned char* at) const {
    return load<int>(at) == triangle_count_;
  }
  bool has_kind(const unsigned char* at) const { return *at == (is_single_ ? 1 : 0); }

 private:
  void put_coordinate(std::size_t v, std::size_t axis) {
    unsigned char* to = &vertices_[v * static_cast<std::size_t>(vertex_stride_)];
    const double value = static_cast<double>(v * v + (axis + 1) * v);
    if (is_single_) {
      const auto rounded = static_cast<float>(value);
      std::memcpy(to + axis * sizeof(float), &rounded, sizeof(float));
    } else {
      std::memcpy(to + axis * sizeof(double), &value, sizeof(double));
    }
  }

  void build(dTriMeshDataID data) const {
    const auto build_of = is_single_ ? dGeomTriMeshDataBuildSingle : dGeomTriMeshDataBuildDouble;
    build_of(data, vertices_.data(), vertex_stride_, vertex_count_, indices_.data(),
             3 * triangle_count_, index_stride_);
  }

  int vertex_stride_, index_stride_, vertex_count_, triangle_count_;
  bool is_single_;
  Bytes vertices_, indices_;
  dTriMeshDataID data_;
};

#ifdef __GLIBC__
// The first place, of those on boundaries of `step`, where `has` holds in every object.
template <class Has>
std::optional<std::size_t> place_of(const std::array<const Probe*, 4>& probes,
                                    const std::array<Bytes, 4>& objects, std::size_t size,
                                    Has has) {
  for (std::size_t place = 0;; place += size) {
    bool is_there = true;
    for (std::size_t i = 0; i < probes.size() && is_there; ++i) {
      if (place + size > objects[i].size()) return std::nullopt;
      is_there = (probes[i]->*has)(&objects[i][place]);
    }
    if (is_there) return place;
  }
}

std::optional<Layout> find_layout() {
  // What a program allocates for ODE need not know its size.
  if (dGetAllocHandler() != nullptr) return std::nullopt;
  Probe single(37, 41, true), other_single(43, 47, true);
  Probe plain(53, 59, false), other_plain(61, 67, false);
  single.build_after(other_plain);
  other_single.build_after(single);
  plain.build_after(other_single);
  other_plain.build_after(plain);
  const std::array<const Probe*, 4> probes = {&single, &other_single, &plain, &other_plain};
  std::array<Bytes, 4> objects;
  for (std::size_t i = 0; i < probes.size(); ++i) objects[i] = probes[i]->object();
  const auto place = [&](std::size_t size, auto has) {
    return place_of(probes, objects, size, has);
  };
  const auto vertices = place(sizeof(void*), &Probe::has_vertices);
  const auto vertex_stride = place(sizeof(int), &Probe::has_vertex_stride);
  const auto vertex_count = place(sizeof(int), &Probe::has_vertex_count);
  const auto indices = place(sizeof(void*), &Probe::has_indices);
  const auto index_stride = place(sizeof(int), &Probe::has_index_stride);
  const auto triangle_count = place(sizeof(int), &Probe::has_triangle_count);
  const auto is_single = place(1, &Probe::has_kind);
  if (!vertices || !vertex_stride || !vertex_count || !indices || !index_stride ||
      !triangle_count || !is_single)
    return std::nullopt;
  return Layout{*vertices,     *vertex_stride,  *vertex_count, *indices,
                *index_stride, *triangle_count, *is_single};
}
#else
std::optional<Layout> find_layout() { return std::nullopt; }
#endif

// As ODE turns a corner by its geom's pose, here the identity: -0 becomes 0.
float coordinate(const unsigned char* at, std::size_t axis, bool is_single) {
  return (is_single ? load<float>(at + axis * sizeof(float))
                    : static_cast<float>(load<double>(at + axis * sizeof(double)))) +
         0.0f;
}

template <bool is_single>
bool give_soup(const MeshArrays& arrays, const TriangleSoup& soup) {
  const Vec3f* known = soup.data();
  for (std::size_t t = 0; t < arrays.triangle_count; ++t) {
    const unsigned char* corners = arrays.indices + t * arrays.index_stride;
    for (std::size_t k = 0; k < 3; ++k, ++known) {
      const std::size_t v = load<dTriIndex>(corners + k * sizeof(dTriIndex));
      if (v >= arrays.vertex_count) return false;
      const unsigned char* at = arrays.vertices + v * arrays.vertex_stride;
      const Vec3f corner = {coordinate(at, 0, is_single), coordinate(at, 1, is_single),
                            coordinate(at, 2, is_single)};
      if (std::memcmp(&corner, known, sizeof(corner)) != 0) return false;
    }
  }
  return true;
}

}  // namespace

bool MeshArrays::give(const TriangleSoup& soup) const {
  if (soup.size() != 3 * triangle_count) return false;
  return is_single ? give_soup<true>(*this, soup) : give_soup<false>(*this, soup);
}

std::optional<MeshArrays> arrays_of(dTriMeshDataID data) {
  static const std::optional<Layout> layout = find_layout();
  if (!layout) return std::nullopt;
  const auto* object = reinterpret_cast<const unsigned char*>(data);
  const auto number = [&](std::size_t place) {
    return static_cast<std::size_t>(load<std::uint32_t>(object + place));
  };
  const MeshArrays arrays{load<const unsigned char*>(object + layout->vertices),
                          number(layout->vertex_stride),
                          number(layout->vertex_count),
                          load<const unsigned char*>(object + layout->indices),
                          number(layout->index_stride),
                          number(layout->triangle_count),
                          object[layout->is_single] != 0};
  if (arrays.vertices == nullptr || arrays.indices == nullptr) return std::nullopt;
  return arrays;
}

}  // namespace ode_ext
