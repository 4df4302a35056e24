// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/oracles.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fuzz/decode_mesh.h"

namespace ode_ext::fuzz {
namespace {

using namespace test;

// An answer that changes when a mesh moves by this share of the larger one's size along some axis
// is nobody's mistake. The library takes what is within 2^-20 of the extents for touching; three
// axes see at least 1/sqrt(3) of a move in any direction, and poses and vertices are rounded to
// floats on top: ten times is clear of all of it.
constexpr double kNudge = 2e-5;
// Beyond this ratio of sizes a nudge is no longer small beside the smaller mesh.
constexpr double kLargestRatio = 100;
// A float's unit normal, rotated in double precision.
constexpr double kUnit = 1e-6;

bool stays(const Subject& a, const Subject& b, double nudge, bool intersect) {
  const auto poses = nudged(a.pose, nudge);
  return std::all_of(poses.begin(), poses.end(), [&](const TestPose& pose) {
    return surfaces_intersect(*a.surface, pose, *b.surface, b.pose) == intersect;
  });
}

}  // namespace

Tally& Tally::operator+=(const Tally& other) {
  executions += other.executions;
  operations += other.operations;
  contacts += other.contacts;
  colliding += other.colliding;
  contained += other.contained;
  apart += other.apart;
  on_edge += other.on_edge;
  unjudged += other.unjudged;
  compared += other.compared;
  meshlets += other.meshlets;
  stock += other.stock;
  return *this;
}

std::string to_text(const Tally& tally) {
  std::ostringstream text;
  text << "programs              " << tally.executions << '\n'
       << "operations            " << tally.operations << '\n'
       << "contacts looked at    " << tally.contacts << '\n'
       << "pairs judged          " << tally.colliding + tally.contained + tally.apart << '\n'
       << "  surfaces intersect  " << tally.colliding << '\n'
       << "  one in the other    " << tally.contained << '\n'
       << "  apart               " << tally.apart << '\n'
       << "pairs on the edge     " << tally.on_edge << '\n'
       << "pairs not judged      " << tally.unjudged << '\n'
       << "answers compared      " << tally.compared << '\n'
       << "meshlets looked into  " << tally.meshlets << '\n'
       << "pairs timed in ODE    " << tally.stock << '\n';
  return text.str();
}

std::string malformed(std::span<const dContactGeom> contacts, const Sides& first,
                      const Sides& second) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const dContactGeom& c = contacts[i];
    std::ostringstream text;
    text << "contact " << i << " of " << contacts.size() << ": ";
    const std::size_t start = text.str().size();
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      if (!std::isfinite(c.pos[k])) text << "pos[" << k << "] is " << c.pos[k] << "; ";
      square += c.normal[k] * c.normal[k];
    }
    if (!(std::fabs(std::sqrt(square) - 1) <= kUnit))
      text << "the normal's length is " << std::sqrt(square) << "; ";
    if (!(c.depth >= 0) || !std::isfinite(c.depth)) text << "depth is " << c.depth << "; ";
    if ((first.geom != nullptr && c.g1 != first.geom) ||
        (second.geom != nullptr && c.g2 != second.geom))
      text << "its geoms are not those asked for; ";
    if (first.triangles > 0 && (c.side1 < 0 || c.side1 >= first.triangles))
      text << "side1 is " << c.side1 << " of " << first.triangles << "; ";
    if (second.triangles > 0 && (c.side2 < 0 || c.side2 >= second.triangles))
      text << "side2 is " << c.side2 << " of " << second.triangles << "; ";
    if (text.str().size() > start) return text.str();
  }
  return "";
}

std::string untrue(const Subject& a, const Subject& b, bool has_contact, Tally& tally) {
  const auto unjudged = [&] {
    ++tally.unjudged;
    return "";
  };
  if (a.surface == nullptr || b.surface == nullptr || !tame(a.pose) || !tame(b.pose))
    return unjudged();
  const double smaller = std::min(a.surface->size(), b.surface->size());
  const double larger = std::max(a.surface->size(), b.surface->size());
  if (larger > kLargestRatio * smaller) return unjudged();

  const bool intersect = surfaces_intersect(*a.surface, a.pose, *b.surface, b.pose);
  const bool solids = a.solid && b.solid;
  const bool contained =
      !intersect && solids && one_contains_the_other(a.mesh, a.pose, b.mesh, b.pose);
  if (!intersect && !solids) return unjudged();
  if (has_contact == (intersect || contained)) {
    ++(intersect ? tally.colliding : contained ? tally.contained : tally.apart);
    return "";
  }
  if (!stays(a, b, kNudge * larger, intersect)) {
    ++tally.on_edge;
    return "";
  }
  if (intersect) return "no contact, but the surfaces intersect";
  if (contained) return "no contact, but one mesh is inside the other";
  return "a contact, but the surfaces are apart and neither mesh is inside the other";
}

}  // namespace ode_ext::fuzz
