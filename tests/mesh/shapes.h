// SPDX-License-Identifier: BSD-3-Clause
// Soups for the tests of this folder, wound outward.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/vec.h"

namespace ode_ext::shapes {

inline void append(TriangleSoup& soup, Vec3f a, Vec3f b, Vec3f c) {
  soup.insert(soup.end(), {a, b, c});
}

inline TriangleSoup joined(TriangleSoup a, const TriangleSoup& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Whether a triangle has the corners of one of a soup in their order, from whichever of them on.
inline bool is_triangle_of(const TriangleSoup& soup, std::size_t number, const Mesh& mesh,
                           const Triangle& triangle) {
  for (std::size_t first = 0; first < 3; ++first) {
    bool is = true;
    for (std::size_t k = 0; k < 3; ++k)
      is = is && mesh.vertices[triangle[k]] == soup[3 * number + (first + k) % 3];
    if (is) return true;
  }
  return false;
}

inline TriangleSoup tetrahedron() {
  const Vec3f o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  return {o, y, x, o, x, z, o, z, y, x, y, z};
}

// Each side cut into steps x steps quads; bit `side` of `diagonals` chooses how theirs are cut.
inline TriangleSoup box(Vec3f lo, Vec3f hi, int steps = 1, unsigned diagonals = 0) {
  TriangleSoup soup;
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t axis = side / 2;
    const bool top = side % 2 == 1;
    const auto point = [&](int i, int j) {
      Vec3f p;
      p[axis] = top ? hi[axis] : lo[axis];
      for (auto [k, step] : {std::pair{(axis + 1) % 3, i}, std::pair{(axis + 2) % 3, j}}) {
        const float part = static_cast<float>(step) / static_cast<float>(steps);
        p[k] = step == steps ? hi[k] : lo[k] + part * (hi[k] - lo[k]);
      }
      return p;
    };
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; j < steps; ++j) {
        const Vec3f a = point(i, j), c = point(i + 1, j + 1);
        const Vec3f b = top ? point(i + 1, j) : point(i, j + 1);
        const Vec3f d = top ? point(i, j + 1) : point(i + 1, j);
        if ((diagonals >> side & 1) != 0) {
          append(soup, a, b, d);
          append(soup, b, c, d);
        } else {
          append(soup, a, b, c);
          append(soup, a, c, d);
        }
      }
    }
  }
  return soup;
}

inline TriangleSoup cube() { return box({0, 0, 0}, {1, 1, 1}); }

// A grid of rows x columns quads on a surface given by two parameters in [0, 1]; both may wrap.
template <class Surface>
TriangleSoup tessellated(int rows, int columns, const Surface& surface) {
  TriangleSoup soup;
  const auto point = [&](int i, int j) {
    return Vec3f(surface(static_cast<double>(i) / rows, static_cast<double>(j) / columns));
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      append(soup, point(i, j), point(i + 1, j), point(i + 1, j + 1));
      append(soup, point(i, j), point(i + 1, j + 1), point(i, j + 1));
    }
  }
  return soup;
}

// An angle's cosine and sine where 0 and 1 are the same place to the last bit.
inline std::pair<double, double> on_circle(double turn) {
  const double angle = 2 * std::numbers::pi * (turn == 1 ? 0 : turn);
  return {std::cos(angle), std::sin(angle)};
}

// Poles and seam are single vertices; the triangles that collapse there are part of the soup.
inline TriangleSoup sphere(double radius, int rows) {
  return tessellated(rows, 2 * rows, [=](double latitude, double longitude) {
    const auto [c, s] = on_circle(longitude);
    const double angle = std::numbers::pi * latitude;
    const double ring = latitude == 0 || latitude == 1 ? 0 : radius * std::sin(angle);
    return Vec3d{ring * c, ring * s, radius * std::cos(angle)};
  });
}

inline TriangleSoup torus(double radius, double tube, int rows) {
  return tessellated(rows, rows, [=](double around, double across) {
    const auto [c, s] = on_circle(around);
    const auto [u, v] = on_circle(across);
    return Vec3d{(radius + tube * u) * c, (radius + tube * u) * s, tube * v};
  });
}

// The unit square at z = 0, facing up.
inline TriangleSoup sheet(int steps) {
  return tessellated(steps, steps, [](double x, double y) { return Vec3d{x, y, 0}; });
}

inline TriangleSoup moved(TriangleSoup soup, float scale, Vec3f offset) {
  for (Vec3f& corner : soup) corner = scale * corner + offset;
  return soup;
}

inline TriangleSoup turned(TriangleSoup soup) {
  for (std::size_t i = 0; i < soup.size(); i += 3) std::swap(soup[i + 1], soup[i + 2]);
  return soup;
}

inline TriangleSoup random_soup(std::size_t triangles, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1, 1), size(-0.3f, 0.3f);
  TriangleSoup soup;
  for (std::size_t i = 0; i < triangles; ++i) {
    const Vec3f p{place(random), place(random), place(random)};
    for (int k = 0; k < 3; ++k) {
      const float x = size(random), y = size(random), z = size(random);
      soup.push_back(p + Vec3f{x, y, z});
    }
  }
  return soup;
}

// [m^3]
inline double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.topology->triangles) {
    sum += dot(Vec3d(mesh.vertices[t[0]]),
               cross(Vec3d(mesh.vertices[t[1]]), Vec3d(mesh.vertices[t[2]])));
  }
  return sum / 6;
}

}  // namespace ode_ext::shapes
