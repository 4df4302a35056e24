// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edge_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode_ext {
namespace {

// [radians] Triangles that are turned against each other by less about their edge lie on one
// another: corners are floats, and the third need not be nearer to the edge than a thousandth of
// how far it is from the origin.
constexpr double kOnOneAnother = 1e-4;

constexpr double kTurn = 2 * std::numbers::pi;

struct Turned {
  HalfEdge half_edge;
  double angle;  // [radians] about the edge, counter-clockwise as seen from its higher corner
};

// Where a triangle runs the edge upward, the solid is before it, going round counter-clockwise; of
// one that runs it downward, behind it.
bool is_behind_solid(const Turned& turned) { return turned.half_edge.upward; }

std::vector<Turned> turned_about(const std::vector<Vec3f>& vertices,
                                 const std::vector<Triangle>& triangles, const HalfEdge* first,
                                 const HalfEdge* last) {
  const Vec3d low(vertices[first->low]);
  const Vec3d along = Vec3d(vertices[first->high]) - low;
  // Any two directions across the edge do, if they are the same for all.
  const Vec3d size{std::abs(along.x), std::abs(along.y), std::abs(along.z)};
  const Vec3d aside = size.x <= size.y && size.x <= size.z ? Vec3d{1, 0, 0}
                      : size.y <= size.z                   ? Vec3d{0, 1, 0}
                                                           : Vec3d{0, 0, 1};
  const Vec3d u = cross(along, aside);
  const Vec3d v = (1 / length(along)) * cross(along, u);
  std::vector<Turned> all;
  for (; first != last; ++first) {
    const Vec3d to_apex = Vec3d(vertices[apex_of(triangles, *first)]) - low;
    all.push_back({*first, std::atan2(dot(to_apex, v), dot(to_apex, u))});
  }
  std::sort(all.begin(), all.end(), [](const Turned& a, const Turned& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.half_edge.side < b.half_edge.side;
  });
  return all;
}

// Begins with the first after the widest gap, so that none of those that lie on one another are at
// either end; of those the solid is not in between.
void order_by_solids(std::vector<Turned>& all) {
  std::size_t begin = 0;
  double widest = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double before = i == 0 ? all.back().angle - kTurn : all[i - 1].angle;
    if (all[i].angle - before <= widest) continue;
    widest = all[i].angle - before;
    begin = i;
  }
  for (std::size_t i = 0; i < begin; ++i) all[i].angle += kTurn;
  std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(begin), all.end());
  for (auto first = all.begin(); first != all.end();) {
    auto last = first + 1;
    while (last != all.end() && last->angle - (last - 1)->angle < kOnOneAnother) ++last;
    std::stable_partition(first, last, is_behind_solid);
    first = last;
  }
}

// As brackets are, from where none is open: a triangle before a solid opens one, and the next that
// is behind it closes it.
void put_pairs(const std::vector<Turned>& all, HalfEdge* to) {
  std::ptrdiff_t open = 0, fewest = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    open += is_behind_solid(all[i]) ? -1 : 1;
    if (open >= fewest) continue;
    fewest = open;
    begin = i + 1;
  }
  std::vector<HalfEdge> opened;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Turned& turned = all[(begin + i) % all.size()];
    if (!is_behind_solid(turned)) {
      opened.push_back(turned.half_edge);
      continue;
    }
    *to++ = opened.back();
    *to++ = turned.half_edge;
    opened.pop_back();
  }
}

bool runs_both_ways_alike(const HalfEdge* first, const HalfEdge* last) {
  const auto upward =
      std::count_if(first, last, [](const HalfEdge& half_edge) { return half_edge.upward; });
  return 2 * upward == last - first;
}

// Where more than two triangles meet, as many of which run the edge one way as the other.
template <typename Pair>
void at_shared_edges(std::vector<HalfEdge>& half_edges, const Pair& pair) {
  for (std::size_t begin = 0, end = 0; begin < half_edges.size(); begin = end) {
    end = end_of_edge(half_edges, begin);
    HalfEdge* const first = half_edges.data() + begin;
    HalfEdge* const last = half_edges.data() + end;
    if (end - begin != 2 && runs_both_ways_alike(first, last)) pair(first, last);
  }
}

}  // namespace

std::size_t end_of_edge(const std::vector<HalfEdge>& half_edges, std::size_t begin) {
  std::size_t end = begin;
  while (end < half_edges.size() && same_edge(half_edges[begin], half_edges[end])) ++end;
  return end;
}

bool are_pairs(const std::vector<HalfEdge>& half_edges, std::size_t begin, std::size_t end) {
  if ((end - begin) % 2 != 0) return false;
  for (std::size_t i = begin; i < end; i += 2)
    if (half_edges[i].upward == half_edges[i + 1].upward) return false;
  return true;
}

bool is_boundary(const std::vector<HalfEdge>& half_edges) {
  for (std::size_t begin = 0, end = 0; begin < half_edges.size(); begin = end) {
    end = end_of_edge(half_edges, begin);
    if (!runs_both_ways_alike(half_edges.data() + begin, half_edges.data() + end)) return false;
  }
  return true;
}

bool has_shared(const std::vector<HalfEdge>& half_edges) {
  for (std::size_t i = 2; i < half_edges.size(); ++i)
    if (same_edge(half_edges[i - 2], half_edges[i])) return true;
  return false;
}

bool has_coincident(const std::vector<Triangle>& triangles,
                    const std::vector<HalfEdge>& half_edges) {
  std::vector<std::uint32_t> apexes;
  for (std::size_t begin = 0, end = 0; begin < half_edges.size(); begin = end) {
    end = end_of_edge(half_edges, begin);
    if (end - begin == 2) continue;
    apexes.clear();
    for (std::size_t i = begin; i < end; ++i) apexes.push_back(apex_of(triangles, half_edges[i]));
    std::sort(apexes.begin(), apexes.end());
    if (std::adjacent_find(apexes.begin(), apexes.end()) != apexes.end()) return true;
  }
  return false;
}

void pair_by_solids(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                    std::vector<HalfEdge>& half_edges) {
  at_shared_edges(half_edges, [&](HalfEdge* first, HalfEdge* last) {
    std::vector<Turned> all = turned_about(vertices, triangles, first, last);
    order_by_solids(all);
    put_pairs(all, first);
  });
}

void pair_by_number(std::vector<HalfEdge>& half_edges) {
  at_shared_edges(half_edges, [](HalfEdge* first, HalfEdge* last) {
    const std::vector<HalfEdge> by_number(first, last);
    for (const bool upward : {true, false}) {
      HalfEdge* to = first + (upward ? 0 : 1);
      for (const HalfEdge& half_edge : by_number) {
        if (half_edge.upward != upward) continue;
        *to = half_edge;
        to += 2;
      }
    }
  });
}

}  // namespace ode_ext
