// SPDX-License-Identifier: BSD-3-Clause
// Where features coincide: equal boxes in line, copies at one place, walls and edges that are
// shared. No edge need cross a face there, and rounding decides on which side a vertex is.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bench/accuracy/failures.h"
#include "bench/accuracy/measures.h"
#include "bench/accuracy/rounding.h"
#include "bench/accuracy/trial.h"
#include "support/convex_makers.h"
#include "support/convex_solid.h"

namespace ode_ext::accuracy {
namespace {

constexpr double kOverlaps[] = {0, 1e-6, 0.01, 0.1, 0.5, 1};  // of the extent along an axis
// [m] Float rounding of coordinates about 1: less than that is not known to overlap.
constexpr double kTouching = 1e-7;
// Two contacts push against each other if their normals are more than 120 degrees apart.
constexpr double kOpposing = -0.5;

// Depth by ODE's own collider of boxes of these extents; 0 where they are apart.
double box_box_depth(const test::Point& ea, const test::TestPose& pa, const test::Point& eb) {
  dVector3 position{}, origin{}, sides_a{}, sides_b{}, normal{};
  dMatrix3 rotation{}, identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    position[i] = pa.position[i], sides_a[i] = ea[i], sides_b[i] = eb[i];
    for (std::size_t j = 0; j < 3; ++j) rotation[4 * i + j] = pa.rotation[3 * i + j];
  }
  dContactGeom contacts[8];
  dReal depth = 0;
  int code = 0;
  const int count = dBoxBox(position, rotation, sides_a, origin, identity, sides_b, normal, &depth,
                            &code, 8, contacts, sizeof(dContactGeom));
  return count > 0 ? depth : 0;
}

struct Case {
  std::string name;
  test::GeomPair geoms;
  double depth;      // [m] no contact may be deeper
  double tolerance;  // [m]
};

class Cases {
 public:
  Cases(test::OdeWorld& world, std::uint64_t seed) : world_(world), random_(seed) {}

  // Boxes, whose depth is asked of two that must agree.
  void add_boxes(const std::string& name, const test::Point& ea, const test::TestPose& pa,
                 const test::Point& eb, int cells = 1) {
    const auto box = [&](const test::Point& e) { return test::make_box(e, cells, cells, cells); };
    add(name, box(ea), pa, box(eb));
    box_box_differing_.count(std::fabs(cases_.back().depth - box_box_depth(ea, pa, eb)) >
                             kTouching);
  }

  // Convex meshes, as they are and turned together in some way; b is where it was made.
  void add(const std::string& name, const test::TestMesh& a, const test::TestPose& pa,
           const test::TestMesh& b) {
    const test::ConvexSolid sa(a), sb(b);
    add(name, a, pa, b, std::max(0.0, shortest_way_out(sa, pa, sb, {}).depth));
  }

  void add(const std::string& name, const test::TestMesh& a, const test::TestPose& pa,
           const test::TestMesh& b, double depth) {
    const test::OdeMesh &ma = world_.mesh(a), &mb = world_.mesh(b);
    for (const bool turned : {false, true}) {
      const test::TestPose frame = turned ? random_.pose(1) : test::TestPose{};
      const test::TestPose in_frame = test::composed(frame, pa);
      cases_.push_back({name + (turned ? ", turned" : ""),
                        {world_.geom(ma, in_frame), world_.geom(mb, frame)},
                        depth,
                        rounding(a, in_frame, b, frame)});
    }
  }

  const std::vector<Case>& all() const { return cases_; }
  const Share& box_box_differing() const { return box_box_differing_; }

 private:
  test::OdeWorld& world_;
  test::Random random_;
  std::vector<Case> cases_;
  Share box_box_differing_;
};

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%g %%", 100 * share);
  return text;
}

// Equal boxes, overlapping by a share of their extents along the chosen axes and wholly along the
// others; 0 is side by side: a shared wall, a shared edge or a shared corner.
void add_aligned(Cases& cases, const std::string& name, const test::Point& extents, int cells) {
  const char* const directions[] = {"x", "y", "xy", "z", "xz", "yz", "xyz"};  // by bits
  for (const double overlap : kOverlaps) {
    for (unsigned bits = 1; bits <= 7; ++bits) {
      if (overlap == 1 && bits != 7) continue;  // the same place
      test::Point offset{};
      for (std::size_t k = 0; k < 3; ++k)
        offset[k] = bits >> k & 1 ? (1 - overlap) * extents[k] : 0;
      cases.add_boxes(name + ": " + percent(overlap) + " along " + directions[bits - 1], extents,
                      {.position = offset}, extents, cells);
    }
  }
}

void add_copies(Cases& cases, std::uint64_t seed) {
  test::Random random(seed);
  const std::pair<const char*, test::TestMesh> convex[] = {
      {"tetrahedron", test::make_tetrahedron(1)}, {"octahedron", test::make_octahedron(0.5)},
      {"ball", test::make_icosphere(0.5, 1)},     {"cylinder", test::make_cylinder(0.4, 1, 16)},
      {"cone", test::make_cone(0.5, 1, 16)},      {"hull", test::make_random_hull(random, 20, 0.5)},
      {"plate", test::make_plate(1, 0.05, 4)},    {"rod", test::make_rod(1, 0.1)}};
  for (const auto& [name, mesh] : convex) cases.add(std::string("copy: ") + name, mesh, {}, mesh);
  // Of these the way along one axis is known: the torus is 0.4 high, the L 0.5 thick.
  const test::TestMesh torus = test::make_torus(0.5, 0.2, 24, 12), l = test::make_l(1);
  cases.add("copy: torus", torus, {}, torus, 0.4);
  cases.add("copy: L", l, {}, l, 0.5);
}

void add_flush(Cases& cases) {
  const test::Point large{1, 1, 1}, small{0.5, 0.5, 0.5};
  cases.add_boxes("slid along a wall, 1 % deep", large, test::at(0.3, 0, 0.99), large);
  cases.add_boxes("slid both ways, 1 % deep", large, test::at(0.3, 0.2, 0.99), large);
  cases.add_boxes("slid along a shared wall", large, test::at(0.3, 0.2, 1), large);
  cases.add_boxes("small box within a corner", small, test::at(0.25, 0.25, 0.25), large);
  cases.add_boxes("small box within an edge", small, test::at(0.25, 0, 0.25), large);
  cases.add_boxes("small box within a wall", small, test::at(0, 0, 0.25), large);
  cases.add_boxes("small box on top, flush", small, test::at(0.25, 0, 0.75), large);
  cases.add_boxes("small box on top, flush at a corner", small, test::at(0.25, 0.25, 0.75), large);
  cases.add_boxes("small box 2 % deep, flush", small, test::at(0.25, 0, 0.74), large);
  cases.add_boxes("small box 2 % deep, flush at a corner", small, test::at(0.25, 0.25, 0.74),
                  large);
  // An edge of one on an edge of the other, like leaves of a book opened by some angle: the large
  // box fills the quarter below and left of its edge, the small one is turned about it. Up to 90
  // degrees they share no more than the edge (at 90 a wall), then more and more.
  for (const int degrees : {0, 30, 60, 90, 91, 120, 150}) {
    const test::TestPose turn = test::turned({0, 1, 0}, -degrees * std::numbers::pi / 180);
    test::TestPose pose = test::composed(turn, test::at(0.25, 0, 0.25));
    for (const std::size_t k : {0u, 2u}) pose.position[k] += 0.5;
    cases.add_boxes("edge on edge, opened by " + std::to_string(degrees), small, pose, large);
  }
}

bool push_against_each_other(const test::Contacts& contacts) {
  for (const dContactGeom& a : contacts) {
    for (const dContactGeom& b : contacts) {
      if (!(test::dot(test::normal(a), test::normal(b)) >= kOpposing)) return true;
    }
  }
  return false;
}

Outcome measure(const std::vector<Case>& cases, const Share& box_box_differing,
                Contestant& contestant) {
  std::vector<test::GeomPair> geoms;
  for (const Case& c : cases) geoms.push_back(c.geoms);
  const auto answers = contestant.collide(geoms);
  Share none, too_deep, opposing;
  Failures failures;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const auto fail = [&](Share& share, bool failed, const std::string& what) {
      share.count(failed);
      if (failed) failures.add(c.name + ": " + what, c.geoms);
    };
    if (c.depth > kTouching) fail(none, answers[i].empty(), "no contact");
    if (answers[i].empty()) continue;
    const double depth = deepest_of(answers[i])->depth;
    fail(too_deep, exceeds(depth, c.depth + c.tolerance),
         std::to_string(depth) + " deep, overlap " + std::to_string(c.depth));
    fail(opposing, push_against_each_other(answers[i]), "opposing normals");
  }
  const auto number = [](const Share& share) { return static_cast<double>(share.hits); };
  return {{{"overlapping without a contact", number(none), at_most(0)},
           {"contacts deeper than the overlap", number(too_deep), at_most(0)},
           {"normals opposing each other", number(opposing), at_most(0)},
           {"(cases)", static_cast<double>(cases.size())},
           {"(of these overlapping)", static_cast<double>(none.all)},
           {"(pairs of boxes of whose depth dBoxBox says another)", number(box_box_differing)}},
          {{"failures", failures.json()}}};
}

}  // namespace

Measure prepare_coincident(const Options& options, test::OdeWorld& world) {
  Cases cases(world, options.seed);
  add_aligned(cases, "cube", {1, 1, 1}, 1);
  add_aligned(cases, "cube of 108 triangles", {1, 1, 1}, 3);
  add_aligned(cases, "brick", {1, 0.5, 0.25}, 1);
  add_copies(cases, options.seed);
  add_flush(cases);
  return [all = cases.all(), differing = cases.box_box_differing()](Contestant& contestant) {
    return measure(all, differing, contestant);
  };
}

}  // namespace ode_ext::accuracy
