// SPDX-License-Identifier: BSD-3-Clause
#include "reference/contact_features.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace ode_ext::test {
namespace {

// Six times the signed volume of the tetrahedron p, q, r, s.
double volume(const Point& p, const Point& q, const Point& r, const Point& s) {
  return dot(q - p, cross(r - p, s - p));
}

class Sets {
 public:
  void resize(std::size_t count) {
    for (std::size_t i = parents_.size(); i < count; ++i) parents_.push_back(i);
  }
  std::size_t find(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  // The lowest represents all.
  void join(std::size_t i, std::size_t j) {
    i = find(i), j = find(j);
    parents_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::size_t> parents_;
};

class FeatureFinder {
 public:
  explicit FeatureFinder(const ContactPair& pair) : pair_(pair) {}

  ContactFeatures find() {
    for (const std::size_t side : {0u, 1u}) cross_edges(side);
    crossing_count_ = all_.features.size();
    for (const std::size_t side : {0u, 1u}) {
      inside_[side].assign(pair_.mesh(side).vertices.size(), kNowhere);
      follow_edges(side);
      if (pair_.mesh(1 - side).closed) {
        flood(side);
        look_into_components(side);
      } else if (pair_.mesh(side).closed) {
        flood(side);
      }
    }
    link_curves();
    for (const std::size_t side : {0u, 1u}) link_edges(side);
    describe_regions();
    return std::move(all_);
  }

 private:
  // The sign of the edges' mutual orientation. Whoever has one of the edges asks in the same order
  // of the operands and so gets the same answer: no curve slips through between two triangles.
  bool passes_left(std::size_t edge_a, std::size_t edge_b) const {
    const auto &a = pair_.mesh(0).edges[edge_a].vertices, &b = pair_.mesh(1).edges[edge_b].vertices;
    return volume(pair_.vertex(0, a[0]), pair_.vertex(0, a[1]), pair_.vertex(1, b[0]),
                  pair_.vertex(1, b[1])) >= 0;
  }

  bool line_meets(std::size_t side, std::size_t edge, std::size_t triangle) const {
    const ContactMesh& other = pair_.mesh(1 - side);
    const auto left_of = [&](std::size_t k) {
      const std::size_t of_other = other.sides[triangle][k];
      const bool left = side == 0 ? passes_left(edge, of_other) : passes_left(of_other, edge);
      return left == (other.edges[of_other].vertices[0] == other.triangles[triangle][k]);
    };
    const bool first = left_of(0);
    return left_of(1) == first && left_of(2) == first;
  }

  void cross_edges(std::size_t side) {
    const ContactMesh &mesh = pair_.mesh(side), &other = pair_.mesh(1 - side);
    // The tree knows the other mesh before it was made larger.
    const double margin = pair_.epsilon() * 6;
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
      const ContactEdge& edge = mesh.edges[e];
      const Point &from = pair_.vertex(side, edge.vertices[0]),
                  &to = pair_.vertex(side, edge.vertices[1]);
      ContactBox box;
      box.add(pair_.into(1 - side, from));
      box.add(pair_.into(1 - side, to));
      const std::size_t first = all_.features.size();
      other.tree.near(box, margin, [&](std::size_t triangle) {
        const Point& corner = pair_.corner(1 - side, triangle, 0);
        const Point normal = cross(pair_.corner(1 - side, triangle, 1) - corner,
                                   pair_.corner(1 - side, triangle, 2) - corner);
        const double above = dot(from - corner, normal), beyond = dot(to - corner, normal);
        if ((above >= 0) == (beyond >= 0) || !line_meets(side, e, triangle)) return;
        const double t = above / (above - beyond);
        all_.features.push_back({side,
                                 e,
                                 triangle,
                                 kNowhere,
                                 t,
                                 above >= 0,
                                 edge.flat,
                                 from + t * (to - from),
                                 kNowhere,
                                 {}});
      });
      std::sort(all_.features.begin() + static_cast<std::ptrdiff_t>(first), all_.features.end(),
                [](const ContactFeature& a, const ContactFeature& b) {
                  return std::tie(a.t, a.enters, a.triangle) < std::tie(b.t, b.enters, b.triangle);
                });
      if (first < all_.features.size()) on_edge_[side][e] = {first, all_.features.size() - first};
    }
  }

  void mark_inside(std::size_t side, std::size_t vertex, bool first) {
    if (inside_[side][vertex] != kNowhere) return;
    std::vector<std::size_t> nearest;
    if (!pair_.mesh(1 - side).closed) {
      nearest = exit_of(side, vertex);
      if (!first && nearest.empty()) return;
    }
    inside_[side][vertex] = all_.features.size();
    all_.features.push_back({side, kNowhere, kNowhere, vertex, 0, false,
                             pair_.mesh(side).flat_vertices[vertex], pair_.vertex(side, vertex),
                             kNowhere, nearest});
    fronts_[side].push_back(vertex);
  }

  // Of an open mesh: the facet whose back the vertex' ray meets first, within the vertex' own body.
  std::vector<std::size_t> exit_of(std::size_t side, std::size_t vertex) const {
    const ContactMesh &mesh = pair_.mesh(side), &open = pair_.mesh(1 - side);
    const Point origin = pair_.into(1 - side, pair_.vertex(side, vertex));
    const auto hits = open.tree.along(
        origin, -1 * pair_.turned_into(1 - side, pair_.vertex_normal(side, vertex)));
    if (hits.empty() || !hits[0].back || hits[0].t > mesh.thickness_at(vertex)) return {};
    return {open.facet_of[hits[0].triangle]};
  }

  // How many surfaces an edge has entered and not left is counted from the least that never falls
  // below none: what is between two crossings with a count of one or more is inside.
  void follow_edges(std::size_t side) {
    for (const auto& [edge, range] : on_edge_[side]) {
      int count = 0, least = 0;
      for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        count += all_.features[i].enters ? 1 : -1;
        least = std::min(least, count);
      }
      const auto ends = pair_.mesh(side).edges[edge].vertices;
      if (least < 0) mark_inside(side, ends[0], true);
      if (count - least > 0) mark_inside(side, ends[1], true);
      starts_[side][edge] = -least;
    }
  }

  void flood(std::size_t side) {
    for (std::size_t head = 0; head < fronts_[side].size(); ++head) {
      for (const std::size_t e : pair_.mesh(side).edges_at[fronts_[side][head]]) {
        if (on_edge_[side].count(e) > 0) continue;
        for (const std::size_t next : pair_.mesh(side).edges[e].vertices)
          mark_inside(side, next, false);
      }
    }
  }

  // A component none of whose edges is crossed is inside as a whole, or outside.
  void look_into_components(std::size_t side) {
    const ContactMesh& mesh = pair_.mesh(side);
    std::vector<bool> known(mesh.component_count, false);
    for (const auto& [edge, range] : on_edge_[side])
      known[mesh.components[mesh.edges[edge].vertices[0]]] = true;
    std::vector<bool> contained(mesh.component_count, false);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const std::size_t c = mesh.components[v];
      if (!known[c]) contained[c] = pair_.is_inside(1 - side, pair_.vertex(side, v));
      known[c] = true;
      if (contained[c]) mark_inside(side, v, false);
    }
  }

  void link_curves() {
    sets_.resize(all_.features.size());
    std::map<std::array<std::size_t, 2>, std::vector<std::size_t>> crossings_of;
    for (std::size_t i = 0; i < crossing_count_; ++i) {
      const ContactFeature& c = all_.features[i];
      for (const std::size_t own : pair_.mesh(c.side).edges[c.edge].triangles) {
        if (own == kNowhere) continue;
        if (c.side == 0) crossings_of[{own, c.triangle}].push_back(i);
        if (c.side == 1) crossings_of[{c.triangle, own}].push_back(i);
      }
    }
    for (const auto& [triangles, found] : crossings_of) {
      if (found.size() != 2) ++all_.odd_pairs;
      for (const std::size_t i : found) sets_.join(found[0], i);
    }
  }

  void link_edges(std::size_t side) {
    const ContactMesh& mesh = pair_.mesh(side);
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
      const std::size_t from = inside_[side][mesh.edges[e].vertices[0]];
      const std::size_t to = inside_[side][mesh.edges[e].vertices[1]];
      const auto crossed = on_edge_[side].find(e);
      if (crossed == on_edge_[side].end()) {
        if (from != kNowhere && to != kNowhere) sets_.join(from, to);
        continue;
      }
      int count = starts_[side].at(e);
      std::size_t begin = count > 0 ? from : kNowhere;
      const auto& range = crossed->second;
      for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        const bool was_inside = count > 0;
        count += all_.features[i].enters ? 1 : -1;
        if (was_inside) sets_.join(begin, i);
        if (!was_inside) begin = i;
        if (was_inside && count == 0) add_chord(side, e, {begin, i});
      }
      if (count > 0 && to != kNowhere) {
        sets_.join(begin, to);
        add_chord(side, e, {begin, to});
      }
    }
  }

  void add_chord(std::size_t side, std::size_t edge, std::vector<std::size_t> ends) {
    if (pair_.mesh(side).edges[edge].flat) return;
    all_.units.push_back({side, edge, std::move(ends), kNowhere, {}});
  }

  void describe_regions() {
    std::vector<std::size_t> numbers(all_.features.size(), kNowhere);
    for (std::size_t i = 0; i < all_.features.size(); ++i) {
      ContactFeature& f = all_.features[i];
      std::size_t& number = numbers[sets_.find(i)];
      if (number == kNowhere) {
        number = all_.regions.size();
        all_.regions.push_back({{}, {}, true});
      }
      f.region = number;
      all_.regions[number].features.push_back(i);
      if (f.is_crossing() || f.flat) continue;
      if (pair_.mesh(1 - f.side).closed) f.nearest = nearest_facets(pair_, 1 - f.side, f.position);
      all_.units.push_back({f.side, kNowhere, {i}, number, f.nearest});
    }
    for (std::size_t i = 0; i < all_.units.size(); ++i) {
      ContactUnit& unit = all_.units[i];
      unit.region = all_.features[unit.ends[0]].region;
      all_.regions[unit.region].units.push_back(i);
      if (unit.edge == kNowhere || !pair_.mesh(1 - unit.side).closed) continue;
      unit.nearest = nearest_facets(
          pair_, 1 - unit.side,
          0.5 * (all_.features[unit.ends[0]].position + all_.features[unit.ends[1]].position));
    }
    for (ContactRegion& region : all_.regions) region.whole = is_whole(region);
  }

  // Where surfaces cross, what both are behind of is convex. So an overlap is convex unless an edge
  // within it is a valley; and what is contained leaves as one.
  bool is_whole(const ContactRegion& region) const {
    bool crossed = false, valley = false;
    const auto look = [&](std::size_t side, std::size_t edge) {
      valley = valley || pair_.mesh(side).edges[edge].rise > pair_.epsilon();
    };
    for (const std::size_t i : region.features) {
      const ContactFeature& f = all_.features[i];
      crossed = crossed || f.is_crossing();
      if (f.flat) continue;
      if (f.is_crossing()) look(f.side, f.edge);
      if (f.is_crossing()) continue;
      for (const std::size_t e : pair_.mesh(f.side).edges_at[f.vertex])
        if (!pair_.mesh(f.side).edges[e].flat) look(f.side, e);
    }
    return !crossed || !valley;
  }

  struct Range {
    std::size_t first, count;
  };
  const ContactPair& pair_;
  ContactFeatures all_;
  Sets sets_;
  std::size_t crossing_count_ = 0;
  std::array<std::map<std::size_t, Range>, 2> on_edge_;  // the crossings of each crossed edge
  std::array<std::map<std::size_t, int>, 2> starts_;     // what each crossed edge starts within
  std::array<std::vector<std::size_t>, 2> inside_;       // the feature of each vertex inside
  std::array<std::vector<std::size_t>, 2> fronts_;       // vertices inside as they are found
};

}  // namespace

ContactFeatures find_features(const ContactPair& pair) { return FeatureFinder(pair).find(); }

std::vector<std::size_t> nearest_facets(const ContactPair& pair, std::size_t side, const Point& p) {
  const ContactMesh& mesh = pair.mesh(side);
  std::set<std::size_t> facets;
  for (const std::size_t triangle : mesh.tree.nearest(pair.into(side, p), pair.epsilon()))
    facets.insert(mesh.facet_of[triangle]);
  return {facets.begin(), facets.end()};
}

}  // namespace ode_ext::test
