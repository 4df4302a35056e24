// SPDX-License-Identifier: BSD-3-Clause
#include "ode/mesh_arrays.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "ode/messages.h"
#include "ode/read_triangle.h"

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

// How far they are looked for: ODE 0.16 has them in the first 40 bytes, and every ODE's data are
// larger than this.
constexpr std::size_t kSearched = 48;  // [bytes]

MeshArrays arrays_at(const Layout& layout, const unsigned char* object) {
  const auto number = [&](std::size_t place) {
    return static_cast<std::size_t>(load<std::uint32_t>(object + place));
  };
  return {load<const unsigned char*>(object + layout.vertices),
          number(layout.vertex_stride),
          number(layout.vertex_count),
          load<const unsigned char*>(object + layout.indices),
          number(layout.index_stride),
          number(layout.triangle_count),
          object[layout.is_single] != 0};
}

// A mesh of which every number is its own.
class Probe {
 public:
  Probe(std::size_t vertex_count, std::size_t triangle_count, bool is_single)
      : vertices_(vertex_count * sizeof(double) * (3 + vertex_count)),
        indices_(triangle_count * sizeof(dTriIndex) * (3 + triangle_count)),
        arrays_{vertices_.data(), vertices_.size() / vertex_count,  vertex_count,
                indices_.data(),  indices_.size() / triangle_count, triangle_count,
                is_single},
        data_(dGeomTriMeshDataCreate()) {
    for (std::size_t v = 0; v < vertex_count; ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) put_coordinate(v, axis);
    TriangleSoup soup;
    for (std::size_t t = 0; t < triangle_count; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto index = static_cast<dTriIndex>((t + k) % vertex_count);
        std::memcpy(&indices_[t * arrays_.index_stride + k * sizeof(index)], &index, sizeof(index));
        soup.push_back({coordinate_of(index, 0), coordinate_of(index, 1), coordinate_of(index, 2)});
      }
    source_ = std::move(soup);
  }
  ~Probe() { dGeomTriMeshDataDestroy(data_); }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  // What was built of `before` and then of this: what keeps the first arrays is not to be found.
  void build_after(const Probe& before) const {
    before.build(data_);
    build(data_);
  }

  bool has_vertices(std::size_t place) const { return at<const void*>(place) == arrays_.vertices; }
  bool has_indices(std::size_t place) const { return at<const void*>(place) == arrays_.indices; }
  bool has_vertex_stride(std::size_t place) const { return is(place, arrays_.vertex_stride); }
  bool has_index_stride(std::size_t place) const { return is(place, arrays_.index_stride); }
  bool has_vertex_count(std::size_t place) const { return is(place, arrays_.vertex_count); }
  bool has_triangle_count(std::size_t place) const { return is(place, arrays_.triangle_count); }
  bool has_kind(std::size_t place) const {
    return at<unsigned char>(place) == (arrays_.is_single ? 1 : 0);
  }

  bool is_read_by(const Layout& layout) const {
    const MeshArrays found = arrays_at(layout, object());
    return found.is_single == arrays_.is_single && found.vertices == arrays_.vertices &&
           found.give(source_) && is_given_by_ode();
  }

 private:
  const unsigned char* object() const { return reinterpret_cast<const unsigned char*>(data_); }
  template <class T>
  T at(std::size_t place) const {
    return load<T>(object() + place);
  }
  bool is(std::size_t place, std::size_t number) const {
    return at<std::uint32_t>(place) == number;
  }

  bool is_given_by_ode() const {
    const dGeomID geom = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
    TriangleSoup soup(source_.size());
    for (std::size_t t = 0; t < arrays_.triangle_count; ++t) read_triangle(geom, t, &soup[3 * t]);
    dGeomDestroy(geom);
    return compare_soups(soup, source_) == 0;
  }

  // No float and no half of a double is like another, but for the first vertex.
  static float coordinate_of(std::size_t v, std::size_t axis) {
    return static_cast<float>(v * v + (axis + 1) * v) + 0.25f;
  }
  void put_coordinate(std::size_t v, std::size_t axis) {
    unsigned char* to = &vertices_[v * arrays_.vertex_stride];
    const float rounded = coordinate_of(v, axis);
    const double value = rounded * (1 + 0x1p-30);  // is rounded
    if (arrays_.is_single)
      std::memcpy(to + axis * sizeof(rounded), &rounded, sizeof(rounded));
    else
      std::memcpy(to + axis * sizeof(value), &value, sizeof(value));
  }

  void build(dTriMeshDataID data) const {
    const auto build_of =
        arrays_.is_single ? dGeomTriMeshDataBuildSingle : dGeomTriMeshDataBuildDouble;
    build_of(data, arrays_.vertices, static_cast<int>(arrays_.vertex_stride),
             static_cast<int>(arrays_.vertex_count), arrays_.indices,
             static_cast<int>(3 * arrays_.triangle_count), static_cast<int>(arrays_.index_stride));
  }

  std::vector<unsigned char> vertices_, indices_;
  MeshArrays arrays_;
  SourceTriangles source_;
  dTriMeshDataID data_;
};

using Probes = std::array<const Probe*, 4>;

// Finds places one after the other, each in what those before it have left: a byte of an address
// may be 1 or 0 in every probe, as its mesh is single or not.
class PlaceFinder {
 public:
  explicit PlaceFinder(const Probes& probes) : probes_(probes) {}

  // The first place, of those on boundaries of `size`, where `has` holds in every probe.
  template <class Has>
  std::optional<std::size_t> place_of(std::size_t size, Has has) {
    for (std::size_t place = 0; place + size <= kSearched; place += size) {
      bool is_there = true;
      for (std::size_t i = 0; i < size; ++i) is_there = is_there && !is_taken_[place + i];
      for (const Probe* probe : probes_) is_there = is_there && (probe->*has)(place);
      if (!is_there) continue;
      for (std::size_t i = 0; i < size; ++i) is_taken_[place + i] = true;
      return place;
    }
    return std::nullopt;
  }

 private:
  const Probes& probes_;
  std::array<bool, kSearched> is_taken_{};
};

std::optional<Layout> find_layout() {
  const Probe single(37, 41, true), other_single(43, 47, true);
  const Probe plain(53, 59, false), other_plain(61, 67, false);
  single.build_after(other_plain);
  other_single.build_after(single);
  plain.build_after(other_single);
  other_plain.build_after(plain);
  const Probes probes = {&single, &other_single, &plain, &other_plain};
  PlaceFinder finder(probes);
  const auto vertices = finder.place_of(sizeof(void*), &Probe::has_vertices);
  const auto vertex_stride = finder.place_of(sizeof(int), &Probe::has_vertex_stride);
  const auto vertex_count = finder.place_of(sizeof(int), &Probe::has_vertex_count);
  const auto indices = finder.place_of(sizeof(void*), &Probe::has_indices);
  const auto index_stride = finder.place_of(sizeof(int), &Probe::has_index_stride);
  const auto triangle_count = finder.place_of(sizeof(int), &Probe::has_triangle_count);
  const auto is_single = finder.place_of(1, &Probe::has_kind);
  if (!vertices || !vertex_stride || !vertex_count || !indices || !index_stride ||
      !triangle_count || !is_single)
    return std::nullopt;
  const Layout layout{*vertices,     *vertex_stride,  *vertex_count, *indices,
                      *index_stride, *triangle_count, *is_single};
  for (const Probe* probe : probes)
    if (!probe->is_read_by(layout)) return std::nullopt;
  return layout;
}

std::optional<Layout> find_layout_and_say() {
  const std::optional<Layout> layout = find_layout();
  if (!layout)
    log(LogLevel::kInfo,
        "this ODE does not show where it keeps the arrays of meshes; to compare meshes with what "
        "they were takes longer");
  return layout;
}

// As ODE turns a corner by its geom's pose, here the identity: -0 becomes 0.
template <class Real>
float coordinate(const unsigned char* at, std::size_t axis) {
  return static_cast<float>(load<Real>(at + axis * sizeof(Real))) + 0.0f;
}

template <class Real>
Vec3f place(const unsigned char* at) {
  return {coordinate<Real>(at, 0), coordinate<Real>(at, 1), coordinate<Real>(at, 2)};
}

Vec3f place(const MeshArrays& arrays, std::size_t vertex) {
  const unsigned char* at = arrays.vertices + vertex * arrays.vertex_stride;
  return arrays.is_single ? place<float>(at) : place<double>(at);
}

std::uint32_t corner(const MeshArrays& arrays, std::size_t i) {
  return load<dTriIndex>(arrays.indices + i / 3 * arrays.index_stride + i % 3 * sizeof(dTriIndex));
}

bool has_corners(const MeshArrays& arrays, const std::vector<std::uint32_t>& corners) {
  if (corners.empty()) return true;
  if (sizeof(dTriIndex) == sizeof(std::uint32_t) && arrays.index_stride == 3 * sizeof(dTriIndex))
    return std::memcmp(arrays.indices, corners.data(), corners.size() * sizeof(dTriIndex)) == 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corner(arrays, i) != corners[i]) return false;
  return true;
}

// Looked at in blocks, of which a compiler makes vectors where nothing lies between vertices.
template <class Real>
bool has_places(const MeshArrays& arrays, const std::vector<Vec3f>& places) {
  constexpr std::size_t kBlock = 32;  // vertices
  const bool is_dense = arrays.vertex_stride == 3 * sizeof(Real);
  std::size_t v = 0;
  for (; is_dense && v + kBlock <= places.size(); v += kBlock) {
    std::array<float, 3 * kBlock> block;
    for (std::size_t i = 0; i < block.size(); ++i)
      block[i] = coordinate<Real>(arrays.vertices + v * arrays.vertex_stride, i);
    if (std::memcmp(block.data(), &places[v], sizeof(block)) != 0) return false;
  }
  for (; v < places.size(); ++v) {
    const Vec3f at = place<Real>(arrays.vertices + v * arrays.vertex_stride);
    if (std::memcmp(&at, &places[v], sizeof(at)) != 0) return false;
  }
  return true;
}

bool has_vertices(const MeshArrays& arrays, const SourceTriangles& source) {
  return arrays.is_single ? has_places<float>(arrays, source.places)
                          : has_places<double>(arrays, source.places);
}

}  // namespace

bool MeshArrays::read(SourceTriangles& source) const {
  source.corners.resize(3 * triangle_count);
  std::size_t named = 0;  // vertices up to the last that a triangle names
  for (std::size_t i = 0; i < source.size(); ++i) {
    source.corners[i] = corner(*this, i);
    named = std::max(named, std::size_t{source.corners[i]} + 1);
  }
  if (named > vertex_count) return false;
  if (named > source.size()) {
    TriangleSoup soup;
    for (const std::uint32_t vertex : source.corners) soup.push_back(place(*this, vertex));
    source = std::move(soup);
  } else {
    source.places.resize(named);
    for (std::size_t v = 0; v < named; ++v) source.places[v] = place(*this, v);
  }
  return is_finite(source);
}

bool MeshArrays::give(const SourceTriangles& source) const {
  if (source.size() != 3 * triangle_count) return false;
  if (source.places.size() <= vertex_count && has_corners(*this, source.corners) &&
      has_vertices(*this, source))
    return true;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const std::uint32_t vertex = corner(*this, i);
    if (vertex >= vertex_count) return false;
    const Vec3f at = place(*this, vertex);
    if (std::memcmp(&at, &source[i], sizeof(at)) != 0) return false;
  }
  return true;
}

std::optional<MeshArrays> arrays_of(dTriMeshDataID data) {
  static const std::optional<Layout> layout = find_layout_and_say();
  if (!layout) return std::nullopt;
  const MeshArrays arrays = arrays_at(*layout, reinterpret_cast<const unsigned char*>(data));
  if (arrays.vertices == nullptr || arrays.indices == nullptr) return std::nullopt;
  // ODE goes by strides of its own where those that it was given are less than this (SetStrides in
  // its OPC_MeshInterface.cpp).
  if (std::min(arrays.vertex_stride, arrays.index_stride) < 3 * sizeof(float)) return std::nullopt;
  return arrays;
}

}  // namespace ode_ext
