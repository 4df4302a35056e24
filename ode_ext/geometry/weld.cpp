// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/weld.h"

#include <algorithm>
#include <tuple>

#include "geometry/runs.h"

namespace ode_ext {
namespace {

struct Corner {
  Vec3f position;
  std::uint32_t index;  // 3 * triangle + corner
};

bool before(const Corner& a, const Corner& b) {
  if (a.position.x != b.position.x) return a.position.x < b.position.x;
  if (a.position.y != b.position.y) return a.position.y < b.position.y;
  return a.position.z < b.position.z;
}

// From the lowest vertex on, which leaves the winding.
Triangle rotated(const Triangle& t) {
  const auto lowest = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  return {t[lowest], t[(lowest + 1) % 3], t[(lowest + 2) % 3]};
}

// The places by the first corner that lies there; `place` of each corner.
std::vector<std::uint32_t> in_order_of_listing(const std::vector<std::uint32_t>& place,
                                               std::size_t place_count) {
  std::vector<std::uint32_t> order;
  std::vector<bool> listed(place_count);
  for (const std::uint32_t i : place) {
    if (listed[i]) continue;
    listed[i] = true;
    order.push_back(i);
  }
  return order;
}

}  // namespace

WeldedMesh weld(const std::vector<Vec3f>& soup, VertexOrder vertex_order) {
  WeldedMesh mesh;
  std::vector<Corner> corners;
  corners.reserve(soup.size());
  for (std::size_t i = 0; i + 2 < soup.size(); i += 3) {
    if (soup[i] == soup[i + 1] || soup[i + 1] == soup[i + 2] || soup[i + 2] == soup[i]) continue;
    mesh.source_triangle.push_back(static_cast<std::uint32_t>(i / 3));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f position = soup[i + k] + Vec3f{};  // -0 + 0 = +0
      corners.push_back({position, static_cast<std::uint32_t>(corners.size())});
    }
  }

  // By place, so that equal ones are neighbours whatever the order of the triangles.
  std::sort(corners.begin(), corners.end(), before);
  std::vector<Vec3f> places;
  std::vector<std::uint32_t> place(corners.size());
  for (const Corner& corner : corners) {
    if (places.empty() || !(places.back() == corner.position)) places.push_back(corner.position);
    place[corner.index] = static_cast<std::uint32_t>(places.size() - 1);
  }

  const std::vector<std::uint32_t> order = vertex_order == VertexOrder::kRuns
                                               ? order_into_runs(places)
                                               : in_order_of_listing(place, places.size());
  std::vector<std::uint32_t> vertex(places.size());
  mesh.vertices.reserve(places.size());
  for (const std::uint32_t i : order) {
    vertex[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(places[i]);
  }
  mesh.triangles.resize(mesh.source_triangle.size());
  mesh.corner_vertex.assign(soup.size(), kNoVertex);
  for (std::size_t i = 0; i < place.size(); ++i) {
    mesh.triangles[i / 3][i % 3] = vertex[place[i]];
    mesh.corner_vertex[3 * mesh.source_triangle[i / 3] + i % 3] = vertex[place[i]];
  }
  return mesh;
}

void order_by_vertices(WeldedMesh& mesh) {
  struct Listed {
    Triangle key, triangle;
    std::uint32_t source;
  };
  std::vector<Listed> listed;
  listed.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    listed.push_back({rotated(mesh.triangles[i]), mesh.triangles[i], mesh.source_triangle[i]});
  std::sort(listed.begin(), listed.end(), [](const Listed& a, const Listed& b) {
    return std::tie(a.key, a.source) < std::tie(b.key, b.source);
  });
  for (std::size_t i = 0; i < listed.size(); ++i) {
    mesh.triangles[i] = listed[i].triangle;
    mesh.source_triangle[i] = listed[i].source;
  }
}

}  // namespace ode_ext
