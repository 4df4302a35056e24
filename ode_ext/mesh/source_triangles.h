// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a mesh as its program gives them, bit for bit: by these a mesh is known to be
// unchanged, or the same as another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/box.h"
#include "mesh/vec.h"

namespace ode_ext {

// Corners of triangles: 3 per triangle, local frame [m].
using TriangleSoup = std::vector<Vec3f>;

// The same with the places of corners apart from which corner is where. Where corners share places,
// as they mostly do, that is half as much memory, and to compare it with the arrays that it was
// read from nothing has to be looked up.
struct SourceTriangles {
  SourceTriangles() = default;
  SourceTriangles(TriangleSoup soup);  // every corner has a place of its own

  // Of corners, as of a soup.
  std::size_t size() const { return corners.size(); }
  bool empty() const { return corners.empty(); }
  const Vec3f& operator[](std::size_t corner) const { return places[corners[corner]]; }

  std::vector<Vec3f> places;  // some may be of no corner
  std::vector<std::uint32_t> corners;
};

bool is_finite(const SourceTriangles& source);
Box box_of(const SourceTriangles& source);  // all zero if there are no triangles

// Of the corners: soups that are equal have equal hashes. What has one hash need not be one soup
// (soup_hash.cpp).
std::uint64_t hash_soup(const Vec3f* corners, std::size_t corner_count);
std::uint64_t hash_soup(const SourceTriangles& source);

// A total order of soups by their bits: 0 for the same, and a NaN is the same as itself.
int compare_soups(const SourceTriangles& a, const SourceTriangles& b);

}  // namespace ode_ext
