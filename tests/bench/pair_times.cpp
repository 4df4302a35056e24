// SPDX-License-Identifier: BSD-3-Clause
// What a pair costs: the library in a batch and alone, ODE's own collider, FCL and GImpact, on
// the same poses, interleaved. Poses change by a hair from one repetition to the next: nobody
// answers from memory.
#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/captured_cases.h"
#include "bench/pair_cases.h"
#include "bench/rivals.h"
#include "bench/timing.h"
#include "support/arguments.h"
#include "support/batch_collider.h"
#include "support/ode_world.h"
#include "support/worst_pairs.h"

// ODE's own, whatever override is set; exported, but not in its headers.
int dCollideTTL(dxGeom* a, dxGeom* b, int flags, dContactGeom* contacts, int stride);

namespace {

using namespace ode_ext;
using bench::median;
using bench::milliseconds;

constexpr int kContacts = 16;

struct Options {
  int pairs = 200;
  int repetitions = 9;
  std::vector<int> triangles = {100, 1000, 5000, 20000, 100000};
  std::string only, csv, replay;
};

struct Contestant {
  std::string name;
  std::vector<double> ms;  // a pair
};
constexpr std::size_t kBatch = 0, kAlone = 1, kOde = 2;  // rivals follow

struct Result {
  std::vector<Contestant> contestants;
  int colliding = 0;
  double crossings = 0, rays = 0;  // a pair
};

Result measure(const bench::PairCase& pair_case, const Options& options) {
  test::OdeWorld world;
  const test::BatchCollider collider;
  const test::OdeMesh &a = world.mesh(pair_case.a), &b = world.mesh(pair_case.b);
  const std::vector<std::unique_ptr<bench::Rival>> rivals = bench::make_rivals();
  Result result{{{"batch", {}}, {"alone", {}}, {"ODE", {}}}};
  for (const auto& rival : rivals) {
    result.contestants.push_back({rival->name(), {}});
    rival->add_mesh(pair_case.a);
    rival->add_mesh(pair_case.b);
  }
  std::vector<dGeomID> geoms;
  for (const bench::PosedPair& pair : pair_case.pairs) {
    for (const auto& rival : rivals) {
      rival->add_object(0);
      rival->add_object(1);
      rival->place(geoms.size(), pair.a);
      rival->place(geoms.size() + 1, pair.b);
    }
    geoms.push_back(world.geom(a, pair.a));
    geoms.push_back(world.geom(b, pair.b));
  }
  const std::size_t count = pair_case.pairs.size();
  std::vector<dContactGeom> contacts(count * kContacts);
  std::vector<int> counts(count);
  const auto stir = [&](int repetition) {
    for (std::size_t i = 0; i < count; ++i) {
      const test::Point& at = pair_case.pairs[i].b.position;
      dGeomSetPosition(geoms[2 * i + 1], at[0] + 5e-8 * repetition, at[1], at[2]);
    }
  };
  const auto each_pair = [&](auto collide) {
    return milliseconds([&] {
      for (std::size_t i = 0; i < 2 * count; i += 2) collide(i, i + 1);
    });
  };
  for (int r = -1; r < options.repetitions; ++r) {  // the first is to warm up
    std::vector<double> ms;
    stir(3 * r + 3);
    ms.push_back(milliseconds([&] {
      dBatchColliderCollidePairs(collider, geoms.data(), static_cast<int>(count), kContacts,
                                 contacts.data(), sizeof(dContactGeom), counts.data());
    }));
    const ode_ext::test::PassStatistics found = collider.stats();
    result.crossings =
        static_cast<double>(found.actual[dBatchBufferCrossings]) / static_cast<double>(count);
    result.rays =
        static_cast<double>(found.actual[dBatchBufferRaysBvh]) / static_cast<double>(count);
    result.colliding =
        static_cast<int>(std::count_if(counts.begin(), counts.end(), [](int n) { return n != 0; }));
    stir(3 * r + 4);
    ms.push_back(each_pair([&](std::size_t i, std::size_t k) {
      dCollide(geoms[i], geoms[k], kContacts, contacts.data(), sizeof(dContactGeom));
    }));
    ms.push_back(each_pair([&](std::size_t i, std::size_t k) {
      dCollideTTL(geoms[i], geoms[k], kContacts, contacts.data(), sizeof(dContactGeom));
    }));
    for (const auto& rival : rivals)
      ms.push_back(each_pair([&](std::size_t i, std::size_t k) { rival->collide(i, k); }));
    if (r < 0) continue;
    for (std::size_t i = 0; i < ms.size(); ++i)
      result.contestants[i].ms.push_back(ms[i] / static_cast<double>(count));
  }
  return result;
}

// A case to be made if it is asked for.
struct Case {
  std::string shape, depth;
  int triangles_a, triangles_b;
  std::function<bench::PairCase(const std::string& name, int pairs)> make;

  std::string name() const {
    return shape + ' ' + std::to_string((triangles_a + triangles_b) / 2) +
           (depth.empty() ? "" : ", " + depth);
  }
};

using MakeCase = decltype(bench::make_case);

void add_shape(const std::string& shape, const test::TestMesh& a, const test::TestMesh& b,
               std::vector<Case>& cases, MakeCase& make_case = bench::make_case) {
  const std::vector<bench::Depth> depths = {
      {"apart", -0.02, 0}, {"near", 0, 0.002}, {"shallow", 0.01, 0}, {"deep", 0.2, 0}};
  for (const bench::Depth& depth : depths)
    cases.push_back({shape, depth.name, a.triangle_count(), b.triangle_count(),
                     [=, &make_case](const std::string& name, int pairs) {
                       return make_case(name, a, b, depth, pairs, 1);
                     }});
}

std::vector<Case> cases_of(const Options& options) {
  std::vector<Case> cases;
  if (!options.replay.empty()) {
    for (const bench::PairCase& one : bench::captured_cases(options.replay, options.pairs))
      cases.push_back({one.name, "", one.a.triangle_count(), one.b.triangle_count(),
                       [one](const std::string&, int) { return one; }});
    return cases;
  }
  add_shape("tori", test::make_torus(0.4, 0.15, 48, 24), test::make_torus(0.4, 0.15, 72, 24),
            cases);
  for (const int triangles : options.triangles) {
    const test::TestMesh rock = bench::make_rock(triangles);
    add_shape("rocks", rock, rock, cases);
    add_shape("hills", rock, bench::make_hills(triangles), cases);
    const test::TestMesh ground = bench::make_ground(triangles);
    add_shape("ground", rock, ground, cases, bench::make_case_from_above);
    add_shape("debris", test::make_tetrahedron(1), ground, cases, bench::make_case_from_above);
  }
  for (const test::WorstPair& worst : test::worst_pairs())
    cases.push_back({"worst: " + worst.name, "", worst.a.triangle_count(), worst.b.triangle_count(),
                     [worst](const std::string& name, int) {
                       return bench::PairCase{name, worst.a, worst.b, {{{}, worst.pose}}};
                     }});
  return cases;
}

std::FILE* begin_csv(const std::string& path) {
  std::FILE* csv = std::fopen(path.c_str(), "w");
  if (csv == nullptr) throw std::runtime_error("cannot write '" + path + "'");
  std::fprintf(csv,
               "shape,triangles_a,triangles_b,depth,pairs,colliding,crossings,rays,collider,ms,"
               "ode_over_it\n");
  return csv;
}

void run(const Options& options) {
  std::FILE* csv = options.csv.empty() ? nullptr : begin_csv(options.csv);
  std::printf("ms a pair, medians of %d; %d pairs a batch, fewer of large meshes\n\n",
              options.repetitions, options.pairs);
  bool named = false;
  for (const Case& one_case : cases_of(options)) {
    const std::string name = one_case.name();
    if (name.find(options.only) == std::string::npos) continue;
    const int triangles = one_case.triangles_a + one_case.triangles_b;
    const bench::PairCase pair_case =
        one_case.make(name, std::max(4, std::min(options.pairs, 8000000 / triangles)));
    const int count = static_cast<int>(pair_case.pairs.size());
    const Result result = measure(pair_case, options);
    const std::vector<Contestant>& all = result.contestants;
    if (!std::exchange(named, true)) {
      std::printf("%-24s %9s %9s %9s", "", "colliding", "crossings", "rays");
      for (const Contestant& one : all) std::printf(" %9s", one.name.c_str());
      std::printf(" %10s %10s\n", "ODE/batch", "ODE/alone");
    }
    std::printf("%-24s %5d/%3d %9.1f %9.1f", name.c_str(), result.colliding, count,
                result.crossings, result.rays);
    for (const Contestant& one : all) std::printf(" %9.4f", median(one.ms));
    const auto ode_over = [&](const Contestant& one) {
      return median(bench::ratios(all[kOde].ms, one.ms));
    };
    std::printf(" %10.2f %10.2f\n", ode_over(all[kBatch]), ode_over(all[kAlone]));
    std::fflush(stdout);
    if (csv == nullptr) continue;
    for (const Contestant& one : all)
      std::fprintf(csv, "%s,%d,%d,%s,%d,%d,%g,%g,%s,%g,%g\n", one_case.shape.c_str(),
                   one_case.triangles_a, one_case.triangles_b, one_case.depth.c_str(), count,
                   result.colliding, result.crossings, result.rays, one.name.c_str(),
                   median(one.ms), ode_over(one));
  }
  if (csv != nullptr) std::fclose(csv);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "What a pair of meshes costs: this library in a batch and alone, ODE's own collider, FCL "
      "(every contact, and yes or no) and Bullet's GImpact. At four depths two tori, two rocks, a "
      "rock on hills, met from anywhere, a rock and debris of four triangles on ground, from "
      "above; and pairs that are hard on a collider ('worst'). One thread of the device's with "
      "POCL_MAX_PTHREAD_COUNT=1.",
      "pair_times"};
  Options options;
  app.add_option("--pairs", options.pairs, "pairs a batch, fewer of large meshes")
      ->check(CLI::Range(4, 100000))
      ->capture_default_str();
  app.add_option("--repetitions", options.repetitions, "medians of so many")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--triangles", options.triangles, "of the rocks, a row of depths for each")
      ->check(CLI::Range(24, 10000000))
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--only", options.only, "only cases whose name has this, for instance 'shallow'");
  app.add_option("--replay", options.replay,
                 "a capture (ODE_EXT_CAPTURE): its meshes in the poses in which they met");
  app.add_option("--csv", options.csv, "write the figures there too");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  try {
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pair_times: %s\n", error.what());
    return 1;
  }
  return 0;
}
