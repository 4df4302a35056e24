// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/weld.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesh/runs.h"

namespace ode_ext {
namespace {

bool before(const Vec3f& a, const Vec3f& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// The places of corners, each once, in the order in which they came: a hash table with open
// addressing, at most half full.
class Places {
 public:
  explicit Places(std::size_t most)
      : table_(std::bit_ceil(2 * most + 1), kNone), mask_(table_.size() - 1) {}

  std::uint32_t index_of(const Vec3f& place) {
    const auto bits = [](float value) {
      return std::uint64_t{std::bit_cast<std::uint32_t>(value)};
    };
    // Multiplicative (Knuth), of which the upper half is well mixed.
    const std::uint64_t hash =
        (bits(place.x) * 0x9e3779b97f4a7c15u + bits(place.y)) * 0xc2b2ae3d27d4eb4fu +
        bits(place.z) * 0x165667b19e3779f9u;
    for (std::size_t at = hash >> 20;; ++at) {
      std::uint32_t& found = table_[at & mask_];
      if (found == kNone) {
        found = static_cast<std::uint32_t>(places_.size());
        places_.push_back(place);
        return found;
      }
      if (places_[found] == place) return found;
    }
  }

  std::vector<Vec3f> take() { return std::move(places_); }

 private:
  std::vector<std::uint32_t> table_;
  std::size_t mask_;
  std::vector<Vec3f> places_;
};

// For each place the number of its vertex, and the vertices: in compact runs (runs.h), whatever the
// order of the places.
std::vector<std::uint32_t> number_in_runs(std::vector<Vec3f>& places) {
  std::vector<std::uint32_t> sorted(places.size());
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::sort(sorted.begin(), sorted.end(),
            [&](std::uint32_t a, std::uint32_t b) { return before(places[a], places[b]); });
  std::vector<Vec3f> in_order;
  in_order.reserve(places.size());
  for (const std::uint32_t i : sorted) in_order.push_back(places[i]);
  std::vector<std::uint32_t> vertex(places.size());
  std::uint32_t next = 0;
  for (const std::uint32_t i : order_into_runs(in_order)) {
    vertex[sorted[i]] = next;
    places[next++] = in_order[i];
  }
  return vertex;
}

// From the lowest vertex on, which leaves the winding.
Triangle rotated(const Triangle& t) {
  const auto lowest = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  return {t[lowest], t[(lowest + 1) % 3], t[(lowest + 2) % 3]};
}

struct Listed {
  Triangle rotated;
  std::uint32_t source;
};

// Of two with the same lowest vertex. First by which vertices, so that a mesh and the same inside
// out are numbered alike.
bool is_listed_first(const Listed& a, const Listed& b) {
  const auto others = [](const Triangle& t) { return std::minmax(t[1], t[2]); };
  return std::tuple(others(a.rotated), a.rotated, a.source) <
         std::tuple(others(b.rotated), b.rotated, b.source);
}

template <typename T>
void erase_marked(const std::vector<bool>& is_marked, std::vector<T>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!is_marked[i]) values[kept++] = values[i];
  values.resize(kept);
}

void leave_out_unused_vertices(WeldedMesh& mesh) {
  std::vector<std::uint32_t> number(mesh.vertices.size(), kNone);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) number[corner] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = kept;
    mesh.vertices[kept++] = mesh.vertices[v];
  }
  mesh.vertices.resize(kept);
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = number[corner];
  for (std::uint32_t& corner : mesh.corner_vertex)
    if (corner != kNone) corner = number[corner];
}

}  // namespace

WeldedMesh weld(const SourceTriangles& source, VertexOrder order) {
  WeldedMesh mesh;
  mesh.corner_vertex.assign(source.size(), kNone);
  Places places(std::min(source.size(), source.places.size()));
  std::vector<std::uint32_t> index_of(source.places.size(), kNone);
  for (std::size_t i = 0; i + 2 < source.size(); i += 3) {
    const Vec3f &a = source[i], &b = source[i + 1], &c = source[i + 2];
    if (a == b || b == c || c == a) continue;
    mesh.source_triangle.push_back(static_cast<std::uint32_t>(i / 3));
    for (std::size_t k = i; k < i + 3; ++k) {
      std::uint32_t& index = index_of[source.corners[k]];
      if (index == kNone) index = places.index_of(source[k] + Vec3f{});  // -0 + 0 = +0
      mesh.corner_vertex[k] = index;
    }
  }
  mesh.vertices = places.take();
  if (order == VertexOrder::kRuns) {
    const std::vector<std::uint32_t> vertex = number_in_runs(mesh.vertices);
    for (std::uint32_t& corner : mesh.corner_vertex)
      if (corner != kNone) corner = vertex[corner];
  }
  mesh.triangles.reserve(mesh.source_triangle.size());
  for (const std::uint32_t triangle : mesh.source_triangle) {
    const std::uint32_t* corner = &mesh.corner_vertex[3 * std::size_t{triangle}];
    mesh.triangles.push_back({corner[0], corner[1], corner[2]});
  }
  return mesh;
}

bool are_apart(const std::vector<Vec3f>& vertices) {
  Places places(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    if (places.index_of(vertices[i]) != i) return false;
  return true;
}

// By the lowest vertex they are counted into place, as half edges are (half_edges.h).
void order_by_vertices(WeldedMesh& mesh) {
  std::vector<std::uint32_t> next(mesh.vertices.size() + 1);
  for (const Triangle& t : mesh.triangles) ++next[*std::min_element(t.begin(), t.end()) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Listed> listed(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = rotated(mesh.triangles[i]);
    listed[next[t[0]]++] = {t, mesh.source_triangle[i]};
  }
  for (std::uint32_t vertex = 0, first = 0; vertex < mesh.vertices.size(); first = next[vertex++])
    std::sort(listed.begin() + first, listed.begin() + next[vertex], is_listed_first);
  for (std::size_t i = 0; i < listed.size(); ++i) {
    mesh.triangles[i] = listed[i].rotated;
    mesh.source_triangle[i] = listed[i].source;
  }
}

std::size_t end_of_same_corners(const std::vector<Triangle>& triangles, std::size_t first) {
  const Triangle& a = triangles[first];
  std::size_t end = first + 1;
  for (; end < triangles.size(); ++end) {
    const Triangle& b = triangles[end];
    if (a[0] != b[0] || std::minmax(a[1], a[2]) != std::minmax(b[1], b[2])) break;
  }
  return end;
}

void leave_out(const std::vector<bool>& is_left_out, WeldedMesh& mesh) {
  erase_marked(is_left_out, mesh.triangles);
  erase_marked(is_left_out, mesh.source_triangle);
  leave_out_unused_vertices(mesh);
}

}  // namespace ode_ext
