// SPDX-License-Identifier: BSD-3-Clause
// What a whole pass costs in a pile: this library, ODE's own collider, FCL and Bullet's GImpact on
// the same poses of a pile that falls and settles, in one run. The contacts of this library or of
// ODE drive the pile: bodies lie deeper in one another where ODE's do.
#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/pair_cases.h"
#include "bench/rivals.h"
#include "bench/timing.h"
#include "falling_objects/report.h"
#include "meshes/mesh_file.h"
#include "meshes/shapes.h"
#include "simulation/scene.h"
#include "simulation/simulation.h"
#include "support/arguments.h"
#include "support/ode_world.h"

namespace {

using namespace ode_ext;
using falling_objects::NamedMesh;

struct Options {
  int bodies = 100, steps = 300, first = 60, every = 10;
  std::vector<int> triangles;
  std::vector<std::string> meshes;
  std::string driver = "batch", csv;
  std::uint64_t seed = 1;
  bool rivals = true;
};

// Of the steps that were timed.
struct Times {
  std::vector<double> batch, ode, pairs, colliding, contacts;
  std::vector<std::vector<double>> rivals;
  std::vector<std::vector<double>> found;  // colliding pairs, of each rival
  std::vector<std::vector<double>> stages =
      std::vector<std::vector<double>>(falling_objects::stages().size());
};

falling_objects::TriangleMesh triangle_mesh(const test::TestMesh& mesh) {
  return {mesh.vertices, mesh.indices};
}

test::TestMesh test_mesh(const falling_objects::TriangleMesh& mesh) {
  return {mesh.vertices, mesh.indices};
}

struct Case {
  std::string name;
  std::vector<NamedMesh> meshes;
};

std::vector<Case> cases_of(const Options& options) {
  std::vector<Case> cases;
  for (const int triangles : options.triangles) {
    falling_objects::TriangleMesh rock = triangle_mesh(bench::make_rock(triangles));
    std::string name = "rocks of " + std::to_string(rock.triangle_count()) + " triangles";
    cases.push_back({std::move(name), {{"rock", std::move(rock)}}});
  }
  for (const std::string& path : options.meshes)
    cases.push_back({path, {{path, falling_objects::load_mesh(path)}}});
  if (cases.empty()) cases.push_back({"four shapes", falling_objects::make_shapes()});
  return cases;
}

// The same geoms and pairs as ODE's, for the others. Objects are numbered as in the scene, the
// ground comes last.
class Others {
 public:
  explicit Others(const falling_objects::Scene& scene) : scene_(scene) {
    rivals_ = bench::make_rivals();
    for (const auto& rival : rivals_) {
      for (const falling_objects::Shape& shape : scene.shapes())
        rival->add_mesh(test_mesh(shape.mesh));
      rival->add_mesh(test_mesh(scene.ground().mesh()));
      for (const falling_objects::Object& object : scene.objects()) rival->add_object(object.shape);
      rival->add_object(scene.shapes().size());
      rival->place(scene.objects().size(), {});
    }
  }

  std::size_t count() const { return rivals_.size(); }
  const char* name(std::size_t rival) const { return rivals_[rival]->name(); }

  // Poses and broad phase, once for all of them and not timed.
  void look() {
    pairs_.clear();
    dSpaceCollide(scene_.space(), &pairs_, [](void* pairs, dGeomID a, dGeomID b) {
      static_cast<Pairs*>(pairs)->emplace_back(falling_objects::index_of(a),
                                               falling_objects::index_of(b));
    });
    poses_.clear();
    for (const falling_objects::Object& object : scene_.objects())
      poses_.push_back(test::pose_of(object.geom));
  }

  double collide(std::size_t i, double& found) {
    bench::Rival& rival = *rivals_[i];
    found = 0;
    return bench::milliseconds([&] {
      for (std::size_t k = 0; k < poses_.size(); ++k) rival.place(k, poses_[k]);
      for (const auto& [a, b] : pairs_) found += rival.collide(a, b) ? 1 : 0;
    });
  }

 private:
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  const falling_objects::Scene& scene_;
  std::vector<std::unique_ptr<bench::Rival>> rivals_;
  Pairs pairs_;
  std::vector<test::TestPose> poses_;
};

Times measure(const Case& pile, const Options& options) {
  falling_objects::SimulationSettings demo;
  demo.objects = options.bodies;
  demo.seed = options.seed;
  demo.compare = true;
  demo.collider =
      options.driver == "ode" ? falling_objects::Collider::kOde : falling_objects::Collider::kBatch;
  std::vector<std::string> warnings;
  falling_objects::Scene scene(pile.meshes, demo, warnings);
  for (const std::string& warning : warnings)
    std::fprintf(stderr, "pile_times: %s\n", warning.c_str());
  falling_objects::Collision collision(demo, scene.space());
  falling_objects::Simulation simulation(demo, scene, collision, nullptr);
  std::unique_ptr<Others> others;
  if (options.rivals) others = std::make_unique<Others>(scene);
  Times times;
  times.rivals.resize(others != nullptr ? others->count() : 0);
  times.found.resize(times.rivals.size());
  for (int step = 0; step < options.steps; ++step) {
    const bool timed = step >= options.first && (step - options.first) % options.every == 0;
    if (timed && others != nullptr) {
      others->look();
      for (std::size_t i = 0; i < others->count(); ++i) {
        double found = 0;
        times.rivals[i].push_back(others->collide(i, found));
        times.found[i].push_back(found);
      }
    }
    const falling_objects::StepRecord record = simulation.step();
    if (!timed) continue;
    times.batch.push_back(record.batch_ms);
    times.ode.push_back(record.ode_ms);
    times.pairs.push_back(static_cast<double>(record.pairs));
    times.colliding.push_back(static_cast<double>(record.colliding_pairs));
    times.contacts.push_back(static_cast<double>(record.contacts));
    for (std::size_t i = 0; i < times.stages.size(); ++i)
      times.stages[i].push_back(record.stage_ms[i]);
    std::fprintf(stderr, "\rpile_times: %s, step %d of %d", pile.name.c_str(), step + 1,
                 options.steps);
  }
  std::fputc('\n', stderr);
  return times;
}

// `colliding`: pairs, negative where nobody counted them.
void print_row(std::FILE* csv, const Case& pile, const Options& options, const char* name,
               const std::vector<double>& times, const std::vector<double>& batch,
               double colliding) {
  const std::vector<double> ratios = bench::ratios(times, batch);
  const double low = bench::quantile(ratios, 0.1), middle = bench::median(ratios),
               high = bench::quantile(ratios, 0.9);
  std::printf("  %-10s %10.2f %10.2f   %.2f ... %.2f", name, bench::median(times), middle, low,
              high);
  if (colliding >= 0) std::printf("   %.0f", colliding);
  std::printf("\n");
  if (csv != nullptr)
    std::fprintf(csv, "%s,%d,%s,%s,%zu,%g,%g,%g,%g\n", pile.name.c_str(), options.bodies,
                 options.driver.c_str(), name, times.size(), bench::median(times), middle, low,
                 high);
}

void print(std::FILE* csv, const Case& pile, const Options& options, const Times& times) {
  std::printf(
      "%s, %d bodies, driven by %s; medians of %zu steps: %.0f pairs, %.0f collide, %.0f "
      "contacts\n",
      pile.name.c_str(), options.bodies, options.driver == "ode" ? "ODE" : "the batch",
      times.batch.size(), bench::median(times.pairs), bench::median(times.colliding),
      bench::median(times.contacts));
  std::printf("  %-10s %10s %10s   10 %% ... 90 %%   colliding\n", "", "ms a pass", "/ batch");
  print_row(csv, pile, options, "batch", times.batch, times.batch,
            options.driver == "batch" ? bench::median(times.colliding) : -1);
  print_row(csv, pile, options, "ODE", times.ode, times.batch,
            options.driver == "ode" ? bench::median(times.colliding) : -1);
  const std::vector<std::unique_ptr<bench::Rival>> rivals = bench::make_rivals();
  for (std::size_t i = 0; i < times.rivals.size(); ++i)
    print_row(csv, pile, options, rivals[i]->name(), times.rivals[i], times.batch,
              bench::median(times.found[i]));
  std::printf("  stages of the batch [ms]:");
  for (std::size_t i = 0; i < times.stages.size(); ++i)
    if (const double ms = bench::median(times.stages[i]); ms >= 0.005)
      std::printf(" %s %.2f", falling_objects::stage_name(i), ms);
  std::printf("\n\n");
  std::fflush(stdout);
}

int run(const Options& options) {
  std::FILE* csv = nullptr;
  if (!options.csv.empty()) {
    csv = std::fopen(options.csv.c_str(), "w");
    if (csv == nullptr) throw std::runtime_error("cannot write '" + options.csv + "'");
    std::fprintf(csv, "pile,bodies,driver,collider,steps,ms,to_batch,to_batch_10,to_batch_90\n");
  }
  dInitODE2(0);
  for (const Case& pile : cases_of(options)) print(csv, pile, options, measure(pile, options));
  dCloseODE();
  if (csv != nullptr) std::fclose(csv);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "What a pass costs in a pile of meshes: this library, ODE's own collider, FCL (every "
      "contact, "
      "and yes or no) and Bullet's GImpact on the same poses. One thread of the device's with "
      "POCL_MAX_PTHREAD_COUNT=1; the others have one thread always.",
      "pile_times"};
  Options options;
  app.add_option("--bodies", options.bodies, "in the pile")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--triangles", options.triangles,
                 "of closed, bumpy balls, a pile for each number; without it and --mesh the four "
                 "shapes of falling_objects")
      ->check(CLI::Range(24, 10000000))
      ->delimiter(',');
  app.add_option("--mesh", options.meshes, "a file, a pile for each, scaled to 1 m across")
      ->check(CLI::ExistingFile);
  app.add_option("--driver", options.driver, "whose contacts move the pile")
      ->check(CLI::IsMember({"batch", "ode"}))
      ->capture_default_str();
  app.add_option("--steps", options.steps, "of 1/60 s")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--first", options.first, "step to be timed")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  app.add_option("--every", options.every, "one step in so many is timed")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of ground and poses")->capture_default_str();
  app.add_flag("!--no-rivals", options.rivals, "this library and ODE alone");
  app.add_option("--csv", options.csv, "write the figures there too");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  try {
    if (options.first >= options.steps) throw std::runtime_error("--first is not before --steps");
    return run(options);
  } catch (const falling_objects::NoDevice& error) {
    std::fprintf(stderr, "pile_times: %s\n", error.message.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pile_times: %s\n", error.what());
  }
  return 1;
}
