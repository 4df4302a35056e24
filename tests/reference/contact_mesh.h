// SPDX-License-Identifier: BSD-3-Clause
// What the contact formulation needs to know of a mesh before it meets another, worked out slowly
// in double precision. Vertices, triangles, edges and facets are numbered by place, so that no
// number depends on the order in which the program lists its triangles.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "reference/contact_tree.h"
#include "support/mesh_makers.h"

namespace ode_ext::test {

inline constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

struct ContactEdge {
  std::array<std::size_t, 2> vertices;   // ascending
  std::array<std::size_t, 2> triangles;  // the second is kNowhere where the mesh ends
  bool flat;                             // within a facet: it links features, but is no geometry
  double rise;  // [m] how far either face rises over the other's plane; > 0: a valley
};

struct ContactFacet {
  Point normal;                    // unit, of its largest triangle; zero where that has no area
  double top;                      // [m] the highest of its corners along the normal
  double lift;                     // the largest share of eps by which inflating raises one
  std::size_t largest;             // triangle
  std::vector<std::size_t> edges;  // that bound it
};

struct ContactMesh {
  explicit ContactMesh(const TestMesh& mesh, double open_thickness = 0);

  std::vector<Point> vertices;                        // welded by exact equality, ascending
  std::vector<Point> vertex_normals;                  // unit, weighted by angle
  std::vector<Point> offsets;                         // by which a vertex moves as eps grows by 1
  std::vector<std::vector<std::size_t>> edges_at;     // of each vertex
  std::vector<std::size_t> components;                // of each vertex
  std::vector<std::array<std::size_t, 3>> triangles;  // turned outwards; no collapsed ones
  std::vector<std::array<std::size_t, 3>> sides;      // edges: side k is from corner k to k + 1
  std::vector<int> source_triangle;                   // of each triangle, its index in TestMesh
  std::vector<Point> normals;                         // of triangles; zero where there is no area
  std::vector<std::size_t> facet_of;                  // of each triangle
  std::vector<ContactEdge> edges;
  std::vector<ContactFacet> facets;
  std::vector<bool> flat_vertices;  // all edges at it are flat
  std::size_t component_count = 0;
  bool closed = false;        // every edge has exactly two triangles, of opposite direction
  double radius = 0;          // [m] of the corners, from the middle of the box
  Point middle{};             // of the box
  double open_thickness = 0;  // [m] of an open mesh
  ContactTree tree;

  Point corner(std::size_t triangle, std::size_t k) const {
    return vertices[triangles[triangle][k]];
  }
  std::size_t facet_at(std::size_t edge, std::size_t k) const {
    const std::size_t triangle = edges[edge].triangles[k];
    return triangle == kNowhere ? kNowhere : facet_of[triangle];
  }
  // How far the mesh goes on below a vertex, along minus its normal [m]; infinity: it is not below
  // it at all. At most open_thickness for an open mesh.
  double thickness_at(std::size_t vertex) const;

 private:
  void weld(const TestMesh& mesh);
  void turn_outwards();
  void sort_triangles();
  void find_normals();
  void find_edges();
  void find_facets();
  void describe_facets();
  void describe_vertices();
  bool lies_in(std::size_t triangle, std::size_t seed) const;
};

}  // namespace ode_ext::test
