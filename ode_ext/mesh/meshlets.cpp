// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/meshlets.h"

#include <algorithm>
#include <numeric>

namespace ode_ext {
namespace {

static_assert(3 * kMaxLeafTriangles <= kMeshletVertices && 3 * kMaxLeafTriangles <= kMeshletEdges,
              "every leaf is a meshlet at least");

// The edges by the place of their first triangle in the order of the leaves.
struct EdgesByPlace {
  std::vector<std::uint32_t> first;  // of each place, in `edges`; one more than there are places
  std::vector<std::uint32_t> edges;
};

EdgesByPlace edges_by_place(const Bvh& bvh, const std::vector<Edge>& edges) {
  std::vector<std::uint32_t> places(bvh.order.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) places[bvh.order[i]] = i;
  EdgesByPlace result;
  result.first.resize(places.size() + 1);
  for (const Edge& edge : edges) ++result.first[places[edge.triangles[0]] + 1];
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.edges.resize(edges.size());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    result.edges[next[places[edges[i].triangles[0]]]++] = i;
  return result;
}

class MeshletBuilder {
 public:
  MeshletBuilder(const Bvh& bvh, const std::vector<Triangle>& triangles,
                 const std::vector<Edge>& edges)
      : bvh_(bvh), triangles_(triangles), by_place_(edges_by_place(bvh, edges)) {
    find_ends();
  }

  Meshlets build() {
    const auto count = static_cast<std::uint32_t>(bvh_.nodes.size());
    for (std::uint32_t n = 0; n < count;) {
      BvhNode node = bvh_.nodes[n];
      const bool fits = collect(n);
      n = fits ? node.skip : n + 1;
      node.leaf = fits ? static_cast<std::uint32_t>(result_.meshlets.size()) << 3 | 1u : 0;
      top_.push_back(node);
      if (fits) emit();
    }
    link();
    result_.triangles = bvh_.order;
    result_.edges = std::move(by_place_.edges);
    result_.tree = build_meshlet_tree(top_);
    return std::move(result_);
  }

 private:
  // Where the triangles of each subtree end; where they start is its first leaf's.
  void find_ends() {
    ranges_.resize(bvh_.nodes.size());
    for (auto n = static_cast<std::uint32_t>(bvh_.nodes.size()); n-- > 0;) {
      const BvhNode& node = bvh_.nodes[n];
      if (node.leaf != 0)
        ranges_[n] = {node.leaf >> 3, (node.leaf >> 3) + (node.leaf & 7)};
      else
        ranges_[n] = {ranges_[n + 1][0], ranges_[bvh_.nodes[n + 1].skip][1]};
    }
  }

  // Whether the subtree is small enough; then `current_` and `vertices_` are its meshlet.
  bool collect(std::uint32_t n) {
    const auto [first, end] = ranges_[n];
    current_ = {first,
                end - first,
                0,
                0,
                by_place_.first[first],
                by_place_.first[end] - by_place_.first[first]};
    if (current_.triangle_count > kMeshletTriangles || current_.edge_count > kMeshletEdges)
      return false;
    vertices_.clear();
    for (std::uint32_t k = first; k < end; ++k)
      for (const std::uint32_t vertex : triangles_[bvh_.order[k]])
        if (std::find(vertices_.begin(), vertices_.end(), vertex) == vertices_.end())
          vertices_.push_back(vertex);
    return vertices_.size() <= kMeshletVertices;
  }

  void emit() {
    current_.vertex_first = static_cast<std::uint32_t>(result_.vertices.size());
    current_.vertex_count = static_cast<std::uint32_t>(vertices_.size());
    result_.vertices.insert(result_.vertices.end(), vertices_.begin(), vertices_.end());
    result_.meshlets.push_back(current_);
  }

  // As in build_bvh: backwards all children are known.
  void link() {
    for (auto n = static_cast<std::uint32_t>(top_.size()); n-- > 0;)
      top_[n].skip = top_[n].leaf != 0 ? n + 1 : top_[top_[n + 1].skip].skip;
  }

  const Bvh& bvh_;
  const std::vector<Triangle>& triangles_;
  EdgesByPlace by_place_;
  std::vector<std::array<std::uint32_t, 2>> ranges_;  // of triangles, of each node
  Meshlet current_{};
  std::vector<std::uint32_t> vertices_;
  std::vector<BvhNode> top_;  // of the BVH; leaf: meshlet << 3 | 1, in their order
  Meshlets result_;
};

}  // namespace

Meshlets build_meshlets(const Bvh& bvh, const std::vector<Triangle>& triangles,
                        const std::vector<Edge>& edges) {
  return MeshletBuilder(bvh, triangles, edges).build();
}

double meshlet_spread(const Meshlets& meshlets, const std::vector<Vec3f>& vertices,
                      const std::vector<Triangle>& triangles) {
  double boxes = 0, area = 0;
  for (const Meshlet& meshlet : meshlets.meshlets) {
    Box box = empty_box();
    for (std::uint32_t k = 0; k < meshlet.vertex_count; ++k)
      box = grown(box, vertices[meshlets.vertices[meshlet.vertex_first + k]]);
    boxes += half_area(box);
  }
  for (const Triangle& t : triangles) {
    const Vec3d a(vertices[t[0]]);
    area += 0.5 * length(cross(Vec3d(vertices[t[1]]) - a, Vec3d(vertices[t[2]]) - a));
  }
  return area > 0 ? boxes / area : 0;
}

}  // namespace ode_ext
