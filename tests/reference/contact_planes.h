// SPDX-License-Identifier: BSD-3-Clause
// Planes: candidates for the separation of a region, and what each of them costs.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "reference/contact_constants.h"
#include "reference/contact_features.h"

namespace ode_ext::test {

struct ContactOptions {
  double prefer_faces = 1;  // a pair of edges has to be so many times shallower than a face
  std::size_t max_contacts = 16;
  double edge_tie = kDepthTie;    // [eps] and by that
  bool hold_along_edges = false;  // a pair of edges has all of the region in contact, not a point
  bool all_edge_pairs = true;     // of a whole region's faces; false: of those that cross alone
  bool walk = true;               // from the chosen axis to its neighbours until none is less
  bool check_ways = true;         // refuse a plane beyond which the body is still within the other
  bool support_all = true;        // what a move clears by another plane is held by that
  bool by_component = true;       // what lies beyond is of the components that overlap, not all
};

enum class PlaneKind { kFaceOfB, kFaceOfA, kEdges };

// What of A is below the top has to rise to it; what of B is above the bottom has to sink to it. A
// face of B has no bottom (infinity), a face of A no top (minus infinity), a pair of edges both.
struct ContactPlane {
  PlaneKind kind;
  std::size_t of_a, of_b;  // facets, or edges; kNowhere where there is none
  Point normal;            // unit, in the frame of B: pushes A
  double top, bottom;      // [m] along the normal

  bool moves(std::size_t side) const {
    return kind == PlaneKind::kEdges || (kind == PlaneKind::kFaceOfB) == (side == 0);
  }
  auto key() const { return std::tuple(kind, of_a, of_b); }
};

// A facet of `side`; nothing where it has no area.
std::optional<ContactPlane> face_plane(const ContactPair& pair, std::size_t side,
                                       std::size_t facet);
// The common normal of two edges, if both meshes lie on their own sides of it there.
std::optional<ContactPlane> edge_plane(const ContactPair& pair, std::size_t edge_a,
                                       std::size_t edge_b);

struct PlaneCost {
  double depth;   // [m] what it takes to clear the plane; infinity: it does not apply
  double judged;  // by which planes are compared
};

// How far a mesh reaches along directions, as far as its components take part in a region.
class ContactExtent {
 public:
  ContactExtent(const ContactPair& pair, const ContactFeatures& features, std::size_t region,
                bool by_component);
  double lowest_of_a(const Point& normal) const;
  double highest_of_b(const Point& normal) const;

 private:
  const ContactPair& pair_;
  std::array<std::vector<std::size_t>, 2> vertices_;
};

// What a plane costs: `depth` to clear it; more where the moved body goes on through faces of the
// other that look back, and a little where the plane is a pair of edges.
class PlaneJudge {
 public:
  PlaneJudge(const ContactPair& pair, const ContactFeatures& features, std::size_t region,
             const ContactOptions& options);

  // For all of the region. Anything not less than `bound` may come as infinity.
  PlaneCost of_region(const ContactPlane& plane, double bound);
  // For a unit of it.
  PlaneCost of_unit(const ContactPlane& plane, const ContactUnit& unit) const;
  double depth_of_unit(const ContactPlane& plane, const ContactUnit& unit) const;

  // The region's features on a side's surface: its vertices inside and all crossings.
  const std::vector<std::size_t>& on(std::size_t side) const { return on_[side]; }

 private:
  double judged(const ContactPlane& plane, double depth, double beyond) const;

  const ContactPair& pair_;
  const ContactFeatures& features_;
  const ContactOptions& options_;
  ContactExtent extent_;
  std::array<std::vector<std::size_t>, 2> on_;
  std::array<std::vector<Point>, 2> gone_through_;  // normals of a side's crossed facets
  std::array<std::size_t, 2> extreme_{0, 0};        // of on_, at which the last search ended
};

// The facets at a feature that is a crossing: of its edge, and the one it crosses.
struct FacetsAt {
  std::array<std::size_t, 2> of_edge;  // of the feature's side; the second may be kNowhere
  std::size_t crossed;                 // of the other
};
FacetsAt facets_at(const ContactPair& pair, const ContactFeature& crossing);

}  // namespace ode_ext::test
