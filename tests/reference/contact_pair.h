// SPDX-License-Identifier: BSD-3-Clause
// Two meshes in general position, in the frame of the second: A is made eps larger and moved by far
// less, so that what touches overlaps, and what coincides is crossed cleanly.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "reference/contact_mesh.h"

namespace ode_ext::test {

class ContactPair {
 public:
  // The meshes must outlive the pair.
  ContactPair(const ContactMesh& a, const TestPose& pa, const ContactMesh& b, const TestPose& pb);

  const ContactMesh& mesh(std::size_t side) const { return *meshes_[side]; }
  const Point& vertex(std::size_t side, std::size_t v) const { return points_[side][v]; }
  const std::vector<Point>& vertices(std::size_t side) const { return points_[side]; }
  const Point& corner(std::size_t side, std::size_t triangle, std::size_t k) const {
    return points_[side][meshes_[side]->triangles[triangle][k]];
  }
  double epsilon() const { return epsilon_; }  // [m]

  // Between the frame of B, in general position, and a mesh's own.
  Point into(std::size_t side, const Point& p) const;
  Point turned_into(std::size_t side, const Point& direction) const;
  Point normal(std::size_t side, std::size_t facet) const;  // outward
  double top(std::size_t side, std::size_t facet) const;    // along normal() [m]
  Point vertex_normal(std::size_t side, std::size_t v) const;

  Point to_world(const Point& p) const;
  Point turned_to_world(const Point& direction) const;

  // Whether p is within a closed mesh, by its winding number.
  bool is_inside(std::size_t side, const Point& p) const;
  // The same by one ray, of the mesh as it was before it was made larger: for many questions.
  bool is_within(std::size_t side, const Point& p) const;

 private:
  Point turned_from_a(const Point& direction) const;

  std::array<const ContactMesh*, 2> meshes_;
  std::array<TestPose, 2> poses_;
  std::array<std::vector<Point>, 2> points_;
  std::array<ContactBox, 2> boxes_;
  Point offset_{};  // of A's origin, in the frame of B
  double epsilon_ = 0;
};

}  // namespace ode_ext::test
