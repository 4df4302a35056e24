// SPDX-License-Identifier: BSD-3-Clause
// The plane of a region that is cleared as one: a separating axis test of what of both meshes is at
// hand there.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "reference/contact_manifolds.h"

namespace ode_ext::test {
namespace {

constexpr double kInfinity = ContactBox::infinity;

// The normals between those of an edge's two faces are an arc on the sphere; a pair of edges is an
// axis only if their arcs cross. This box holds the arc: it bulges over its chord by the sagitta.
ContactBox arc_box(const ContactPair& pair, std::size_t side, std::size_t e, double sign) {
  const ContactMesh& mesh = pair.mesh(side);
  const std::size_t second = mesh.facet_at(e, 1);
  const Point u = sign * pair.normal(side, mesh.facet_at(e, 0));
  ContactBox box;
  if (second == kNowhere) {  // a rim: any direction may be one of its
    box.add({-1, -1, -1});
    box.add({1, 1, 1});
    return box;
  }
  const Point v = sign * pair.normal(side, second);
  const double half = 0.5 * distance(u, v);
  const double sagitta = 1 - std::sqrt(std::max(0.0, 1 - half * half)) + 1e-6;
  for (const Point& p : {u, v}) {
    box.add(p - Point{sagitta, sagitta, sagitta});
    box.add(p + Point{sagitta, sagitta, sagitta});
  }
  return box;
}

class WholeRegion {
 public:
  WholeRegion(const ContactPair& pair, const ContactFeatures& features, std::size_t region,
              const ContactOptions& options, const std::vector<Point>& taken)
      : pair_(pair),
        features_(features),
        region_(region),
        options_(options),
        taken_(taken),
        judge_(pair, features, region, options) {}

  std::vector<ContactManifold> clear() {
    find_facets();
    std::optional<ContactPlane> first;
    double first_depth = 0;
    // A plane beyond which the body is still within the other does not part them; where all are
    // such, the least is as good as any.
    const std::size_t tries = options_.check_ways ? 4 : 1;
    for (std::size_t i = 0; i < tries; ++i) {
      search();
      if (!best_) break;
      if (!first) first = best_, first_depth = depth_;
      if (!options_.check_ways || !is_stuck()) return {manifold(*best_, depth_)};
      refused_.push_back(*best_);
    }
    if (!first) return {};
    return {manifold(*first, first_depth)};
  }

 private:
  // Faces at features, and nearest to vertices inside and to chords' middles.
  void find_facets() {
    const ContactRegion& region = features_.regions[region_];
    const auto add = [&](std::size_t side, std::size_t facet) {
      if (facet != kNowhere) facets_[side].insert(facet);
    };
    for (const std::size_t i : region.features) {
      const ContactFeature& f = features_.features[i];
      if (f.flat) continue;
      if (!f.is_crossing()) {
        for (const std::size_t e : pair_.mesh(f.side).edges_at[f.vertex])
          for (const std::size_t k : {0u, 1u}) add(f.side, pair_.mesh(f.side).facet_at(e, k));
        continue;
      }
      const FacetsAt at = facets_at(pair_, f);
      add(1 - f.side, at.crossed);
      for (const std::size_t facet : at.of_edge) add(f.side, facet);
    }
    for (const std::size_t i : region.units)
      for (const std::size_t facet : features_.units[i].nearest)
        add(1 - features_.units[i].side, facet);
  }

  void search() {
    best_.reset();
    depth_ = judged_ = kInfinity;
    for (const std::size_t side : {1u, 0u})
      for (const std::size_t facet : facets_[side]) consider(face_plane(pair_, side, facet));
    consider_edges();
    if (!options_.walk) return;
    for (const ContactPlane& plane : refused_) step(plane);
    while (best_ && step(*best_)) {
    }
  }

  // What faces the way of a plane that does not part them does not either.
  bool is_refused(const Point& normal) const {
    return std::any_of(refused_.begin(), refused_.end(), [&](const ContactPlane& plane) {
      return dot(plane.normal, normal) > kSamePatch;
    });
  }

  bool consider(const std::optional<ContactPlane>& plane) {
    if (!plane || is_refused(plane->normal)) return false;
    const double detour = opposes(plane->normal, taken_) ? kDetour : 1;
    PlaneCost cost = judge_.of_region(*plane, judged_ / detour);
    cost.judged *= detour;
    if (!(cost.judged < kInfinity)) return false;
    if (best_ &&
        (cost.judged > judged_ || (cost.judged == judged_ && plane->key() >= best_->key())))
      return false;
    best_ = plane;
    depth_ = cost.depth;
    judged_ = cost.judged;
    return true;
  }

  // Convex edges of the facets, or those that cross.
  std::vector<std::size_t> edges_of(std::size_t side) const {
    std::set<std::size_t> edges;
    if (options_.all_edge_pairs) {
      for (const std::size_t facet : facets_[side])
        for (const std::size_t e : pair_.mesh(side).facets[facet].edges) edges.insert(e);
    } else {
      for (const std::size_t i : features_.regions[region_].features) {
        const ContactFeature& f = features_.features[i];
        if (f.side == side && f.is_crossing() && !f.flat) edges.insert(f.edge);
      }
    }
    std::vector<std::size_t> convex;
    for (const std::size_t e : edges)
      if (pair_.mesh(side).edges[e].rise <= pair_.epsilon()) convex.push_back(e);
    return convex;
  }

  // Sorted along x, so that arcs are compared with those abreast alone.
  void consider_edges() {
    struct Arc {
      ContactBox box;
      std::size_t edge;
    };
    std::array<std::vector<Arc>, 2> arcs;
    for (const std::size_t side : {0u, 1u}) {
      for (const std::size_t e : edges_of(side))
        arcs[side].push_back({arc_box(pair_, side, e, side == 0 ? -1 : 1), e});
      std::sort(arcs[side].begin(), arcs[side].end(), [](const Arc& a, const Arc& b) {
        return std::pair(a.box.low[0], a.edge) < std::pair(b.box.low[0], b.edge);
      });
    }
    for (const std::size_t side : {0u, 1u}) {
      std::size_t first = 0;
      for (const Arc& arc : arcs[side]) {
        const auto& others = arcs[1 - side];
        const auto starts_before = [&](const Arc& other) {
          return side == 0 ? other.box.low[0] < arc.box.low[0] : other.box.low[0] <= arc.box.low[0];
        };
        while (first < others.size() && starts_before(others[first])) ++first;
        for (std::size_t k = first; k < others.size() && others[k].box.low[0] <= arc.box.high[0];
             ++k) {
          if (!arc.box.meets(others[k].box, 0)) continue;
          consider(side == 0 ? edge_plane(pair_, arc.edge, others[k].edge)
                             : edge_plane(pair_, others[k].edge, arc.edge));
        }
      }
    }
  }

  // To the best neighbour of an axis on the map of directions. False: none is less.
  bool step(const ContactPlane plane) {
    bool better = false;
    const auto consider_pairs = [&](const std::vector<std::size_t>& of_a,
                                    const std::vector<std::size_t>& of_b) {
      for (const std::size_t a : of_a)
        for (const std::size_t b : of_b)
          if (!pair_.mesh(0).edges[a].flat && !pair_.mesh(1).edges[b].flat)
            better = consider(edge_plane(pair_, a, b)) || better;
    };
    if (plane.kind != PlaneKind::kEdges) {
      const std::size_t face_side = plane.kind == PlaneKind::kFaceOfB ? 1 : 0;
      const std::size_t facet = face_side == 1 ? plane.of_b : plane.of_a;
      const auto& rim = pair_.mesh(face_side).facets[facet].edges;
      const std::vector<std::size_t> below = edges_below(plane, 1 - face_side);
      face_side == 1 ? consider_pairs(below, rim) : consider_pairs(rim, below);
      return better;
    }
    const std::array<std::size_t, 2> edges{plane.of_a, plane.of_b};
    for (const std::size_t side : {0u, 1u}) {
      for (const std::size_t k : {0u, 1u}) {
        const std::size_t facet = pair_.mesh(side).facet_at(edges[side], k);
        if (facet != kNowhere) better = consider(face_plane(pair_, side, facet)) || better;
        const std::size_t v = pair_.mesh(side).edges[edges[side]].vertices[k];
        const auto& there = pair_.mesh(side).edges_at[v];
        side == 0 ? consider_pairs(there, {plane.of_b}) : consider_pairs({plane.of_a}, there);
      }
    }
    return better;
  }

  // The lowest along the plane's normal (end 0) or highest (end 1) of a side's features.
  std::size_t farthest(const ContactPlane& plane, std::size_t side, std::size_t end) const {
    const auto& on = judge_.on(side);
    const double sign = end == 0 ? 1 : -1;
    return *std::min_element(on.begin(), on.end(), [&](std::size_t i, std::size_t j) {
      return sign * dot(plane.normal, features_.features[i].position) <
             sign * dot(plane.normal, features_.features[j].position);
    });
  }

  // The edges of a side at what of it is deepest past the plane, within eps.
  std::vector<std::size_t> edges_below(const ContactPlane& plane, std::size_t side) const {
    std::set<std::size_t> edges;
    if (judge_.on(side).empty()) return {};
    const double sign = side == 0 ? 1 : -1;
    const double least =
        sign * dot(plane.normal, features_.features[farthest(plane, side, side)].position);
    for (const std::size_t i : judge_.on(side)) {
      const ContactFeature& f = features_.features[i];
      if (sign * dot(plane.normal, f.position) > least + pair_.epsilon()) continue;
      if (!f.is_crossing()) {
        const auto& there = pair_.mesh(side).edges_at[f.vertex];
        edges.insert(there.begin(), there.end());
      } else if (f.side == side) {
        edges.insert(f.edge);
      } else {
        const auto& rim = pair_.mesh(side).facets[facets_at(pair_, f).crossed].edges;
        edges.insert(rim.begin(), rim.end());
      }
    }
    return {edges.begin(), edges.end()};
  }

  // Whether what of a body goes first or last is within the other where the plane sends it.
  bool is_stuck() const {
    for (const std::size_t side : {0u, 1u}) {
      if (!best_->moves(side) || judge_.on(side).empty()) continue;
      for (const std::size_t end : {side, 1 - side}) {
        const Point& at = features_.features[farthest(*best_, side, end)].position;
        if (stays_inside(pair_, side, at, *best_, depth_)) return true;
      }
    }
    return false;
  }

  ContactManifold manifold(const ContactPlane& plane, double depth) const {
    ContactManifold made{region_, plane, depth, {}, features_.regions[region_].units};
    if (plane.kind == PlaneKind::kFaceOfB) made.features = judge_.on(0);
    if (plane.kind == PlaneKind::kFaceOfA) made.features = judge_.on(1);
    if (plane.kind == PlaneKind::kEdges && options_.hold_along_edges) made.features = judge_.on(0);
    std::sort(made.features.begin(), made.features.end());
    return made;
  }

  const ContactPair& pair_;
  const ContactFeatures& features_;
  const std::size_t region_;
  const ContactOptions& options_;
  const std::vector<Point>& taken_;
  PlaneJudge judge_;
  std::array<std::set<std::size_t>, 2> facets_;
  std::vector<ContactPlane> refused_;
  std::optional<ContactPlane> best_;
  double depth_ = kInfinity, judged_ = kInfinity;
};

}  // namespace

std::vector<ContactManifold> clear_whole(const ContactPair& pair, const ContactFeatures& features,
                                         std::size_t region, const ContactOptions& options,
                                         const std::vector<Point>& taken) {
  return WholeRegion(pair, features, region, options, taken).clear();
}

}  // namespace ode_ext::test
