// SPDX-License-Identifier: BSD-3-Clause
// A mesh whose triangles know their neighbours: finds the closest place from one nearby.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/vector.h"
#include "meshes/triangle_mesh.h"

namespace falling_objects {

class Surface {
 public:
  explicit Surface(const TriangleMesh& mesh);

  struct Place {
    ode_ext::oracle::Vector point;
    ode_ext::oracle::Vector outwards;  // unit, from the place to p or from p to the place
    double distance;                   // of p [m], negative inside
    std::size_t triangle;
  };
  // Walks over neighbours, from a triangle that need not be near, for as long as that gets closer
  // to p.
  Place closest_from(std::size_t triangle, ode_ext::oracle::Vector p) const;

 private:
  std::vector<ode_ext::oracle::Vector> vertices_, normals_;  // normals of triangles
  std::vector<unsigned> corners_;                            // three per triangle
  std::vector<std::size_t> first_;   // of a vertex's entries in around_, and one more
  std::vector<std::size_t> around_;  // triangles around a vertex
};

}  // namespace falling_objects
