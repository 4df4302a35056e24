// SPDX-License-Identifier: BSD-3-Clause
// What it costs to make a mesh: how long the first pass takes that meets it, beyond a second one,
// and by how much memory the process grows, device memory included where the device is the
// processor. What a cube costs that comes when it is there. ODE's own build of the same mesh beside
// it.
#include <malloc.h>
#include <ode/ode.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/pair_cases.h"
#include "bench/timing.h"
#include "support/arguments.h"
#include "support/batch_collider.h"
#include "support/ode_world.h"

namespace {

using namespace ode_ext;
using bench::milliseconds;
using test::TestMesh;

struct Options {
  std::vector<int> triangles = {1000, 10000, 100000, 1000000, 2000000};
  int repetitions = 3;
  std::string csv;
};

// Resident, without what the allocator keeps.
double bytes_in_use() {
  malloc_trim(0);
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  if (!(statm >> size >> resident)) throw std::runtime_error("cannot read /proc/self/statm");
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Separate needles in a box of 1 m, each a third of it long: four triangles each.
TestMesh make_needles(int triangles) {
  test::Random random(1);
  TestMesh needle = test::scaled(test::make_tetrahedron(1), 0.001);
  needle.vertices[2] += 0.33f;
  TestMesh mesh;
  for (int i = 0; i < std::max(1, triangles / 4); ++i) {
    const test::TestPose pose = random.pose(0.3);
    const auto first = static_cast<unsigned>(mesh.vertices.size() / 3);
    for (const unsigned index : needle.indices) mesh.indices.push_back(first + index);
    for (std::size_t v = 0; v < static_cast<std::size_t>(needle.vertex_count()); ++v) {
      const test::Point turned = test::rotate(pose, needle.vertex(v));
      for (std::size_t k = 0; k < 3; ++k)
        mesh.vertices.push_back(static_cast<float>(turned[k] + pose.position[k]));
    }
  }
  return mesh;
}

struct Cost {
  double ode_ms, ms, bytes, cube_ms;
};

Cost measure(const TestMesh& made) {
  test::OdeWorld world;
  const test::BatchCollider collider;
  const dSpaceID space = world.space(test::SpaceKind::Simple);
  const test::OdeMesh& cube = world.mesh(test::make_cube(0.1));
  world.geom(cube, {}, space);
  world.geom(cube, test::at(0.05, 0, 0), space);
  collider.pass(space);  // the kernels are ready
  // How long the next pass takes beyond one after it, of new poses both: else answers are kept.
  const auto beyond_another = [&](dGeomID moved) {
    const double first = milliseconds([&] { collider.pass(space); });
    const dReal* at = dGeomGetPosition(moved);
    dGeomSetPosition(moved, at[0], at[1], at[2] + 1e-3);
    return first - milliseconds([&] { collider.pass(space); });
  };
  Cost cost{};
  const test::OdeMesh* mesh = nullptr;
  cost.ode_ms = milliseconds([&] { mesh = &world.mesh(made); });
  const dGeomID geom = world.geom(*mesh, test::at(0, 0, 0), space);
  const double before = bytes_in_use();
  cost.ms = beyond_another(geom);
  cost.bytes = bytes_in_use() - before;
  cost.cube_ms =
      beyond_another(world.geom(world.mesh(test::make_cube(0.12)), test::at(0, 0.05, 0), space));
  return cost;
}

Cost median_cost(const TestMesh& mesh, int repetitions) {
  std::vector<Cost> costs;
  for (int i = 0; i < repetitions; ++i) costs.push_back(measure(mesh));
  const auto median_of = [&](double Cost::*part) {
    std::vector<double> values;
    for (const Cost& cost : costs) values.push_back(cost.*part);
    return bench::median(values);
  };
  return {median_of(&Cost::ode_ms), median_of(&Cost::ms), median_of(&Cost::bytes),
          median_of(&Cost::cube_ms)};
}

void run(const Options& options) {
  std::FILE* csv = nullptr;
  if (!options.csv.empty()) {
    csv = std::fopen(options.csv.c_str(), "w");
    if (csv == nullptr) throw std::runtime_error("cannot write '" + options.csv + "'");
    std::fprintf(csv, "kind,triangles,ms,ns_a_triangle,bytes_a_triangle,cube_ms,ode_ms\n");
  }
  struct Kind {
    const char* name;
    TestMesh (*make)(int);
  };
  std::printf("%-10s %10s %12s %14s %17s %14s %12s\n", "", "triangles", "made in ms",
              "ns a triangle", "bytes a triangle", "a cube in ms", "ODE's in ms");
  for (const Kind& kind : {Kind{"rock", bench::make_rock}, Kind{"hills", bench::make_hills},
                           Kind{"needles", make_needles}})
    for (const int triangles : options.triangles) {
      if (kind.make == make_needles && triangles > 50000) continue;
      const TestMesh mesh = kind.make(triangles);
      const Cost cost = median_cost(mesh, options.repetitions);
      const double count = mesh.triangle_count(), ns = 1e6 * cost.ms / count;
      std::printf("%-10s %10.0f %12.1f %14.0f %17.0f %14.2f %12.1f\n", kind.name, count, cost.ms,
                  ns, cost.bytes / count, cost.cube_ms, cost.ode_ms);
      std::fflush(stdout);
      if (csv != nullptr)
        std::fprintf(csv, "%s,%.0f,%g,%g,%g,%g,%g\n", kind.name, count, cost.ms, ns,
                     cost.bytes / count, cost.cube_ms, cost.ode_ms);
    }
  if (csv != nullptr) std::fclose(csv);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "What it costs to make a mesh, in time and memory: closed rocks, open hills, separate "
      "needles.",
      "mesh_times"};
  Options options;
  app.add_option("--triangles", options.triangles, "about so many, a row for each")
      ->check(CLI::Range(24, 10000000))
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--repetitions", options.repetitions, "medians of so many")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app.add_option("--csv", options.csv, "write the figures there too");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  try {
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mesh_times: %s\n", error.what());
    return 1;
  }
  return 0;
}
