// SPDX-License-Identifier: BSD-3-Clause
#include "support/regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace ode_ext::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr unsigned kNone = std::numeric_limits<unsigned>::max();

// Six times the signed volume of the tetrahedron p, q, r, s.
double volume(const Point& p, const Point& q, const Point& r, const Point& s) {
  return dot(q - p, cross(r - p, s - p));
}

class Sets {
 public:
  unsigned add() {
    parent_.push_back(static_cast<unsigned>(parent_.size()));
    return parent_.back();
  }
  unsigned find(unsigned i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(unsigned i, unsigned j) { parent_[find(i)] = find(j); }

 private:
  std::vector<unsigned> parent_;
};

// Where an edge of mesh `side` crosses a triangle of the other.
struct Crossing {
  unsigned side, edge;
  double t;       // along the edge, 0 to 1
  bool entering;  // on the way from its first vertex
  unsigned node;
};

// What a triangle has in common with `other`, between two crossings.
struct Segment {
  unsigned from, to;  // nodes
  unsigned other;
};

class RegionFinder {
 public:
  RegionFinder(const SurfaceGraph& a, const TestPose& pa, const SurfaceGraph& b, const TestPose& pb)
      : meshes_{&a, &b} {
    points_[1].assign(b.vertices().begin(), b.vertices().end());
    for (const Point& p : a.vertices()) {
      // Without passing through world coordinates, which may be huge.
      points_[0].push_back(rotate_back(pb, rotate(pa, p) + (pa.position - pb.position)));
    }
  }

  std::vector<Region> find(std::span<const TrianglePair> pairs) {
    for (const TrianglePair& pair : pairs) cross_triangles(pair);
    for (const std::size_t side : {0u, 1u}) {
      if (!meshes_[1 - side]->closed()) continue;
      join_along_edges(side);
      for (const auto& [triangle, segments] : segments_[side]) {
        join_within(side, triangle, segments);
      }
    }
    return boxes();
  }

 private:
  // The sign of the edges' mutual orientation. Every triangle that has one of the edges asks in the
  // same order and so gets the same answer: a curve never slips through between two triangles.
  bool passes_left(unsigned edge_a, unsigned edge_b) const {
    const auto &a = meshes_[0]->edges()[edge_a], &b = meshes_[1]->edges()[edge_b];
    return volume(points_[0][a.from], points_[0][a.to], points_[1][b.from], points_[1][b.to]) >= 0;
  }

  void cross_triangles(const TrianglePair& pair) {
    bool left[3][3];  // the edges as their triangles have them
    const auto runs_on = [&](std::size_t side, std::size_t k) {
      const auto& mesh = *meshes_[side];
      return mesh.edges()[mesh.edges_of(pair[side])[k]].from == mesh.corners(pair[side])[k];
    };
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const bool same = runs_on(0, i) == runs_on(1, j);
        left[i][j] =
            passes_left(meshes_[0]->edges_of(pair[0])[i], meshes_[1]->edges_of(pair[1])[j]) == same;
      }
    }
    std::vector<unsigned> nodes;
    for (const std::size_t side : {0u, 1u}) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto at = [&](std::size_t k) { return side == 0 ? left[i][k] : left[k][i]; };
        if (at(0) != at(1) || at(1) != at(2)) continue;
        const unsigned node =
            cross_edge(side, meshes_[side]->edges_of(pair[side])[i], pair[1 - side]);
        if (node != kNone) nodes.push_back(node);
      }
    }
    if (nodes.size() != 2) return;  // touching, by rounding
    sets_.join(nodes[0], nodes[1]);
    segments_[0][pair[0]].push_back({nodes[0], nodes[1], pair[1]});
    segments_[1][pair[1]].push_back({nodes[0], nodes[1], pair[0]});
  }

  // The line of the edge passes through the triangle; the edge does if its ends are on either side.
  unsigned cross_edge(std::size_t side, unsigned edge, unsigned triangle) {
    const auto& ends = meshes_[side]->edges()[edge];
    const Point &p = points_[side][ends.from], &q = points_[side][ends.to];
    const auto height = [&](const Point& v) {
      const auto& corners = meshes_[1 - side]->corners(triangle);
      const Point& first = points_[1 - side][corners[0]];
      return dot(v - first, cross(points_[1 - side][corners[1]] - first,
                                  points_[1 - side][corners[2]] - first));
    };
    const double from = height(p), to = height(q);
    if ((from >= 0) == (to >= 0)) return kNone;
    const std::uint64_t key = (std::uint64_t{side} << 63) | (std::uint64_t{edge} << 32) | triangle;
    const auto [found, is_new] = crossings_of_.try_emplace(key, 0);
    if (is_new) {
      const double t = from / (from - to);
      found->second = add_node(p + t * (q - p), static_cast<unsigned>(crossings_.size()));
      crossings_.push_back({static_cast<unsigned>(side), edge, t, from >= 0, found->second});
    }
    return found->second;
  }

  unsigned add_node(const Point& p, unsigned crossing = kNone) {
    places_.push_back(p);
    crossing_at_.push_back(crossing);
    return sets_.add();
  }

  void reach(std::size_t side, unsigned vertex, unsigned node) {
    std::vector<unsigned> front;
    const auto visit = [&](unsigned v, unsigned from) {
      auto [at, is_new] = node_of_[side].try_emplace(v, 0);
      if (is_new) {
        at->second = add_node(points_[side][v]);
        front.push_back(v);
      }
      sets_.join(at->second, from);
    };
    visit(vertex, node);
    while (!front.empty()) {
      const unsigned v = front.back();
      front.pop_back();
      for (const unsigned edge : meshes_[side]->edges_at(v)) {
        const auto& ends = meshes_[side]->edges()[edge];
        if (on_edge_[side].contains(edge)) continue;
        visit(ends.from == v ? ends.to : ends.from, node_of_[side].at(v));
      }
    }
  }

  // Along an edge with crossings: what is between one that enters and one that leaves. From ends
  // inside on along the edges without crossings.
  void join_along_edges(std::size_t side) {
    for (const Crossing& c : crossings_) {
      if (c.side == side) on_edge_[side][c.edge].push_back(c);
    }
    for (auto& [edge, along] : on_edge_[side]) {
      std::sort(along.begin(), along.end(), [](const Crossing& a, const Crossing& b) {
        return std::tie(a.t, a.entering) < std::tie(b.t, b.entering);
      });
      for (std::size_t i = 0; i + 1 < along.size(); ++i) {
        if (along[i].entering && !along[i + 1].entering)
          sets_.join(along[i].node, along[i + 1].node);
      }
    }
    for (const auto& [edge, along] : on_edge_[side]) {
      const auto& ends = meshes_[side]->edges()[edge];
      if (!along.front().entering) reach(side, ends.from, along.front().node);
      if (along.back().entering) reach(side, ends.to, along.back().node);
    }
  }

  Point normal(std::size_t side, unsigned triangle) const {
    const auto& c = meshes_[side]->corners(triangle);
    const auto& p = points_[side];
    return cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]);
  }

  // A closed curve within a triangle touches none of its edges. From the curve's farthest point in
  // some direction the way goes on in this direction, to the next curve or to the triangle's edge;
  // if it is inside the other mesh it joins the two. (Always the same direction: so chains of holes
  // end at what is around them.)
  void join_within(std::size_t side, unsigned triangle, std::span<const Segment> segments) {
    if (segments.size() < 3) return;
    Sets parts;
    std::unordered_map<unsigned, unsigned> part_of;  // by node
    const auto part = [&](unsigned node) {
      const auto [at, is_new] = part_of.try_emplace(node, 0);
      if (is_new) at->second = parts.add();
      return at->second;
    };
    for (const Segment& s : segments) parts.join(part(s.from), part(s.to));

    const auto& corners = meshes_[side]->corners(triangle);
    const Point& origin = points_[side][corners[0]];
    const Point edge = points_[side][corners[1]] - origin;
    const Point across = unit(cross(normal(side, triangle), edge));
    // 0.3 rad off an edge: meshes are made along their edges.
    const Point along = std::cos(0.3) * unit(edge) + std::sin(0.3) * across;
    const Point aside = unit(cross(normal(side, triangle), along));

    std::map<unsigned, unsigned> farthest;  // node by part; kNone: not a closed curve
    for (const auto& [node, at] : part_of) {
      unsigned& best = farthest.try_emplace(parts.find(at), node).first->second;
      if (best == kNone) continue;
      if (crossings_[crossing_at_[node]].side == side) {
        best = kNone;
      } else if (dot(places_[node], along) > dot(places_[best], along)) {
        best = node;
      }
    }
    for (const auto& [set, start] : farthest) {
      if (start == kNone) continue;
      const Point& p = places_[start];
      // How far along the way is what lies from q to r? Infinity: it is not on the way.
      const auto meets = [&](const Point& q, const Point& r, double& share) {
        const double dq = dot(q - p, aside), dr = dot(r - p, aside);
        if ((dq >= 0) == (dr >= 0)) return kInfinity;
        share = dq / (dq - dr);
        const double ahead = dot(q + share * (r - q) - p, along);
        return ahead > 0 ? ahead : kInfinity;
      };
      double nearest = kInfinity, share = 0;
      const Segment* next = nullptr;
      for (const Segment& s : segments) {
        if (parts.find(part(s.from)) == set) continue;
        const double ahead = meets(places_[s.from], places_[s.to], share);
        if (ahead < nearest) nearest = ahead, next = &s;
      }
      if (next != nullptr) {
        if (dot(along, normal(1 - side, next->other)) > 0) sets_.join(start, next->from);
        continue;
      }
      for (const unsigned e : meshes_[side]->edges_of(triangle)) {
        const auto& ends = meshes_[side]->edges()[e];
        if (meets(points_[side][ends.from], points_[side][ends.to], share) < kInfinity)
          join_with_edge(side, e, share, start, leads_inside(side, segments, start, along));
      }
    }
  }

  // `t` is the place on the edge.
  void join_with_edge(std::size_t side, unsigned edge, double t, unsigned node, bool inside) {
    const auto found = on_edge_[side].find(edge);
    if (found == on_edge_[side].end()) {
      if (inside) reach(side, meshes_[side]->edges()[edge].from, node);
      return;
    }
    const auto& along = found->second;
    const auto after =
        std::find_if(along.begin(), along.end(), [&](const Crossing& c) { return c.t > t; });
    if (after != along.end() && !after->entering) sets_.join(node, after->node);
    if (after == along.end() && along.back().entering) sets_.join(node, along.back().node);
  }

  // Two triangles of the other mesh meet in an edge, which crosses this one at `node`: does the way
  // start inside? Behind both at a ridge, behind either in a valley.
  bool leads_inside(std::size_t side, std::span<const Segment> segments, unsigned node,
                    const Point& way) const {
    std::vector<unsigned> at;
    for (const Segment& s : segments) {
      if (s.from == node || s.to == node) at.push_back(s.other);
    }
    if (at.size() != 2) return false;
    const std::size_t other = 1 - side;
    const Point n = normal(other, at[0]);
    const Point& on_first = points_[other][meshes_[other]->corners(at[0])[0]];
    double highest = 0, lowest = 0;  // of the second above the first; on their edge it is 0
    for (const unsigned corner : meshes_[other]->corners(at[1])) {
      highest = std::max(highest, dot(points_[other][corner] - on_first, n));
      lowest = std::min(lowest, dot(points_[other][corner] - on_first, n));
    }
    const bool ridge = -lowest > highest;
    const bool behind_first = dot(way, n) < 0, behind_second = dot(way, normal(other, at[1])) < 0;
    return ridge ? behind_first && behind_second : behind_first || behind_second;
  }

  std::vector<Region> boxes() {
    std::map<unsigned, Region> regions;
    for (unsigned i = 0; i < places_.size(); ++i) {
      const Point& p = places_[i];
      Region& region = regions.try_emplace(sets_.find(i), Region{p, p}).first->second;
      for (std::size_t k = 0; k < 3; ++k) {
        region.low[k] = std::min(region.low[k], p[k]);
        region.high[k] = std::max(region.high[k], p[k]);
      }
    }
    std::vector<Region> result;
    for (const auto& [root, region] : regions) result.push_back(region);
    return result;
  }

  std::array<const SurfaceGraph*, 2> meshes_;
  std::array<std::vector<Point>, 2> points_;  // in the frame of the second
  std::vector<Crossing> crossings_;
  std::array<std::map<unsigned, std::vector<Segment>>, 2> segments_;  // by triangle
  std::array<std::map<unsigned, std::vector<Crossing>>, 2> on_edge_;  // by edge, in order
  std::array<std::unordered_map<unsigned, unsigned>, 2> node_of_;     // vertices inside
  std::vector<unsigned> crossing_at_;                                 // by node
  std::unordered_map<std::uint64_t, unsigned> crossings_of_;          // the node
  std::vector<Point> places_;                                         // of nodes
  Sets sets_;
};

}  // namespace

// Slabs: what of the segment is between the faces of the grown box along every axis.
bool Region::is_near(const Point& p, const Point& q, double margin) const {
  double from = 0, to = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double below = low[k] - margin - p[k], above = high[k] + margin - p[k];
    const double along = q[k] - p[k];
    if (along == 0) {
      if (below > 0 || above < 0) return false;
      continue;
    }
    from = std::max(from, std::min(below / along, above / along));
    to = std::min(to, std::max(below / along, above / along));
  }
  return from <= to;
}

std::vector<Region> find_regions(const SurfaceGraph& a, const TestPose& pa, const SurfaceGraph& b,
                                 const TestPose& pb, std::span<const TrianglePair> pairs) {
  return RegionFinder(a, pa, b, pb).find(pairs);
}

}  // namespace ode_ext::test
