// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/mesh_oracle.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace ode_ext::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kClusterVertices = 32;
constexpr double kMostCells = 1 << 26;

double angle_between(Vector a, Vector b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace

Mesh::Mesh(std::span<const float> vertices, std::span<const unsigned> indices) {
  weld(vertices, indices);
  sort_into_clusters();
  for (const auto& [a, b, c] : corners_) {
    triangles_.push_back({vertices_[a], vertices_[b], vertices_[c]});
  }
  tree_ = TriangleTree(triangles_);
  find_normals();
  for (const Vector& v : vertices_) radius_ = std::max(radius_, length(v));
  if (closed_) lay_out_table();
}

// Pseudo-normals need the neighbours, which a mesh given as loose triangles does not name.
void Mesh::weld(std::span<const float> vertices, std::span<const unsigned> indices) {
  std::map<Vector, std::uint32_t> numbers;
  const auto number = [&](unsigned i) {
    const Vector v{vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]};
    const auto [at, is_new] = numbers.try_emplace(v, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(v);
    return at->second;
  };
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const std::uint32_t a = number(indices[i]), b = number(indices[i + 1]),
                        c = number(indices[i + 2]);
    if (a != b && b != c && c != a) corners_.push_back({a, b, c});
  }
}

void Mesh::sort_into_clusters() {
  std::vector<std::uint32_t> order(vertices_.size());
  std::iota(order.begin(), order.end(), 0u);
  // Halves at the median along the longest side until the halves are small.
  const auto split = [&](const auto& self, std::size_t first, std::size_t last) -> void {
    Vector low = vertices_[order[first]], high = low;
    for (std::size_t i = first; i < last; ++i) {
      const Vector& v = vertices_[order[i]];
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    const Vector size = high - low;
    const std::size_t cluster = clusters_.size();
    clusters_.push_back({0.5 * (low + high), 0, static_cast<std::uint32_t>(first),
                         static_cast<std::uint32_t>(last - first), cluster + 1});
    if (last - first <= kClusterVertices) return;
    double Vector::*axis = &Vector::x;
    if (size.y > size.*axis) axis = &Vector::y;
    if (size.z > size.*axis) axis = &Vector::z;
    const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t half = (first + last) / 2;
    std::nth_element(at(first), at(half), at(last), [&](std::uint32_t a, std::uint32_t b) {
      return vertices_[a].*axis < vertices_[b].*axis;
    });
    self(self, first, half);
    self(self, half, last);
    clusters_[cluster].next = clusters_.size();
  };
  if (!vertices_.empty()) split(split, 0, vertices_.size());

  std::vector<Vector> sorted;
  std::vector<std::uint32_t> renamed(order.size());
  for (const std::uint32_t old : order) {
    renamed[old] = static_cast<std::uint32_t>(sorted.size());
    sorted.push_back(vertices_[old]);
  }
  vertices_ = std::move(sorted);
  for (auto& corners : corners_) {
    for (std::uint32_t& corner : corners) corner = renamed[corner];
  }
  for (Cluster& cluster : clusters_) {
    for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i) {
      cluster.radius = std::max(cluster.radius, length(vertices_[i] - cluster.middle));
    }
  }
}

void Mesh::find_normals() {
  vertex_normals_.resize(vertices_.size());
  edge_normals_.resize(corners_.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> triangle_of_edge;
  closed_ = !corners_.empty();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const Vector n = unit(cross(t[1] - t[0], t[2] - t[0]));
    face_normals_.push_back(n);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      Vector& sum = vertex_normals_[corners_[i][k]];
      sum = sum + angle_between(t[next] - t[k], t[last] - t[k]) * n;
      const bool is_new =
          triangle_of_edge.try_emplace({corners_[i][k], corners_[i][next]}, i).second;
      closed_ = closed_ && is_new;
    }
  }
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto other = triangle_of_edge.find({corners_[i][(k + 1) % 3], corners_[i][k]});
      closed_ = closed_ && other != triangle_of_edge.end();
      edge_normals_[i][k] = face_normals_[i];
      if (other != triangle_of_edge.end()) {
        edge_normals_[i][k] = face_normals_[i] + face_normals_[other->second];
      }
    }
  }
}

double Mesh::signed_distance(Vector p, const ClosestPoint& closest) const {
  const auto& corners = corners_[closest.triangle];
  Vector normal;
  switch (closest.feature) {
    case Feature::kFace:
      normal = face_normals_[closest.triangle];
      break;
    case Feature::kCorner0:
      normal = vertex_normals_[corners[0]];
      break;
    case Feature::kCorner1:
      normal = vertex_normals_[corners[1]];
      break;
    case Feature::kCorner2:
      normal = vertex_normals_[corners[2]];
      break;
    case Feature::kEdge01:
      normal = edge_normals_[closest.triangle][0];
      break;
    case Feature::kEdge12:
      normal = edge_normals_[closest.triangle][1];
      break;
    case Feature::kEdge20:
      normal = edge_normals_[closest.triangle][2];
      break;
  }
  const double distance = std::sqrt(closest.squared_distance);
  return dot(p - closest.point, normal) < 0 ? -distance : distance;
}

// What is closest to the middle of p's cell is nearly as close to p: a good start for the search.
double Mesh::signed_distance(Vector p) const {
  return signed_distance(p, tree_.closest(p, sample_of(cell_near(p)).triangle));
}

double Mesh::depth(Vector p, double floor) const {
  const ClosestPoint closest = tree_.closest(p, sample_of(cell_near(p)).triangle, floor * floor);
  return std::max(floor, -signed_distance(p, closest));
}

// Half an edge per cell resolves what the mesh resolves; more would only take memory.
void Mesh::lay_out_table() {
  double edges = 0;
  for (const Triangle& t : triangles_) edges += length(t[1] - t[0]);
  const Vector size = tree_.high() - tree_.low();
  cell_ = std::max(0.5 * edges / static_cast<double>(triangles_.size()),
                   std::cbrt(size.x * size.y * size.z / kMostCells));
  const auto blocks = [&](double extent) {
    return static_cast<std::size_t>(extent / cell_) / kBlock + 1;
  };
  blocks_ = {blocks(size.x), blocks(size.y), blocks(size.z)};
  table_.resize(blocks_[0] * blocks_[1] * blocks_[2]);
}

Mesh::Cell Mesh::cell_near(Vector p) const {
  const Vector low = tree_.low(), high = tree_.high();
  const auto cell = [&](double Vector::*axis) {
    const double inside = std::clamp(p.*axis, low.*axis, high.*axis) - low.*axis;
    return static_cast<std::size_t>(inside / cell_);
  };
  return {cell(&Vector::x), cell(&Vector::y), cell(&Vector::z)};
}

Vector Mesh::middle_of(const Cell& cell) const {
  const auto at = [](std::size_t index) { return static_cast<double>(index) + 0.5; };
  return tree_.low() + cell_ * Vector{at(cell[0]), at(cell[1]), at(cell[2])};
}

const Mesh::Sample& Mesh::sample_of(const Cell& cell) const {
  const auto index = [&cell](std::size_t unit, const Cell& counts, auto of) {
    return (of(cell[2], unit) * counts[1] + of(cell[1], unit)) * counts[0] + of(cell[0], unit);
  };
  auto& block = table_[index(kBlock, blocks_, std::divides<>())];
  if (block == nullptr) block = std::make_unique<Block>();
  Sample& sample = (*block)[index(kBlock, {kBlock, kBlock, kBlock}, std::modulus<>())];
  if (std::isnan(sample.distance)) {
    const Vector middle = middle_of(cell);
    const ClosestPoint closest = tree_.closest(middle);
    sample = {signed_distance(middle, closest), closest.triangle};
  }
  return sample;
}

// A signed distance changes by no more than one moves. The box alone proves most points to be
// outside; only near it are cells filled.
double Mesh::lower_bound(Vector p, double reach) const {
  const Vector low = tree_.low(), high = tree_.high();
  const Vector outside{std::max({low.x - p.x, p.x - high.x, 0.0}),
                       std::max({low.y - p.y, p.y - high.y, 0.0}),
                       std::max({low.z - p.z, p.z - high.z, 0.0})};
  const double beyond = length(outside);
  if (beyond > reach) return beyond - reach;
  const Cell cell = cell_near(p);
  return sample_of(cell).distance - length(p - middle_of(cell)) - reach;
}

double Mesh::thinnest_part() const {
  std::vector<std::pair<double, double>> ways;  // length, area
  double whole = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const double area = 0.5 * length(cross(t[1] - t[0], t[2] - t[0]));
    const Vector middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
    // Leaves out the surface the way starts on: rounding moves the middle by less than this.
    const double start = 1e-9 * length(tree_.high() - tree_.low());
    ways.emplace_back(tree_.first_hit(middle, -1.0 * face_normals_[i], start), area);
    whole += area;
  }
  std::sort(ways.begin(), ways.end());
  double passed = 0;
  for (const auto& [way, area] : ways) {
    passed += area;
    if (passed >= 0.01 * whole) return way;
  }
  return kInfinity;
}

namespace {

// The deepest vertex of `source` in `target`, if deeper than `best` [m], else `best`. Those that
// can be deepest are looked at first, so that most of the others need not be.
double deepest_vertex(const Mesh& source, const Pose& source_pose, const Mesh& target,
                      const Pose& target_pose, double best) {
  const auto in_target = [&](Vector p) { return target_pose.to_local(source_pose.to_world(p)); };
  if (-target.lower_bound(in_target({}), source.radius()) <= best) return best;
  struct Candidate {
    double at_most;  // [m]
    Vector point;
  };
  std::vector<Candidate> candidates;
  const std::vector<Mesh::Cluster>& clusters = source.clusters();
  for (std::size_t i = 0; i < clusters.size();) {
    const Mesh::Cluster& cluster = clusters[i];
    const bool may_be = -target.lower_bound(in_target(cluster.middle), cluster.radius) > best;
    const bool halved = cluster.next > i + 1;
    i = may_be ? i + 1 : cluster.next;
    if (!may_be || halved) continue;
    for (std::uint32_t v = cluster.first; v < cluster.first + cluster.count; ++v) {
      const Vector p = in_target(source.vertices()[v]);
      if (target.is_known_outside(p)) continue;
      const double at_most = -target.lower_bound(p, 0);
      if (at_most > best) candidates.push_back({at_most, p});
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.at_most > b.at_most; });
  for (const Candidate& candidate : candidates) {
    if (candidate.at_most <= best) break;
    best = target.depth(candidate.point, best);
  }
  return best;
}

}  // namespace

double penetration(const Mesh& a, const Pose& pose_a, const Mesh& b, const Pose& pose_b,
                   double floor) {
  const double deepest =
      deepest_vertex(b, pose_b, a, pose_a, deepest_vertex(a, pose_a, b, pose_b, floor));
  return deepest > floor ? deepest : 0;
}

}  // namespace ode_ext::oracle
