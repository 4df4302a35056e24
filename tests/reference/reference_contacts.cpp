// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_contacts.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "reference/contact_constants.h"
#include "support/thickness.h"

namespace ode_ext::test {
namespace {

constexpr double kInfinity = ContactBox::infinity;

class ContactMaker {
 public:
  ContactMaker(const ContactPair& pair, const ContactFeatures& features,
               const std::vector<ContactManifold>& manifolds)
      : pair_(pair), features_(features), manifolds_(manifolds) {}

  std::vector<ReferenceContact> make() {
    for (number_ = 0; number_ < manifolds_.size(); ++number_) {
      const ContactManifold& m = manifolds_[number_];
      if (m.plane.kind == PlaneKind::kEdges) add_midway(m);
      add_features(m);
    }
    std::stable_sort(made_.begin(), made_.end(),
                     [](const ReferenceContact& a, const ReferenceContact& b) {
                       return std::tie(b.depth, a.manifold, a.feature, a.position) <
                              std::tie(a.depth, b.manifold, b.feature, b.position);
                     });
    return std::move(made_);
  }

 private:
  void add(const ContactManifold& m, const Point& position, double depth,
           const std::array<std::size_t, 2>& triangles, std::size_t feature) {
    const auto source = [&](std::size_t side) {
      return pair_.mesh(side).source_triangle[triangles[side]];
    };
    made_.push_back({pair_.to_world(position),
                     pair_.turned_to_world(m.plane.normal),
                     std::max(depth - kContactSlop * pair_.epsilon(), 0.0),
                     {source(0), source(1)},
                     m.region,
                     number_,
                     feature});
  }

  // On the plane's own facet is the rim where the body comes out: it holds nothing that what is
  // below does not, unless there is nothing below.
  bool is_on_rim(const ContactFeature& f, std::size_t plane_side, std::size_t facet) const {
    if (!f.is_crossing()) return false;
    const FacetsAt at = facets_at(pair_, f);
    if (f.side != plane_side) return at.crossed == facet;
    return at.of_edge[0] == facet || at.of_edge[1] == facet;
  }

  void add_features(const ContactManifold& m) {
    const bool of_b = m.plane.kind != PlaneKind::kFaceOfA;
    const std::size_t plane_side = of_b ? 1 : 0;
    const std::size_t facet = m.plane.kind == PlaneKind::kEdges
                                  ? pair_.mesh(1).facet_at(m.plane.of_b, 0)
                              : of_b ? m.plane.of_b
                                     : m.plane.of_a;
    const bool rim_only = std::all_of(m.features.begin(), m.features.end(), [&](std::size_t i) {
      return is_on_rim(features_.features[i], plane_side, facet);
    });
    for (const std::size_t i : m.features) {
      const ContactFeature& f = features_.features[i];
      if (!rim_only && is_on_rim(f, plane_side, facet)) continue;
      const double height = dot(m.plane.normal, f.position);
      const double depth = of_b ? m.plane.top - height : height - m.plane.bottom;
      if (depth < -pair_.epsilon()) continue;
      add(m, f.position, depth, triangles_of(f, plane_side, facet), i);
    }
  }

  std::array<std::size_t, 2> triangles_of(const ContactFeature& f, std::size_t plane_side,
                                          std::size_t facet) const {
    std::array<std::size_t, 2> triangles{};
    if (f.is_crossing()) {
      triangles[f.side] = pair_.mesh(f.side).edges[f.edge].triangles[0];
      triangles[1 - f.side] = f.triangle;
    } else {
      triangles[f.side] =
          pair_.mesh(f.side).edges[pair_.mesh(f.side).edges_at[f.vertex][0]].triangles[0];
    }
    triangles[plane_side] = pair_.mesh(plane_side).facets[facet].largest;
    return triangles;
  }

  // What of an edge takes part in the region, as shares of its length: nothing, if from > to.
  std::array<double, 2> stretch(std::size_t region, std::size_t side, std::size_t edge) const {
    double from = kInfinity, to = -kInfinity;
    const auto& ends = pair_.mesh(side).edges[edge].vertices;
    for (const std::size_t i : features_.regions[region].features) {
      const ContactFeature& f = features_.features[i];
      if (f.side != side) continue;
      double t = f.t;
      if (!f.is_crossing() && f.vertex != ends[0] && f.vertex != ends[1]) continue;
      if (f.is_crossing() && f.edge != edge) continue;
      if (!f.is_crossing()) t = f.vertex == ends[0] ? 0 : 1;
      from = std::min(from, t);
      to = std::max(to, t);
    }
    return {from, to};
  }

  // Of a side's features the one that has the farthest to go; of what has none (it contains the
  // other) that of the other.
  Point farthest(const ContactManifold& m, std::size_t side) const {
    const double sign = side == 0 ? 1 : -1;
    Point best{};
    double least = kInfinity;
    for (const bool own : {true, false}) {
      for (const std::size_t i : features_.regions[m.region].features) {
        const ContactFeature& f = features_.features[i];
        const double height = sign * dot(m.plane.normal, f.position);
        if (f.flat || (own && !f.is_crossing() && f.side != side) || height >= least) continue;
        least = height;
        best = f.position;
      }
      if (least < kInfinity) break;
    }
    return best;
  }

  // Where the two edges pass one another, seen along the normal, and midway there; within the
  // region, for a pair of bodies may touch in many. An edge that takes no part in it gives way to
  // the feature that has the farthest to go.
  void add_midway(const ContactManifold& m) {
    const std::array<std::size_t, 2> edges{m.plane.of_a, m.plane.of_b};
    std::array<Point, 2> from, along, on;
    for (const std::size_t side : {0u, 1u}) {
      const auto& ends = pair_.mesh(side).edges[edges[side]].vertices;
      from[side] = pair_.vertex(side, ends[0]);
      along[side] = pair_.vertex(side, ends[1]) - from[side];
    }
    const double area = dot(cross(along[0], along[1]), m.plane.normal);
    for (const std::size_t side : {0u, 1u}) {
      const auto [least, most] = stretch(m.region, side, edges[side]);
      if (least > most) {
        on[side] = farthest(m, side);
        continue;
      }
      const double t = dot(cross(from[1] - from[0], along[1 - side]), m.plane.normal) / area;
      on[side] = from[side] + std::clamp(t, least, most) * along[side];
    }
    const std::array<std::size_t, 2> triangles{pair_.mesh(0).edges[edges[0]].triangles[0],
                                               pair_.mesh(1).edges[edges[1]].triangles[0]};
    add(m, 0.5 * (on[0] + on[1]), m.depth, triangles, kNowhere);
  }

  const ContactPair& pair_;
  const ContactFeatures& features_;
  const std::vector<ContactManifold>& manifolds_;
  std::size_t number_ = 0;
  std::vector<ReferenceContact> made_;
};

}  // namespace

std::vector<ReferenceContact> contacts_of(const ContactPair& pair, const ContactFeatures& features,
                                          const std::vector<ContactManifold>& manifolds) {
  return ContactMaker(pair, features, manifolds).make();
}

ReferenceContacts reference_contacts(const ContactMesh& a, const TestPose& pa, const ContactMesh& b,
                                     const TestPose& pb, const ContactOptions& options) {
  const ContactPair pair(a, pa, b, pb);
  ReferenceContacts result{};
  result.epsilon = pair.epsilon();
  if (a.triangles.empty() || b.triangles.empty()) return result;
  result.found = find_features(pair);
  result.manifolds = find_manifolds(pair, result.found, options);
  result.all = contacts_of(pair, result.found, result.manifolds);
  const auto half_across = [](const ContactMesh& mesh, const TestPose& pose, const Point& normal) {
    if (!mesh.closed) return ContactBox::infinity;
    const ContactBox& box = mesh.tree.bounds();
    return half_thickness_across(0.5 * (box.high - box.low), rotate_back(pose, normal));
  };
  result.contacts = reduced(result.all, options.max_contacts, [&](const Point& normal) {
    return std::min({kMergeDistance * std::min(a.radius, b.radius), half_across(a, pa, normal),
                     half_across(b, pb, normal)});
  });
  return result;
}

}  // namespace ode_ext::test
