// SPDX-License-Identifier: BSD-3-Clause
// How deep two closed meshes are inside each other, found without the library: double precision,
// one thread, no code shared. Penetration is the largest distance to the other mesh's surface of
// any vertex of one mesh that is inside the other. (Two meshes that cross only edge to edge have no
// such vertex; they penetrate by less than an edge is long.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geometry/triangle_tree.h"
#include "geometry/vector.h"

namespace ode_ext::oracle {

class Mesh {
 public:
  // x, y, z per vertex and three indices per triangle, counter-clockwise seen from outside.
  Mesh(std::span<const float> vertices, std::span<const unsigned> indices);

  // Every directed edge occurs once, and so does its reverse. What follows needs a closed mesh.
  bool closed() const { return closed_; }
  // Largest distance of a vertex from the origin [m].
  double radius() const { return radius_; }
  const std::vector<Vector>& vertices() const { return vertices_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

  // Distance to the surface [m], negative inside. The sign is that of the angle to the
  // pseudo-normal at the closest point (Baerentzen and Aanaes 2005), right at edges and corners.
  double signed_distance(Vector p) const;

  // A test that is cheap and says true only of points that are outside: of a mesh whose shape is
  // known otherwise it saves looking for the closest triangle.
  using Outside = std::function<bool(Vector)>;
  void know_outside(Outside outside) { outside_ = std::move(outside); }
  bool is_known_outside(Vector p) const { return outside_ && outside_(p); }

  // How far inside p is [m] if that is more than `floor` [m], else `floor`. Quick where it is not.
  double depth(Vector p, double floor) const;

  // A lower bound of signed_distance anywhere within `reach` [m] of p; cheap. All three fill a
  // table as they go: one thread at a time.
  double lower_bound(Vector p, double reach) const;

  // How thick the solid is where it is thin [m]: the length of the way from a triangle's middle
  // straight inwards to the other side, of which a hundredth of the surface has less. (The least
  // would be zero wherever two faces meet at a sharp angle.)
  double thinnest_part() const;

  // Vertices close together, in runs. Where they are many, two clusters with a half of them each
  // follow, and so on, up to `next`.
  struct Cluster {
    Vector middle;
    double radius;
    std::uint32_t first, count;
    std::size_t next;
  };
  const std::vector<Cluster>& clusters() const { return clusters_; }

 private:
  void weld(std::span<const float> vertices, std::span<const unsigned> indices);
  void sort_into_clusters();
  void find_normals();
  void lay_out_table();

  std::vector<Vector> vertices_;  // no two equal, in the order of the clusters
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::vector<Triangle> triangles_;
  std::vector<Cluster> clusters_;
  TriangleTree tree_;
  Outside outside_;
  bool closed_ = false;
  double radius_ = 0;

  // Not normalised: only their directions are asked for.
  std::vector<Vector> face_normals_;
  std::vector<Vector> vertex_normals_;
  std::vector<std::array<Vector, 3>> edge_normals_;  // of the edges 01, 12, 20 of each triangle

  // What is known at the middle of a cell of a grid over the mesh.
  struct Sample {
    double distance = std::numeric_limits<double>::quiet_NaN();  // signed; NaN: not yet computed
    std::uint32_t triangle = 0;                                  // the closest
  };
  using Cell = std::array<std::size_t, 3>;
  Cell cell_near(Vector p) const;  // p is clamped to the grid
  Vector middle_of(const Cell& cell) const;
  const Sample& sample_of(const Cell& cell) const;
  double signed_distance(Vector p, const ClosestPoint& closest) const;

  // Blocks of cells, of which most are never asked about and do not exist.
  static constexpr std::size_t kBlock = 8;  // cells along an edge
  using Block = std::array<Sample, kBlock * kBlock * kBlock>;
  mutable std::vector<std::unique_ptr<Block>> table_;
  Cell blocks_{};
  double cell_ = 0;  // edge of a cell [m]
};

// [m]; 0 if no vertex of either is more than `floor` [m] inside the other. A floor saves most of
// the time where only deeper ones matter.
double penetration(const Mesh& a, const Pose& pose_a, const Mesh& b, const Pose& pose_b,
                   double floor = 0);

}  // namespace ode_ext::oracle
