// SPDX-License-Identifier: BSD-3-Clause
// Does the search find what is there? Crossings of edges, and the vertices inside closed meshes, of
// a falling pile and of all kinds of mesh, beside brute force in double precision. What differs by
// more than rounding is listed, the first 20 of a row. Exit code 1 if anything does.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/audit/broad_phase.h"
#include "bench/audit/frames.h"
#include "bench/audit/kinds.h"
#include "bench/audit/pair_poses.h"
#include "bench/audit/rounding.h"
#include "geometry/mesh_oracle.h"
#include "search/crossing_comparison.h"
#include "search/inside_oracle.h"
#include "simulation/simulation.h"
#include "support/arguments.h"
#include "support/ode_world.h"
#include "support/rig.h"

namespace {

using namespace ode_ext;
using namespace ode_ext::audit;
using namespace ode_ext::test;

struct Counts {
  long long pairs = 0;
  long long certain = 0, ambiguous = 0, found = 0;  // crossings, of the reference and of the search
  long long inside = 0, near = 0;                   // vertices, and those too near to tell
  long long differences = 0;

  Counts& operator+=(const Counts& other) {
    pairs += other.pairs;
    certain += other.certain;
    ambiguous += other.ambiguous;
    found += other.found;
    inside += other.inside;
    near += other.near;
    differences += other.differences;
    return *this;
  }
};

void print_header() {
  std::printf("%-26s %8s %10s %10s %10s %10s %8s %11s\n", "", "pairs", "crossings", "doubtful",
              "found", "inside", "near", "differences");
}

void print_row(const std::string& name, const Counts& c) {
  std::printf("%-26s %8lld %10lld %10lld %10lld %10lld %8lld %11lld\n", name.c_str(), c.pairs,
              c.certain, c.ambiguous, c.found, c.inside, c.near, c.differences);
  std::fflush(stdout);
}

// Pairs of some meshes, a batch at a time.
class Audit {
 public:
  explicit Audit(const std::vector<TestMesh>& meshes) {
    for (const TestMesh& mesh : meshes) {
      scene_.add_mesh(mesh);
      surfaces_.emplace_back(mesh);
      solids_.push_back(std::make_unique<oracle::Mesh>(mesh.vertices, mesh.indices));
    }
  }

  void add(std::uint32_t a, const TestPose& pose_a, std::uint32_t b, const TestPose& pose_b) {
    scene_.add_pair(a, pose_a, b, pose_b);
    // As many as there is memory for every vertex of.
    if (scene_.pairs.size() == 64) look();
  }
  // Of all pairs added since the last call.
  Counts take() {
    look();
    return std::exchange(counts_, {});
  }

 private:
  void look() {
    if (scene_.pairs.empty()) return;
    const StepRecords records =
        Rig::shared().run_with_edges(scene_.scene, Organization::kPipelined, {64, 64}, true);
    counts_.pairs += static_cast<long long>(scene_.pairs.size());
    const Comparison crossings =
        compare_crossings(scene_, surfaces_, found_crossings(scene_, records));
    counts_.certain += static_cast<long long>(crossings.certain);
    counts_.ambiguous += static_cast<long long>(crossings.ambiguous);
    counts_.found += static_cast<long long>(crossings.found);
    for (const std::string& difference : crossings.differences) report(difference);
    look_inside(records);
    scene_.pairs.clear();
    scene_.objects.clear();
    scene_.scene.pairs.clear();
    scene_.scene.objects.clear();
  }

  void look_inside(const StepRecords& records) {
    std::set<std::pair<ox_u32, std::uint32_t>> hit;  // pair and side, vertex
    for (const ox_hit& h : records.hits) {
      const std::uint32_t mesh = mesh_of(h.pair_side >> 1, h.pair_side & 1);
      hit.emplace(h.pair_side, Rig::shared().local_vertex(mesh, h.vertex));
    }
    for (ox_u32 pair = 0; pair < scene_.pairs.size(); ++pair)
      for (ox_u32 side = 0; side < 2; ++side)
        if (solids_[mesh_of(pair, 1 - side)]->closed()) look_inside(pair, side, hit);
  }

  void look_inside(ox_u32 pair, ox_u32 side,
                   const std::set<std::pair<ox_u32, std::uint32_t>>& hit) {
    const oracle::Mesh& target = *solids_[mesh_of(pair, 1 - side)];
    const TestPose &ps = scene_.pose_of(pair, side), &pt = scene_.pose_of(pair, 1 - side);
    // What is nearer to the surface than A is taken larger, and what rounds, may be on either side.
    const double epsilon = 10 * rounding(*solids_[mesh_of(pair, 0)], scene_.pose_of(pair, 0),
                                         *solids_[mesh_of(pair, 1)], scene_.pose_of(pair, 1));
    const Mesh& mesh = scene_.built_mesh_of(pair, side);
    const auto& vertices = mesh.vertices;
    const auto bounds = bounding_vertices(mesh, scene_.built_mesh_of(pair, 1 - side));
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      const Point p =
          rotate_back(pt, rotate(ps, point_of(vertices[v])) + (ps.position - pt.position));
      const bool found = hit.contains({pair << 1 | side, v});
      // Far from the ball that holds the target no distance need be computed.
      const double distance = length(p) > target.radius() + epsilon
                                  ? epsilon + 1
                                  : target.signed_distance({p[0], p[1], p[2]});
      if (std::fabs(distance) <= epsilon) {
        ++counts_.near;
        continue;
      }
      counts_.inside += distance < 0;
      if (found != (distance < 0 && bounds[v]))
        report("pair " + std::to_string(pair) + " side " + std::to_string(side) + ": vertex " +
               std::to_string(v) + " is " + std::to_string(1e6 * distance) +
               " um from the surface and " + (found ? "has a hit" : "has none"));
    }
  }

  std::uint32_t mesh_of(std::size_t pair, std::size_t side) const {
    return scene_.objects[scene_.pairs[pair][side]].mesh;
  }

  void report(const std::string& difference) {
    if (++counts_.differences <= 20) std::printf("  %s\n", difference.c_str());
  }

  TestScene scene_;
  std::vector<ReferenceSurface> surfaces_;
  std::vector<std::unique_ptr<oracle::Mesh>> solids_;
  Counts counts_;
};

struct OdeSession {
  OdeSession() { dInitODE2(0); }
  ~OdeSession() { dCloseODE(); }
};

Counts audit_pile(const falling_objects::SimulationSettings& options, const Frames& frames) {
  const OdeSession session;
  std::vector<std::string> warnings;
  falling_objects::Scene scene(falling_objects::make_shapes(), options, warnings);
  falling_objects::Collision collision(options, scene.space());
  falling_objects::Simulation simulation(options, scene, collision, nullptr);
  std::vector<TestMesh> meshes;
  for (const falling_objects::Shape& shape : scene.shapes())
    meshes.push_back({shape.mesh.vertices, shape.mesh.indices});
  meshes.push_back({scene.ground().mesh().vertices, scene.ground().mesh().indices});
  Audit audit(meshes);
  const auto mesh_of = [&](dGeomID geom) {
    const std::size_t index = falling_objects::index_of(geom);
    const bool is_ground = index == scene.objects().size();
    return static_cast<std::uint32_t>(is_ground ? scene.shapes().size()
                                                : scene.objects()[index].shape);
  };
  Counts total;
  for (int frame = 0, step = 0; frame < frames.count; ++step) {
    if (frames.has(step)) {
      for (const auto& [a, b] : broad_phase(scene.space()))
        audit.add(mesh_of(a), pose_of(a), mesh_of(b), pose_of(b));
      const Counts counts = audit.take();
      print_row("step " + std::to_string(step), counts);
      total += counts;
      ++frame;
    }
    simulation.step();
  }
  return total;
}

Counts audit_kinds(int poses, std::uint64_t seed) {
  const std::vector<Kind> kinds = make_kinds();
  std::vector<TestMesh> meshes;
  for (const Kind& kind : kinds) meshes.push_back(kind.mesh);
  Audit audit(meshes);
  Counts total;
  for (std::uint32_t a = 0; a < kinds.size(); ++a) {
    Counts row;
    for (std::uint32_t b = 0; b < kinds.size(); ++b) {
      Random random(seed + 1000 * a + b);
      for (int i = 0; i < poses; ++i) {
        const PosedPair pair = i % 2 == 0 ? shallow_pair(meshes[a], meshes[b], random)
                                          : deep_pair(meshes[a], meshes[b], random);
        audit.add(a, pair.a, b, pair.b);
      }
      row += audit.take();
    }
    print_row(kinds[a].name + " and all", row);
    total += row;
  }
  return total;
}

}  // namespace

int main(int argc, char** argv) {
  falling_objects::SimulationSettings options;
  options.objects = 300;
  Frames frames{.first_step = 60};
  int poses = 10;
  std::uint64_t seed = 1;
  CLI::App app(
      "Compares the crossings and the vertices inside that the search finds with brute force in "
      "double precision.",
      "search_audit");
  app.add_option("--objects", options.objects, "In the pile")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  frames.add_options(app, 0);
  app.add_option("--poses", poses, "Of each ordered pair of kinds")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  app.add_option("--seed", seed, "Of the poses")->capture_default_str();
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  try {
    print_header();
    Counts total;
    if (frames.count > 0) total += audit_pile(options, frames);
    if (poses > 0) total += audit_kinds(poses, seed);
    print_row("all", total);
    const bool passed = total.differences == 0 && total.certain > 0 && total.inside > 0;
    std::printf("search_audit: %s\n", passed ? "what brute force finds" : "failed");
    return passed ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
