// SPDX-License-Identifier: BSD-3-Clause
// Features: where an edge of one mesh crosses a triangle of the other, and vertices of one inside
// the other. Regions: what hangs together of them. Units: what has to be cleared as one.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "reference/contact_pair.h"

namespace ode_ext::test {

struct ContactFeature {
  std::size_t side;      // whose edge or vertex it is
  std::size_t edge;      // kNowhere: a vertex inside
  std::size_t triangle;  // of the other mesh; of a vertex kNowhere
  std::size_t vertex;    // of a crossing kNowhere
  double t;              // of the edge's length, from its first vertex
  bool enters;           // on the way from the edge's first vertex
  bool flat;             // of a flat edge or vertex: it links, but is no geometry
  Point position;        // in the frame of B
  std::size_t region;
  // Facets of the other mesh by which a vertex leaves, ascending: the nearest, within eps; of an
  // open mesh what its ray meets from behind. Of a crossing none.
  std::vector<std::size_t> nearest;

  bool is_crossing() const { return edge != kNowhere; }
};

// A chord, which is a maximal stretch of an edge inside, or a vertex inside.
struct ContactUnit {
  std::size_t side;
  std::size_t edge;               // kNowhere: a vertex
  std::vector<std::size_t> ends;  // features: two, of a vertex one
  std::size_t region;
  std::vector<std::size_t> nearest;  // facets by which a vertex, or a chord's middle, leaves
};

struct ContactRegion {
  std::vector<std::size_t> features, units;
  bool whole;  // it is convex, or contained: it is cleared as one
};

struct ContactFeatures {
  std::vector<ContactFeature> features;  // crossings by side, edge and place; then vertices
  std::vector<ContactUnit> units;
  std::vector<ContactRegion> regions;
  int odd_pairs = 0;  // pairs of triangles with another number of crossings than none or two
};

ContactFeatures find_features(const ContactPair& pair);

// The facets of `side` that are nearest to a point, within eps: which of them is nearer by less is
// for rounding to decide.
std::vector<std::size_t> nearest_facets(const ContactPair& pair, std::size_t side, const Point& p);

}  // namespace ode_ext::test
