// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/decode_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode_ext::fuzz {
namespace {

using namespace test;

TestMesh soup(ByteSource& bytes, bool wild) {
  TestMesh mesh;
  const int vertices = bytes.between(3, 12), triangles = bytes.between(1, 16);
  for (int i = 0; i < 3 * vertices; ++i) {
    mesh.vertices.push_back(static_cast<float>(wild ? bytes.wild() : bytes.lattice()));
  }
  for (int i = 0; i < 3 * triangles; ++i) {
    mesh.indices.push_back(static_cast<unsigned>(bytes.below(vertices)));
  }
  return mesh;
}

TestMesh terrain(ByteSource& bytes) {
  TestMesh mesh = make_sheet(2 * bytes.size(), bytes.between(1, 5));
  for (std::size_t i = 2; i < mesh.vertices.size(); i += 3) {
    mesh.vertices[i] = static_cast<float>(0.25 * bytes.lattice());
  }
  return mesh;
}

TestMesh box(ByteSource& bytes) {
  const Point extents{bytes.size(), bytes.size(), bytes.size()};
  const int nx = bytes.between(1, 4), ny = bytes.between(1, 4), nz = bytes.between(1, 4);
  return make_box(extents, nx, ny, nz);
}

TestMesh torus(ByteSource& bytes) {
  const double ring = bytes.size(), tube = ring * bytes.between(1, 15) / 16.0;
  const int around = bytes.between(3, 12), across = bytes.between(3, 8);
  return make_torus(ring, tube, around, across);
}

TestMesh plate(ByteSource& bytes) {
  const double size = bytes.size(), thickness = size / bytes.between(2, 200);
  return make_plate(size, thickness, bytes.between(1, 6));
}

TestMesh rod(ByteSource& bytes) {
  const double length = 2 * bytes.size();
  return make_rod(length, length / bytes.between(2, 100));
}

TestMesh comb(ByteSource& bytes) {
  const int teeth = bytes.between(1, 5);
  const double width = 0.25 * bytes.size(), height = bytes.size();
  return make_comb(teeth, width, height, bytes.size());
}

TestMesh cylinder(ByteSource& bytes) {
  const double radius = bytes.size(), height = bytes.size();
  return make_cylinder(radius, height, bytes.between(3, 16));
}

DecodedMesh shape(ByteSource& bytes) {
  switch (bytes.below(15)) {
    case 0:
      return {make_cube(bytes.size(), 1), true};
    case 1:
      return {box(bytes), true};
    case 2:
      return {make_icosphere(bytes.size(), bytes.between(0, 2)), true};
    case 3:
      return {torus(bytes), true};
    case 4:
      return {plate(bytes), true};
    case 5:
      return {rod(bytes), true};
    case 6:
      return {make_l(bytes.size()), true};
    case 7:
      return {comb(bytes), true};
    case 8:
      return {make_tetrahedron(bytes.size()), true};
    case 9:
      return {cylinder(bytes), true};
    case 10:
      return {make_sheet(2 * bytes.size(), bytes.between(1, 6)), false};
    case 11:
      return {make_triangle(bytes.size()), false};
    case 12:
      return {terrain(bytes), false};
    case 13:
      return {soup(bytes, false), false};
    default:
      return {soup(bytes, true), false};
  }
}

void move_all(ByteSource& bytes, TestMesh& mesh) {
  const Point offset{bytes.lattice(), bytes.lattice(), bytes.lattice()};
  mesh = moved(std::move(mesh), offset);
}

void scale_all(ByteSource& bytes, TestMesh& mesh) {
  mesh = scaled(std::move(mesh), std::pow(10.0, bytes.between(-3, 3)));
}

}  // namespace

DecodedMesh decode_mesh(ByteSource& bytes) {
  DecodedMesh decoded = shape(bytes);
  for (int changes = bytes.below(4); changes > 0; --changes) {
    switch (bytes.below(6)) {
      case 0:
        decoded.mesh = inverted(std::move(decoded.mesh));
        break;
      case 1:
        decoded.mesh = unshared(decoded.mesh);
        break;
      case 2:
        move_all(bytes, decoded.mesh);
        break;
      case 3:
        scale_all(bytes, decoded.mesh);
        break;
      case 4:
        if (decoded.mesh.triangle_count() <= 300) {
          decoded = {merged(decoded.mesh, shape(bytes).mesh), false};
        }
        break;
      default:
        spoil(bytes, decoded);
    }
  }
  return decoded;
}

void spoil(ByteSource& bytes, DecodedMesh& decoded) {
  TestMesh& mesh = decoded.mesh;
  const auto vertex = [&] {
    return static_cast<std::size_t>(bytes.byte() + 256 * bytes.byte()) %
           static_cast<std::size_t>(mesh.vertex_count());
  };
  const auto triangle = [&] {
    return static_cast<std::size_t>(bytes.byte() + 256 * bytes.byte()) %
           static_cast<std::size_t>(mesh.triangle_count());
  };
  const int change = bytes.below(9);
  if (change < 7) decoded.solid = false;
  switch (change) {
    case 0: {  // a vertex anywhere
      const std::size_t at = 3 * vertex();
      for (std::size_t k = 0; k < 3; ++k) mesh.vertices[at + k] = static_cast<float>(bytes.wild());
      break;
    }
    case 1:  // one coordinate
      mesh.vertices[3 * vertex() + static_cast<std::size_t>(bytes.below(3))] =
          static_cast<float>(bytes.wild());
      break;
    case 2: {  // two vertices in one place
      const std::size_t from = 3 * vertex(), to = 3 * vertex();
      for (std::size_t k = 0; k < 3; ++k) mesh.vertices[to + k] = mesh.vertices[from + k];
      break;
    }
    case 3: {  // a triangle twice
      const std::size_t from = 3 * triangle(), to = 3 * triangle();
      for (std::size_t k = 0; k < 3; ++k) mesh.indices[to + k] = mesh.indices[from + k];
      break;
    }
    case 4: {  // a triangle wound the other way
      const std::size_t at = 3 * triangle();
      std::swap(mesh.indices[at], mesh.indices[at + 1]);
      break;
    }
    case 5: {  // a corner of a triangle elsewhere: three triangles at an edge, holes, no area
      const std::size_t at = 3 * triangle() + static_cast<std::size_t>(bytes.below(3));
      mesh.indices[at] = static_cast<unsigned>(vertex());
      break;
    }
    case 6: {  // all of it by any factor
      const double factor = bytes.wild();
      for (float& x : mesh.vertices) x = static_cast<float>(x * factor);
      break;
    }
    case 7:
      move_all(bytes, mesh);
      break;
    default:
      scale_all(bytes, mesh);
  }
}

TestPose decode_pose(ByteSource& bytes, bool wild) {
  const int turn = bytes.below(4);  // a quarter of the poses is not turned, and faces coincide
  TestPose pose;
  if (turn == 1) {
    const Point axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    pose = turned(axes[bytes.below(3)], bytes.lattice());
  } else if (turn > 1) {
    const Point axis{bytes.lattice(), bytes.lattice(), 0.01 + bytes.lattice()};
    pose = turned(axis, 2 * bytes.lattice());
  }
  for (double& x : pose.position) x = wild ? bytes.wild() : bytes.lattice();
  if (wild && turn == 3) {
    pose.rotation[static_cast<std::size_t>(bytes.below(9))] = bytes.wild();
  }
  return pose;
}

bool finite(const TestMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](float x) { return std::isfinite(x); });
}

bool tame(const TestMesh& mesh) {
  if (!finite(mesh)) return false;
  const double size = mesh_size(mesh);
  if (!(size >= 1e-3 && size <= 1e3)) return false;
  for (const float x : mesh.vertices) {
    if (std::fabs(x) > 100 * size) return false;
  }
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const Point a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    const double height = longest > 0 ? length(cross(b - a, c - a)) / longest : 0;
    if (!(height >= 1e-3 * size)) return false;
  }
  return true;
}

bool finite(const TestPose& pose) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  return std::all_of(pose.position.begin(), pose.position.end(), is_finite) &&
         std::all_of(pose.rotation.begin(), pose.rotation.end(), is_finite);
}

bool tame(const TestPose& pose) {
  if (!finite(pose) || largest_component(pose.position) > 1e4) return false;
  // R Rt = 1 to within what rounding explains, and no mirror.
  const auto row = [&](std::size_t i) {
    return Point{pose.rotation[3 * i], pose.rotation[3 * i + 1], pose.rotation[3 * i + 2]};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (std::fabs(dot(row(i), row(j)) - (i == j)) > 1e-9) return false;
    }
  }
  return dot(cross(row(0), row(1)), row(2)) > 0;
}

void tame_down(TestMesh& mesh, double limit) {
  for (float& x : mesh.vertices) {
    if (!(std::fabs(x) <= limit)) x = 0;
  }
}

}  // namespace ode_ext::fuzz
