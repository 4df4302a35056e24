// SPDX-License-Identifier: BSD-3-Clause
// Do the surfaces of two meshes intersect, does one contain the other: answered by FCL and by
// winding numbers, in double precision and independently of the library.
#pragma once

#include <memory>
#include <vector>

#include "support/mesh_makers.h"
#include "support/regions.h"

namespace ode_ext::test {

enum class OracleAnswer {
  Apart,
  Intersect,
  Fragile  // moving one mesh by 1e-5 of the pair's size along some axis changes the answer
};

// A mesh made ready for many questions.
class FclSurface {
 public:
  explicit FclSurface(const TestMesh& mesh);

  struct Model;
  const Model& model() const { return *model_; }
  double size() const { return size_; }  // largest extent of the bounding box [m]

 private:
  std::shared_ptr<const Model> model_;
  double size_;
};

bool surfaces_intersect(const FclSurface& a, const TestPose& pa, const FclSurface& b,
                        const TestPose& pb);
// Every triangle of a with every triangle of b that it meets.
std::vector<TrianglePair> intersecting_triangles(const FclSurface& a, const TestPose& pa,
                                                 const FclSurface& b, const TestPose& pb);

// The poses of a moved by +-`distance` [m] along each axis of the world.
std::vector<TestPose> nudged(const TestPose& pose, double distance);

// The same for meshes that are asked about once.
bool surfaces_intersect(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                        const TestPose& pb);

OracleAnswer surfaces_intersect_robustly(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                         const TestPose& pb);

// How often the mesh winds around a point of its own frame: 1 inside a closed outward mesh, -1 in
// an inverted one, 0 outside (van Oosterom and Strackee 1983: the sum of the triangles' solid
// angles).
double winding_number(const TestMesh& mesh, const Point& point);

// Whether the first vertex of one mesh is inside the other; both closed.
bool one_contains_the_other(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                            const TestPose& pb);

}  // namespace ode_ext::test
