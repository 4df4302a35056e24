// SPDX-License-Identifier: BSD-3-Clause
// What the numbers in contact ids are of, found from where the contacts are: of each number, the
// vertices, edges or planes of the mesh on which every contact with it was. Where none is left, one
// number was given to two features.
#pragma once

#include <ode_ext/ode_ext.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "support/ode_world.h"

namespace ode_ext::test {

inline unsigned kind_of(unsigned feature) { return feature >> dBatchFeatureShift; }

class FeatureWatch {
 public:
  // Triangles in one plane are one facet, unless `each` is one.
  explicit FeatureWatch(const TestMesh& mesh, bool each = false);
  // The mesh in another shape.
  void reshape(const TestMesh& mesh) { mesh_ = mesh; }

  // A contact, in the frame of the mesh, with `feature` of it and `other` of the other mesh. "" or
  // what is wrong.
  std::string see(unsigned feature, unsigned other, const Point& place, const Point& normal,
                  double depth);
  // "" or two numbers of one feature.
  std::string doubles() const;
  std::size_t count(unsigned kind) const;

  // Unit: along an edge, across a facet; none where it is not known which one it is.
  std::optional<Point> direction(unsigned feature) const;

 private:
  using Places = std::set<std::size_t>;
  Point normal_of(std::size_t facet) const;
  Point along(std::size_t edge) const;
  Places places(unsigned feature, unsigned other, const Point& place, const Point& normal,
                double depth) const;

  TestMesh mesh_;
  std::vector<std::array<unsigned, 2>> edges_;  // corners
  std::vector<std::size_t> facets_;             // a triangle of each
  std::map<unsigned, Places> known_;            // by feature
};

// Those of the geoms of a pair.
struct PairWatch {
  FeatureWatch first, second;

  // Contacts with g1 of the first mesh, at these poses. "" or what is wrong.
  std::string see(const Contacts& contacts, const std::vector<dBatchContactId>& ids,
                  const TestPose& pose1, const TestPose& pose2);
};

}  // namespace ode_ext::test
