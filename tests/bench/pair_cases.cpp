// SPDX-License-Identifier: BSD-3-Clause
#include "bench/pair_cases.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/fcl_oracle.h"

namespace ode_ext::bench {
namespace {

using test::operator*;
using test::operator+;

using test::Point;

double size_of(const TestMesh& mesh) {
  double largest = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count()); ++i)
    largest = std::max(largest, test::length(mesh.vertex(i)));
  return 2 * largest;
}

// Where B comes from: along a line past A's middle.
struct Line {
  Point from, direction;
};

Line any_line(const TestPose&, test::Random& random) { return {{}, random.direction()}; }

// So that A comes down on B, anywhere but near its rim.
Line line_from_above(const TestMesh& b, const TestPose& pose, test::Random& random) {
  const double most = 0.2 * size_of(b);
  const Point aside{most * random.uniform(-1, 1), most * random.uniform(-1, 1), 0};
  return {rotate(pose, aside), rotate(pose, Point{0, 0, -1})};
}

template <typename MakeLine>
PairCase make_case_along(const MakeLine& make_line, const std::string& name, const TestMesh& a,
                         const TestMesh& b, const Depth& depth, int count, std::uint64_t seed) {
  const test::FclSurface surface_a(a), surface_b(b);
  const double size = std::min(size_of(a), size_of(b));
  test::Random random(seed);
  PairCase result{name, a, b, {}};
  for (int i = 0; i < count; ++i) {
    PosedPair pair{random.pose(0), random.pose(0)};
    const Line line = make_line(pair.b, random);
    // From afar to where the surfaces first meet; first to within a step, then to within rounding.
    double apart = 0.5 * (size_of(a) + size_of(b)) * 1.001, met = apart;
    const auto meet = [&](double distance) {
      pair.b.position = line.from + distance * line.direction;
      return test::surfaces_intersect(surface_a, pair.a, surface_b, pair.b);
    };
    while (met > 0 && !meet(met)) apart = std::exchange(met, met - 0.01 * size);
    for (int k = 0; k < 20; ++k) {
      const double middle = 0.5 * (apart + met);
      (meet(middle) ? met : apart) = middle;
    }
    const double off = depth.depth + depth.spread * random.uniform(-1, 1);
    pair.b.position = line.from + (met - off * size) * line.direction;
    result.pairs.push_back(pair);
  }
  return result;
}

}  // namespace

PairCase make_case(const std::string& name, const TestMesh& a, const TestMesh& b,
                   const Depth& depth, int count, std::uint64_t seed) {
  return make_case_along(any_line, name, a, b, depth, count, seed);
}

PairCase make_case_from_above(const std::string& name, const TestMesh& a, const TestMesh& b,
                              const Depth& depth, int count, std::uint64_t seed) {
  const auto from_above = [&](const TestPose& pose, test::Random& random) {
    return line_from_above(b, pose, random);
  };
  return make_case_along(from_above, name, a, b, depth, count, seed);
}

TestMesh make_rock(int triangles) {
  // A torus' worth of parameters on a sphere: rows of quads, closed by fans at the poles.
  const int rows = std::max(3, static_cast<int>(std::sqrt(triangles / 4.0)));
  const int columns = 2 * rows;
  TestMesh mesh;
  const auto add = [&](double polar, double azimuth) {
    const double x = std::sin(polar) * std::cos(azimuth), y = std::sin(polar) * std::sin(azimuth),
                 z = std::cos(polar);
    const double radius = 0.4 + 0.03 * std::sin(7 * x + 1) * std::sin(6 * y + 2) * std::sin(5 * z) +
                          0.01 * std::sin(23 * x) * std::sin(19 * y) * std::sin(21 * z + 1);
    for (const double value : {radius * x, radius * y, radius * z})
      mesh.vertices.push_back(static_cast<float>(value));
  };
  const double pi = std::acos(-1.0);
  add(0, 0);
  for (int r = 1; r < rows; ++r)
    for (int c = 0; c < columns; ++c) add(pi * r / rows, 2 * pi * c / columns);
  add(pi, 0);
  const auto at = [&](int r, int c) {
    return static_cast<unsigned>(1 + (r - 1) * columns + c % columns);
  };
  const auto last = static_cast<unsigned>(1 + (rows - 1) * columns);
  for (int c = 0; c < columns; ++c) {
    mesh.indices.insert(mesh.indices.end(), {0u, at(1, c), at(1, c + 1)});
    for (int r = 1; r + 1 < rows; ++r)
      mesh.indices.insert(mesh.indices.end(), {at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c),
                                               at(r + 1, c + 1), at(r, c + 1)});
    mesh.indices.insert(mesh.indices.end(), {at(rows - 1, c), last, at(rows - 1, c + 1)});
  }
  return mesh;
}

TestMesh make_hills(int triangles) {
  TestMesh mesh = test::make_sheet(1, std::max(1, static_cast<int>(std::sqrt(triangles / 2.0))));
  for (std::size_t i = 0; i + 2 < mesh.vertices.size(); i += 3)
    mesh.vertices[i + 2] =
        0.1f * std::sin(9 * mesh.vertices[i]) * std::cos(7 * mesh.vertices[i + 1]);
  return mesh;
}

TestMesh make_ground(int triangles) {
  return test::make_waves(4, std::max(1, static_cast<int>(std::sqrt(triangles / 2.0))));
}

}  // namespace ode_ext::bench
