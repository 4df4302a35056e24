// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/inflate.h"

#include <algorithm>
#include <cmath>

#include "geometry/vector.h"

namespace falling_objects {

using ode_ext::oracle::Vector;

TriangleMesh inflate(const TriangleMesh& mesh, double margin) {
  std::vector<Vector> normals(mesh.vertex_count());
  std::vector<Vector> faces;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Corners corners = mesh.corners(t);
    std::array<Vector, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = {corners[k][0], corners[k][1], corners[k][2]};
    const Vector normal = unit(cross(p[1] - p[0], p[2] - p[0]));
    faces.push_back(normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
      Vector& sum = normals[mesh.indices[3 * t + k]];
      sum = sum + std::atan2(length(cross(a, b)), dot(a, b)) * normal;
    }
  }
  for (Vector& normal : normals) normal = unit(normal);
  // The face that a move along the vertex's normal moves least decides how far it goes.
  std::vector<double> least(mesh.vertex_count(), 1);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned v = mesh.indices[3 * t + k];
      least[v] = std::min(least[v], dot(normals[v], faces[t]));
    }
  }
  TriangleMesh skin;
  skin.indices = mesh.indices;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Point p = mesh.vertex(v);
    const double way = margin / std::max(least[v], 0.5);
    skin.add_vertex(
        {p[0] + way * normals[v].x, p[1] + way * normals[v].y, p[2] + way * normals[v].z});
  }
  return skin;
}

}  // namespace falling_objects
