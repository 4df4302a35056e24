// SPDX-License-Identifier: BSD-3-Clause
// Is what a collider says of a pair of meshes true? Whether they collide is asked of FCL (do the
// surfaces meet?) and of the penetration oracle (is one inside the other, which must be closed?);
// in how many places, of the region oracle.
#pragma once

#include <ode/ode.h>

#include <span>
#include <vector>

#include "bench/audit/pair_poses.h"
#include "geometry/mesh_oracle.h"
#include "support/fcl_oracle.h"
#include "support/regions.h"

namespace ode_ext::audit {

// A mesh as each of the oracles wants it.
struct Shape {
  // Throws std::invalid_argument if a closed mesh's triangles do not share their vertices.
  explicit Shape(const test::TestMesh& mesh);

  test::FclSurface surface;
  test::SurfaceGraph graph;
  oracle::Mesh solid;
};

// An answer that changes when one mesh moves by this share of the smaller one's size along some
// axis is nobody's mistake. Regions smaller than kTiny of it are counted apart as well.
inline constexpr double kNudge = 1e-5, kTiny = 1e-4;

// What one collider said of pairs of which the truth is known.
struct Answers {
  long long found = 0;             // colliding, and a contact
  long long missed = 0;            // colliding, and no contact
  long long missed_contained = 0;  // of those, with one mesh inside the other
  long long false_contacts = 0;    // a contact, and neither surfaces that meet nor containment
  long long on_edge = 0;           // wrong, but FCL's answer is on the edge
  // Regions of overlap of the pairs that have contacts, but none here.
  long long bare = 0;         // these count
  long long bare_full = 0;    // of those, where the pair has as many contacts as it may
  long long bare_slight = 0;  // smaller than kTiny, or gone when nudged
  long long bare_beyond = 0;  // more regions than a pair can have contacts

  long long errors() const { return missed + false_contacts + bare; }
  Answers& operator+=(const Answers& other);
};

struct Tally {
  long long pairs = 0;
  long long intersecting = 0;  // surfaces meet (FCL)
  long long contained = 0;     // they do not, and one is inside the other
  long long regions = 0;       // of overlap, of those that intersect
  Answers batch, stock;

  long long colliding() const { return intersecting + contained; }
  Tally& operator+=(const Tally& other);
};

// What is true of one pair. Makes sure of it only where a collider says something else.
class PairTruth {
 public:
  PairTruth(const Shape& a, const Shape& b, const PosedPair& poses);

  bool intersecting() const { return !triangles_.empty(); }
  bool contained() const { return contained_; }
  bool colliding() const { return intersecting() || contained_; }
  std::size_t regions() const { return regions_.size(); }

  Answers judge(std::span<const dContactGeom> contacts, int max_contacts) const;

 private:
  bool on_edge() const;
  bool survives_nudges(const test::Region& region) const;
  std::vector<test::Region> regions_at(const test::TestPose& pose_a) const;

  const Shape &a_, &b_;
  PosedPair poses_;
  double smaller_;  // [m]
  std::vector<test::TrianglePair> triangles_;
  std::vector<test::Region> regions_;
  bool contained_;
};

}  // namespace ode_ext::audit
