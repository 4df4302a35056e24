// SPDX-License-Identifier: BSD-3-Clause
#include "support/mesh_makers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ode_ext::test {
namespace {

using std::numbers::pi;

unsigned add_vertex(TestMesh& mesh, const Point& p) {
  for (const double c : p) mesh.vertices.push_back(static_cast<float>(c));
  return static_cast<unsigned>(mesh.vertex_count() - 1);
}

void add_triangle(TestMesh& mesh, unsigned a, unsigned b, unsigned c) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

void add_quad(TestMesh& mesh, unsigned a, unsigned b, unsigned c, unsigned d) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

// The vertices of a box surface by their place in a lattice, so that faces share their borders.
class BoxLattice {
 public:
  BoxLattice(TestMesh& mesh, const Point& extents, std::array<int, 3> cells)
      : mesh_(mesh), extents_(extents), cells_(cells) {}

  unsigned vertex(std::array<int, 3> place) {
    const auto [found, is_new] = index_.try_emplace(place, 0);
    if (is_new) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = extents_[k] * (2 * place[k] - cells_[k]) / (2.0 * cells_[k]);
      }
      found->second = add_vertex(mesh_, p);
    }
    return found->second;
  }

 private:
  TestMesh& mesh_;
  Point extents_;
  std::array<int, 3> cells_;
  std::map<std::array<int, 3>, unsigned> index_;
};

unsigned midpoint(TestMesh& mesh, std::map<std::pair<unsigned, unsigned>, unsigned>& known,
                  unsigned a, unsigned b, double radius) {
  const auto [found, is_new] = known.try_emplace(std::minmax(a, b), 0);
  if (is_new) found->second = add_vertex(mesh, radius * unit(mesh.vertex(a) + mesh.vertex(b)));
  return found->second;
}

TestMesh icosahedron(double radius) {
  const double g = std::numbers::phi;
  TestMesh mesh;
  // Three golden rectangles; the corners of each in the order (+,+), (-,+), (-,-), (+,-).
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double signs[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (const auto& s : signs) {
      Point p{};
      p[axis] = s[0];
      p[(axis + 1) % 3] = g * s[1];
      add_vertex(mesh, radius * unit(p));
    }
  }
  // Its faces are the triples at mutual edge distance, wound outwards.
  const double reach = 1.1 * radius * 2 / std::sqrt(1 + g * g);
  for (unsigned a = 0; a < 12; ++a) {
    for (unsigned b = a + 1; b < 12; ++b) {
      for (unsigned c = b + 1; c < 12; ++c) {
        const Point p = mesh.vertex(a), q = mesh.vertex(b), r = mesh.vertex(c);
        if (std::max({distance(p, q), distance(q, r), distance(r, p)}) > reach) continue;
        const bool outwards = dot(cross(q - p, r - p), p) > 0;
        add_triangle(mesh, a, outwards ? b : c, outwards ? c : b);
      }
    }
  }
  return mesh;
}

}  // namespace

TestMesh make_box(const Point& extents, int nx, int ny, int nz) {
  TestMesh mesh;
  const std::array<int, 3> cells{nx, ny, nz};
  BoxLattice lattice(mesh, extents, cells);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      for (int i = 0; i < cells[u]; ++i) {
        for (int j = 0; j < cells[v]; ++j) {
          std::array<unsigned, 4> quad{};
          const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
          for (std::size_t k = 0; k < 4; ++k) {
            std::array<int, 3> place{};
            place[axis] = upper ? cells[axis] : 0;
            place[u] = i + corners[k][0];
            place[v] = j + corners[k][1];
            quad[upper ? k : 3 - k] = lattice.vertex(place);
          }
          add_quad(mesh, quad[0], quad[1], quad[2], quad[3]);
        }
      }
    }
  }
  return mesh;
}

TestMesh make_cube(double size, int n) { return make_box({size, size, size}, n, n, n); }

TestMesh make_plate(double size, double thickness, int n) {
  return make_box({size, size, thickness}, n, n, 1);
}

TestMesh make_rod(double length, double width) { return make_box({length, width, width}); }

TestMesh make_icosphere(double radius, int subdivisions) {
  TestMesh mesh = icosahedron(radius);
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<unsigned, unsigned>, unsigned> known;
    const std::vector<unsigned> coarse = std::exchange(mesh.indices, {});
    for (std::size_t t = 0; t < coarse.size(); t += 3) {
      const unsigned a = coarse[t], b = coarse[t + 1], c = coarse[t + 2];
      const unsigned ab = midpoint(mesh, known, a, b, radius);
      const unsigned bc = midpoint(mesh, known, b, c, radius);
      const unsigned ca = midpoint(mesh, known, c, a, radius);
      add_triangle(mesh, a, ab, ca);
      add_triangle(mesh, b, bc, ab);
      add_triangle(mesh, c, ca, bc);
      add_triangle(mesh, ab, bc, ca);
    }
  }
  return mesh;
}

TestMesh make_torus(double ring, double tube, int around, int across) {
  TestMesh mesh;
  for (int i = 0; i < around; ++i) {
    const double a = 2 * pi * i / around;
    for (int j = 0; j < across; ++j) {
      const double b = 2 * pi * j / across, r = ring + tube * std::cos(b);
      add_vertex(mesh, {r * std::cos(a), r * std::sin(a), tube * std::sin(b)});
    }
  }
  const auto index = [&](int i, int j) {
    return static_cast<unsigned>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      add_quad(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }
  return mesh;
}

TestMesh make_tetrahedron(double edge) {
  TestMesh mesh;
  const double s = edge / std::sqrt(8.0);  // alternate corners of a cube with half side s
  add_vertex(mesh, {s, s, s});
  add_vertex(mesh, {-s, -s, s});
  add_vertex(mesh, {-s, s, -s});
  add_vertex(mesh, {s, -s, -s});
  mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return mesh;
}

TestMesh make_cylinder(double radius, double height, int sides) {
  TestMesh mesh;
  const auto count = static_cast<unsigned>(sides);
  for (const double z : {-height / 2, height / 2}) {
    for (int i = 0; i < sides; ++i) {
      const double a = 2 * pi * i / sides;
      add_vertex(mesh, {radius * std::cos(a), radius * std::sin(a), z});
    }
  }
  const unsigned bottom = add_vertex(mesh, {0, 0, -height / 2});
  const unsigned top = add_vertex(mesh, {0, 0, height / 2});
  for (unsigned i = 0; i < count; ++i) {
    const unsigned j = (i + 1) % count;
    add_quad(mesh, i, j, count + j, count + i);
    add_triangle(mesh, bottom, j, i);
    add_triangle(mesh, top, count + i, count + j);
  }
  return mesh;
}

TestMesh make_l(double size) {
  TestMesh mesh;
  const double outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const double z : {-0.25, 0.25}) {
    for (const auto& p : outline) {
      add_vertex(mesh, {size * (p[0] / 2 - 0.5), size * (p[1] / 2 - 0.5), size * z});
    }
  }
  for (unsigned i = 1; i < 5; ++i) {  // the outline is a fan about its first corner
    add_triangle(mesh, 0, i + 1, i);
    add_triangle(mesh, 6, 6 + i, 6 + i + 1);
  }
  for (unsigned i = 0; i < 6; ++i) {
    const unsigned j = (i + 1) % 6;
    add_quad(mesh, i, j, 6 + j, 6 + i);
  }
  return mesh;
}

TestMesh make_comb(int teeth, double width, double height, double depth) {
  TestMesh mesh;
  const int columns = 2 * teeth - 1;
  const double levels[] = {0, width, width + height};
  std::map<std::array<int, 3>, unsigned> known;
  const auto vertex = [&](int column, int level, int side) {
    const auto [found, is_new] = known.try_emplace({column, level, side}, 0);
    if (is_new) {
      found->second = add_vertex(mesh, {width * (column - 0.5 * columns), (side - 0.5) * depth,
                                        levels[level] - 0.5 * levels[2]});
    }
    return found->second;
  };
  const auto solid = [&](int column, int row) {
    return column >= 0 && column < columns && (row == 0 || (row == 1 && column % 2 == 0));
  };
  // From column and level p to q, with the solid on the left as seen from -y.
  const auto wall = [&](int pc, int pl, int qc, int ql) {
    add_quad(mesh, vertex(pc, pl, 0), vertex(pc, pl, 1), vertex(qc, ql, 1), vertex(qc, ql, 0));
  };
  for (int row = 0; row < 2; ++row) {
    for (int c = 0; c < columns; ++c) {
      if (!solid(c, row)) continue;
      const int r = row;
      add_quad(mesh, vertex(c, r, 0), vertex(c + 1, r, 0), vertex(c + 1, r + 1, 0),
               vertex(c, r + 1, 0));
      add_quad(mesh, vertex(c, r, 1), vertex(c, r + 1, 1), vertex(c + 1, r + 1, 1),
               vertex(c + 1, r, 1));
      if (!solid(c, r - 1)) wall(c, r, c + 1, r);
      if (!solid(c + 1, r)) wall(c + 1, r, c + 1, r + 1);
      if (!solid(c, r + 1)) wall(c + 1, r + 1, c, r + 1);
      if (!solid(c - 1, r)) wall(c, r + 1, c, r);
    }
  }
  return mesh;
}

TestMesh make_sheet(double size, int n) {
  TestMesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      add_vertex(mesh, {size * (2 * i - n) / (2.0 * n), size * (2 * j - n) / (2.0 * n), 0});
    }
  }
  const auto index = [&](int i, int j) { return static_cast<unsigned>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      add_quad(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }
  return mesh;
}

TestMesh make_waves(double size, int n) {
  TestMesh mesh = make_sheet(size, n);
  for (std::size_t i = 0; i + 2 < mesh.vertices.size(); i += 3)
    mesh.vertices[i + 2] =
        0.2f * std::sin(1.5f * mesh.vertices[i]) * std::cos(mesh.vertices[i + 1]);
  return mesh;
}

TestMesh make_triangle(double size) {
  TestMesh mesh;
  add_vertex(mesh, {-size / 2, -size / 2, 0});
  add_vertex(mesh, {size / 2, -size / 2, 0});
  add_vertex(mesh, {0, size / 2, 0});
  mesh.indices = {0, 1, 2};
  return mesh;
}

TestMesh make_soup(int triangles, std::uint64_t seed) {
  TestMesh mesh;
  Random random(seed);
  for (int i = 0; i < triangles; ++i) {
    const TestPose pose = random.pose(0.5);
    for (int k = 0; k < 3; ++k) {
      for (const double at : pose.position)
        mesh.vertices.push_back(static_cast<float>(at + random.uniform(-0.5, 0.5)));
      mesh.indices.push_back(static_cast<unsigned>(3 * i + k));
    }
  }
  return mesh;
}

TestMesh opened(TestMesh mesh, double z) {
  std::vector<unsigned> kept;
  for (auto t = mesh.indices.begin(); t != mesh.indices.end(); t += 3) {
    const auto is_at = [&](unsigned v) {
      return mesh.vertices[3 * v + 2] == static_cast<float>(z);
    };
    if (!std::all_of(t, t + 3, is_at)) kept.insert(kept.end(), t, t + 3);
  }
  mesh.indices = kept;
  return mesh;
}

TestMesh inverted(TestMesh mesh) {
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
  }
  return mesh;
}

TestMesh scaled(TestMesh mesh, double factor) {
  for (float& c : mesh.vertices) c = static_cast<float>(c * factor);
  return mesh;
}

TestMesh moved(TestMesh mesh, const Point& offset) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] = static_cast<float>(mesh.vertices[i] + offset[i % 3]);
  }
  return mesh;
}

TestMesh merged(const TestMesh& a, const TestMesh& b) {
  TestMesh mesh = a;
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
  const auto first = static_cast<unsigned>(a.vertex_count());
  for (const unsigned i : b.indices) mesh.indices.push_back(first + i);
  return mesh;
}

TestMesh far_out(const TestMesh& mesh, const Point& far) {
  return merged(moved(mesh, far), moved(make_tetrahedron(0.1), -1 * far));
}

TestMesh unshared(const TestMesh& mesh) {
  TestMesh soup;
  for (const unsigned i : mesh.indices) soup.indices.push_back(add_vertex(soup, mesh.vertex(i)));
  return soup;
}

double mesh_size(const TestMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  Point lo = mesh.vertex(0), hi = lo;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    lo[i % 3] = std::fmin(lo[i % 3], mesh.vertices[i]);
    hi[i % 3] = std::fmax(hi[i % 3], mesh.vertices[i]);
  }
  return largest_component(hi - lo);
}

}  // namespace ode_ext::test
