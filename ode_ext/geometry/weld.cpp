// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/weld.h"

#include <algorithm>

#include "geometry/box.h"

namespace ode_ext {
namespace {

struct Corner {
  std::uint64_t key;  // place along the Morton curve
  Vec3f position;
  std::uint32_t index;  // 3 * triangle + corner
};

// Spreads the low 21 bits so that two free bits follow each.
std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x001f00000000ffff;
  v = (v | v << 16) & 0x001f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

// The cells are cubes, whatever the box: near along the curve then is near in space.
class MortonCurve {
 public:
  explicit MortonCurve(const Box& box) : lo_(box.lo) {
    const Vec3d size = extent(box);
    const double longest = std::max({size.x, size.y, size.z});
    if (longest > 0) scale_ = 0x1fffff / longest;
  }
  std::uint64_t key(Vec3f point) const {
    const Vec3d cell = scale_ * (Vec3d(point) - lo_);
    return spread_bits(static_cast<std::uint64_t>(cell.x)) |
           spread_bits(static_cast<std::uint64_t>(cell.y)) << 1 |
           spread_bits(static_cast<std::uint64_t>(cell.z)) << 2;
  }

 private:
  Vec3d lo_;
  double scale_ = 0;
};

// By key, ties by coordinates: equal places are neighbours and the order is that of the places.
bool before(const Corner& a, const Corner& b) {
  if (a.key != b.key) return a.key < b.key;
  if (a.position.x != b.position.x) return a.position.x < b.position.x;
  if (a.position.y != b.position.y) return a.position.y < b.position.y;
  return a.position.z < b.position.z;
}

}  // namespace

WeldedMesh weld(const std::vector<Vec3f>& soup) {
  WeldedMesh mesh;
  std::vector<Corner> corners;
  corners.reserve(soup.size());
  Box box = empty_box();
  for (std::size_t i = 0; i + 2 < soup.size(); i += 3) {
    if (soup[i] == soup[i + 1] || soup[i + 1] == soup[i + 2] || soup[i + 2] == soup[i]) continue;
    mesh.source_triangle.push_back(static_cast<std::uint32_t>(i / 3));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f position = soup[i + k] + Vec3f{};  // -0 + 0 = +0
      box = grown(box, position);
      corners.push_back({0, position, static_cast<std::uint32_t>(corners.size())});
    }
  }

  const MortonCurve curve(box);
  for (Corner& corner : corners) corner.key = curve.key(corner.position);
  std::sort(corners.begin(), corners.end(), before);

  mesh.triangles.resize(mesh.source_triangle.size());
  mesh.corner_vertex.assign(soup.size(), kNoVertex);
  for (const Corner& corner : corners) {
    if (mesh.vertices.empty() || !(mesh.vertices.back() == corner.position)) {
      mesh.vertices.push_back(corner.position);
    }
    const auto vertex = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    mesh.triangles[corner.index / 3][corner.index % 3] = vertex;
    mesh.corner_vertex[3 * mesh.source_triangle[corner.index / 3] + corner.index % 3] = vertex;
  }
  return mesh;
}

}  // namespace ode_ext
