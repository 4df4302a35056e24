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
      if (meshes_[1 - side]->closed()) join_what_is_inside(side);
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
    unsigned last = kNone;
    for (const std::size_t side : {0u, 1u}) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto at = [&](std::size_t k) { return side == 0 ? left[i][k] : left[k][i]; };
        if (at(0) != at(1) || at(1) != at(2)) continue;
        const unsigned node =
            cross_edge(side, meshes_[side]->edges_of(pair[side])[i], pair[1 - side]);
        if (node != kNone && last != kNone) sets_.join(node, last);
        if (node != kNone) last = node;
      }
    }
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
      found->second = add_node(p + t * (q - p));
      crossings_.push_back({static_cast<unsigned>(side), edge, t, from >= 0, found->second});
    }
    return found->second;
  }

  unsigned add_node(const Point& p) {
    places_.push_back(p);
    return sets_.add();
  }

  // Along an edge with crossings: what is between one that enters and one that leaves. From ends
  // inside on along the edges without crossings.
  void join_what_is_inside(std::size_t side) {
    const SurfaceGraph& mesh = *meshes_[side];
    std::vector<Crossing> along;
    for (const Crossing& c : crossings_) {
      if (c.side == side) along.push_back(c);
    }
    std::sort(along.begin(), along.end(), [](const Crossing& a, const Crossing& b) {
      return std::tie(a.edge, a.t, a.entering) < std::tie(b.edge, b.t, b.entering);
    });
    std::vector<unsigned> node_of(mesh.vertices().size(), kNone);
    std::vector<bool> crossed(mesh.edges().size());
    std::vector<unsigned> front;
    const auto reach = [&](unsigned vertex, unsigned node) {
      if (node_of[vertex] == kNone) {
        node_of[vertex] = add_node(points_[side][vertex]);
        front.push_back(vertex);
      }
      sets_.join(node_of[vertex], node);
    };
    for (std::size_t i = 0; i < along.size(); ++i) {
      const Crossing& c = along[i];
      const bool first = i == 0 || along[i - 1].edge != c.edge;
      const bool last = i + 1 == along.size() || along[i + 1].edge != c.edge;
      crossed[c.edge] = true;
      if (first && !c.entering) reach(mesh.edges()[c.edge].from, c.node);
      if (last && c.entering) reach(mesh.edges()[c.edge].to, c.node);
      if (!last && c.entering && !along[i + 1].entering) sets_.join(c.node, along[i + 1].node);
    }
    while (!front.empty()) {
      const unsigned vertex = front.back();
      front.pop_back();
      for (const unsigned edge : mesh.edges_at(vertex)) {
        const auto& ends = mesh.edges()[edge];
        if (!crossed[edge]) reach(ends.from == vertex ? ends.to : ends.from, node_of[vertex]);
      }
    }
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
  std::unordered_map<std::uint64_t, unsigned> crossings_of_;  // the node
  std::vector<Point> places_;                                 // of nodes
  Sets sets_;
};

}  // namespace

SurfaceGraph::SurfaceGraph(const TestMesh& mesh) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count()); ++i) {
    vertices_.push_back(mesh.vertex(i));
  }
  std::map<std::pair<unsigned, unsigned>, unsigned> numbers;
  std::vector<int> triangles_at;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    corners_.push_back({mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]});
    auto& sides = sides_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [from, to] = std::minmax(corners_.back()[k], corners_.back()[(k + 1) % 3]);
      const auto [at, is_new] =
          numbers.try_emplace({from, to}, static_cast<unsigned>(edges_.size()));
      if (is_new) {
        edges_.push_back({from, to});
        triangles_at.push_back(0);
      }
      sides[k] = at->second;
      ++triangles_at[at->second];
    }
  }
  closed_ = std::all_of(triangles_at.begin(), triangles_at.end(), [](int n) { return n == 2; });

  first_at_.assign(vertices_.size() + 1, 0);
  for (const Edge& e : edges_) ++first_at_[e.from + 1], ++first_at_[e.to + 1];
  std::partial_sum(first_at_.begin(), first_at_.end(), first_at_.begin());
  at_vertex_.resize(2 * edges_.size());
  std::vector<unsigned> next(first_at_.begin(), first_at_.end() - 1);
  for (unsigned i = 0; i < edges_.size(); ++i) {
    at_vertex_[next[edges_[i].from]++] = i;
    at_vertex_[next[edges_[i].to]++] = i;
  }
}

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
