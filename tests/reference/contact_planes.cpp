// SPDX-License-Identifier: BSD-3-Clause
#include "reference/contact_planes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace ode_ext::test {
namespace {

constexpr double kInfinity = ContactBox::infinity;

// The sine of an angle below which a cross product of directions between float corners is made of
// their rounding.
constexpr double kParallel = 0x1p-20;

// Whether the faces at an edge lie below the plane through it, and look up.
bool supports(const ContactPair& pair, std::size_t side, std::size_t e, const Point& up) {
  const ContactMesh& mesh = pair.mesh(side);
  const ContactEdge& edge = mesh.edges[e];
  const Point& on_edge = pair.vertex(side, edge.vertices[0]);
  double outward = 0;
  for (const std::size_t t : edge.triangles) {
    if (t == kNowhere) continue;
    outward += dot(pair.normal(side, mesh.facet_of[t]), up);
    for (std::size_t k = 0; k < 3; ++k)
      if (dot(pair.corner(side, t, k) - on_edge, up) > pair.epsilon()) return false;
  }
  return outward > 0;
}

}  // namespace

std::optional<ContactPlane> face_plane(const ContactPair& pair, std::size_t side,
                                       std::size_t facet) {
  const Point normal = pair.normal(side, facet);
  if (length(normal) == 0) return std::nullopt;
  const double top = pair.top(side, facet);
  if (side == 1) return ContactPlane{PlaneKind::kFaceOfB, kNowhere, facet, normal, top, kInfinity};
  return ContactPlane{PlaneKind::kFaceOfA, facet, kNowhere, -1 * normal, -kInfinity, -top};
}

std::optional<ContactPlane> edge_plane(const ContactPair& pair, std::size_t edge_a,
                                       std::size_t edge_b) {
  const auto &a = pair.mesh(0).edges[edge_a].vertices, &b = pair.mesh(1).edges[edge_b].vertices;
  const Point along_a = pair.vertex(0, a[1]) - pair.vertex(0, a[0]);
  const Point along_b = pair.vertex(1, b[1]) - pair.vertex(1, b[0]);
  const Point common = cross(along_a, along_b);
  if (!(length(common) > kParallel * length(along_a) * length(along_b))) return std::nullopt;
  for (const double sign : {1.0, -1.0}) {
    const Point normal = sign * unit(common);
    const double top = dot(normal, pair.vertex(1, b[0]));
    const double bottom = dot(normal, pair.vertex(0, a[0]));
    if (top < bottom || !supports(pair, 1, edge_b, normal) ||
        !supports(pair, 0, edge_a, -1 * normal))
      continue;
    return ContactPlane{PlaneKind::kEdges, edge_a, edge_b, normal, top, bottom};
  }
  return std::nullopt;
}

FacetsAt facets_at(const ContactPair& pair, const ContactFeature& crossing) {
  const ContactMesh& mesh = pair.mesh(crossing.side);
  return {{mesh.facet_at(crossing.edge, 0), mesh.facet_at(crossing.edge, 1)},
          pair.mesh(1 - crossing.side).facet_of[crossing.triangle]};
}

ContactExtent::ContactExtent(const ContactPair& pair, const ContactFeatures& features,
                             std::size_t region, bool by_component)
    : pair_(pair) {
  std::array<std::vector<bool>, 2> taking_part;
  for (const std::size_t side : {0u, 1u})
    taking_part[side].assign(pair.mesh(side).component_count, !by_component);
  for (const std::size_t i : features.regions[region].features) {
    const ContactFeature& f = features.features[i];
    const ContactMesh &mesh = pair.mesh(f.side), &other = pair.mesh(1 - f.side);
    const std::size_t vertex = f.is_crossing() ? mesh.edges[f.edge].vertices[0] : f.vertex;
    taking_part[f.side][mesh.components[vertex]] = true;
    if (f.is_crossing())
      taking_part[1 - f.side][other.components[other.triangles[f.triangle][0]]] = true;
  }
  for (const std::size_t side : {0u, 1u})
    for (std::size_t v = 0; v < pair.mesh(side).vertices.size(); ++v)
      if (taking_part[side][pair.mesh(side).components[v]]) vertices_[side].push_back(v);
}

double ContactExtent::lowest_of_a(const Point& normal) const {
  double lowest = kInfinity;
  for (const std::size_t v : vertices_[0])
    lowest = std::min(lowest, dot(normal, pair_.vertex(0, v)));
  return lowest;
}

double ContactExtent::highest_of_b(const Point& normal) const {
  double highest = -kInfinity;
  for (const std::size_t v : vertices_[1])
    highest = std::max(highest, dot(normal, pair_.vertex(1, v)));
  return highest;
}

PlaneJudge::PlaneJudge(const ContactPair& pair, const ContactFeatures& features, std::size_t region,
                       const ContactOptions& options)
    : pair_(pair),
      features_(features),
      options_(options),
      extent_(pair, features, region, options.by_component) {
  std::array<std::set<std::size_t>, 2> crossed;
  for (const std::size_t i : features.regions[region].features) {
    const ContactFeature& f = features.features[i];
    if (f.flat) continue;
    on_[f.side].push_back(i);
    if (!f.is_crossing()) continue;
    on_[1 - f.side].push_back(i);
    const FacetsAt at = facets_at(pair, f);
    crossed[1 - f.side].insert(at.crossed);
    for (const std::size_t facet : at.of_edge)
      if (facet != kNowhere) crossed[f.side].insert(facet);
  }
  for (const std::size_t side : {0u, 1u})
    for (const std::size_t facet : crossed[side])
      gone_through_[side].push_back(pair.normal(side, facet));
}

double PlaneJudge::judged(const ContactPlane& plane, double depth, double beyond) const {
  double value = depth;
  if (beyond > 0) value = std::max(value, beyond + kBeyondTie * pair_.epsilon());
  if (plane.kind != PlaneKind::kEdges) return value;
  return options_.prefer_faces * value + options_.edge_tie * pair_.epsilon();
}

PlaneCost PlaneJudge::of_region(const ContactPlane& plane, double bound) {
  const PlaneCost refused{kInfinity, kInfinity};
  const Point& n = plane.normal;
  // Of what is contained one mesh alone has features; of a pair of edges the other edge will do.
  if (!(plane.moves(0) && !on_[0].empty()) && !(plane.moves(1) && !on_[1].empty())) return refused;
  const double factor = plane.kind == PlaneKind::kEdges ? options_.prefer_faces : 1;
  double low = plane.bottom, high = plane.top;
  // Where the last search ended is a good guess, and most planes are refused by it.
  for (const std::size_t side : {0u, 1u}) {
    std::size_t& extreme = extreme_[side];
    for (std::size_t k = 0; k <= on_[side].size() && !on_[side].empty(); ++k) {
      const std::size_t at = k == 0 ? extreme : k - 1;
      const double height = dot(n, features_.features[on_[side][at]].position);
      // What is past the plane already is no part of what it clears.
      if (side == 0 ? height > plane.top + pair_.epsilon() && plane.moves(0)
                    : height < plane.bottom - pair_.epsilon() && plane.moves(1))
        return refused;
      if (side == 0 ? height < low : height > high) {
        (side == 0 ? low : high) = height;
        extreme = at;
      }
      if (factor * (high - low) > bound) return refused;
    }
  }
  double beyond = 0;
  const auto looks_back = [&](std::size_t side, double sign) {
    return std::any_of(gone_through_[side].begin(), gone_through_[side].end(),
                       [&](const Point& m) { return sign * dot(m, n) < kLooksBack; });
  };
  if (plane.moves(0) && looks_back(1, 1)) beyond = high - extent_.lowest_of_a(n);
  if (plane.moves(1) && looks_back(0, -1)) beyond = std::max(beyond, extent_.highest_of_b(n) - low);
  return {high - low, judged(plane, high - low, beyond)};
}

double PlaneJudge::depth_of_unit(const ContactPlane& plane, const ContactUnit& unit) const {
  if (!plane.moves(unit.side)) return kInfinity;
  double deepest = -kInfinity, sum = 0;
  for (const std::size_t end : unit.ends) {
    const double height = dot(plane.normal, features_.features[end].position);
    const double depth = unit.side == 0 ? plane.top - height : height - plane.bottom;
    deepest = std::max(deepest, depth);
    sum += depth;
  }
  // Its middle is inside the other mesh: a plane that it is above is not one to leave by.
  const double middle = sum / static_cast<double>(unit.ends.size());
  return middle < -pair_.epsilon() ? kInfinity : std::max(deepest, 0.0);
}

PlaneCost PlaneJudge::of_unit(const ContactPlane& plane, const ContactUnit& unit) const {
  const double depth = depth_of_unit(plane, unit);
  if (depth == kInfinity) return {depth, depth};
  bool goes_on = false;
  const double sign = unit.side == 0 ? 1 : -1;
  for (const std::size_t end : unit.ends) {
    const ContactFeature& f = features_.features[end];
    if (!f.is_crossing()) continue;
    const Point m = pair_.normal(1 - unit.side, facets_at(pair_, f).crossed);
    goes_on = goes_on || sign * dot(m, plane.normal) < kLooksBack;
  }
  double beyond = 0;
  if (goes_on)
    beyond = unit.side == 0 ? plane.top - extent_.lowest_of_a(plane.normal)
                            : extent_.highest_of_b(plane.normal) - plane.bottom;
  return {depth, judged(plane, depth, beyond)};
}

}  // namespace ode_ext::test
