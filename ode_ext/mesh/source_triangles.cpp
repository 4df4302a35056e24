// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/source_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace ode_ext {
namespace {

bool are_same(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3f)) == 0);
}

}  // namespace

SourceTriangles::SourceTriangles(TriangleSoup soup)
    : places(std::move(soup)), corners(places.size()) {
  std::iota(corners.begin(), corners.end(), 0u);
}

bool is_finite(const SourceTriangles& source) {
  return std::all_of(source.corners.begin(), source.corners.end(), [&](std::uint32_t place) {
    const Vec3f& at = source.places[place];
    return std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
  });
}

Box box_of(const SourceTriangles& source) {
  if (source.empty()) return {};
  Box box = empty_box();
  for (const std::uint32_t place : source.corners) box = grown(box, source.places[place]);
  return box;
}

int compare_soups(const SourceTriangles& a, const SourceTriangles& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  if (a.corners == b.corners && are_same(a.places, b.places)) return 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int corners = std::memcmp(&a[i], &b[i], sizeof(Vec3f));
    if (corners != 0) return corners;
  }
  return 0;
}

}  // namespace ode_ext
