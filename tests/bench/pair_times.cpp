// SPDX-License-Identifier: BSD-3-Clause
// What a pair costs: the library in a batch and alone, ODE's own collider, and FCL, on the same
// poses, interleaved. Poses change by a hair from one repetition to the next: nobody answers from
// memory.
#include <fcl/fcl.h>
#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "bench/pair_cases.h"
#include "support/batch_collider.h"
#include "support/ode_world.h"

// ODE's own, whatever override is set; exported, but not in its headers.
int dCollideTTL(dxGeom* a, dxGeom* b, int flags, dContactGeom* contacts, int stride);

namespace {

using namespace ode_ext;

constexpr int kContacts = 16;
using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

struct Options {
  int pairs = 200;
  int repetitions = 9;
  std::string only, csv;
};

struct Times {
  std::vector<double> batch, alone, ode, fcl_all, fcl_any;  // [ms a pair]
  int colliding = 0;
};

std::shared_ptr<FclModel> fcl_model(const test::TestMesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count()); ++i)
    vertices.emplace_back(mesh.vertex(i)[0], mesh.vertex(i)[1], mesh.vertex(i)[2]);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  auto model = std::make_shared<FclModel>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d fcl_pose(const test::TestPose& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      result.linear()(r, c) = pose.rotation[static_cast<std::size_t>(3 * r + c)];
    result.translation()[r] = pose.position[static_cast<std::size_t>(r)];
  }
  return result;
}

template <class Work>
double milliseconds(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

Times measure(const bench::PairCase& pair_case, const Options& options) {
  test::OdeWorld world;
  const test::BatchCollider collider;
  const test::OdeMesh &a = world.mesh(pair_case.a), &b = world.mesh(pair_case.b);
  std::vector<dGeomID> geoms;
  std::vector<fcl::CollisionObjectd> objects;
  const auto fcl_a = fcl_model(pair_case.a), fcl_b = fcl_model(pair_case.b);
  for (const bench::PosedPair& pair : pair_case.pairs) {
    geoms.push_back(world.geom(a, pair.a));
    geoms.push_back(world.geom(b, pair.b));
    objects.emplace_back(fcl_a, fcl_pose(pair.a));
    objects.emplace_back(fcl_b, fcl_pose(pair.b));
  }
  const auto count = static_cast<int>(pair_case.pairs.size());
  const double each = 1.0 / count;
  std::vector<dContactGeom> contacts(static_cast<std::size_t>(count * kContacts));
  std::vector<int> counts(static_cast<std::size_t>(count));
  const auto stir = [&](int repetition) {
    for (int i = 0; i < count; ++i) {
      const auto& at = pair_case.pairs[static_cast<std::size_t>(i)].b.position;
      const double off = 1 + 1e-7 * repetition;
      dGeomSetPosition(geoms[static_cast<std::size_t>(2 * i + 1)], off * at[0], off * at[1],
                       off * at[2]);
    }
  };
  Times times;
  for (int r = -1; r < options.repetitions; ++r) {  // the first is to warm up
    stir(3 * r + 3);
    const double batch = milliseconds([&] {
      dBatchColliderCollidePairs(collider, geoms.data(), count, kContacts, contacts.data(),
                                 sizeof(dContactGeom), counts.data());
    });
    times.colliding =
        static_cast<int>(std::count_if(counts.begin(), counts.end(), [](int n) { return n != 0; }));
    stir(3 * r + 4);
    const double alone = milliseconds([&] {
      for (int i = 0; i < count; ++i)
        dCollide(geoms[static_cast<std::size_t>(2 * i)], geoms[static_cast<std::size_t>(2 * i + 1)],
                 kContacts, contacts.data(), sizeof(dContactGeom));
    });
    const double ode = milliseconds([&] {
      for (int i = 0; i < count; ++i)
        dCollideTTL(geoms[static_cast<std::size_t>(2 * i)],
                    geoms[static_cast<std::size_t>(2 * i + 1)], kContacts, contacts.data(),
                    sizeof(dContactGeom));
    });
    const auto fcl_time = [&](std::size_t most, bool enable) {
      return milliseconds([&] {
        for (int i = 0; i < count; ++i) {
          fcl::CollisionResultd result;
          fcl::collide(&objects[static_cast<std::size_t>(2 * i)],
                       &objects[static_cast<std::size_t>(2 * i + 1)],
                       fcl::CollisionRequestd(most, enable), result);
        }
      });
    };
    const double fcl_all = fcl_time(1000000, true), fcl_any = fcl_time(1, false);
    if (r < 0) continue;
    times.batch.push_back(batch * each);
    times.alone.push_back(alone * each);
    times.ode.push_back(ode * each);
    times.fcl_all.push_back(fcl_all * each);
    times.fcl_any.push_back(fcl_any * each);
  }
  return times;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Of the ratios of each repetition.
double ratio(const std::vector<double>& of, const std::vector<double>& to) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < of.size(); ++i) ratios.push_back(of[i] / to[i]);
  return median(ratios);
}

void run(const Options& options) {
  const std::vector<bench::Depth> depths = {
      {"apart", -0.02, 0}, {"near", 0, 0.002}, {"shallow", 0.01, 0}, {"deep", 0.2, 0}};
  struct Shape {
    const char* name;
    test::TestMesh a, b;
  };
  std::vector<Shape> shapes;
  shapes.push_back({"tori of 2,304 and 3,456", test::make_torus(0.4, 0.15, 48, 24),
                    test::make_torus(0.4, 0.15, 72, 24)});
  for (const int triangles : {100, 1000, 5000, 20000, 100000})
    shapes.push_back({"rocks", bench::make_rock(triangles), bench::make_rock(triangles)});

  std::ofstream csv;
  if (!options.csv.empty()) {
    csv.open(options.csv);
    if (!csv) throw std::runtime_error("cannot write '" + options.csv + "'");
    csv << "shape,triangles,depth,pairs,colliding,batch_ms,alone_ms,ode_ms,fcl_all_ms,fcl_any_ms\n";
  }
  std::printf("ms a pair, medians of %d; %d pairs a batch\n\n", options.repetitions, options.pairs);
  std::printf("%-24s %9s %-8s %9s %8s %8s %8s %8s %8s %10s %10s\n", "shape", "triangles", "depth",
              "colliding", "batch", "alone", "ODE", "FCL all", "FCL any", "ODE/batch", "ODE/alone");
  for (const Shape& shape : shapes)
    for (const bench::Depth& depth : depths) {
      const std::string name = std::string(shape.name) + ", " + depth.name;
      if (name.find(options.only) == std::string::npos) continue;
      const int triangles = shape.a.triangle_count() + shape.b.triangle_count();
      const int count = std::max(4, std::min(options.pairs, 8000000 / triangles));
      const Times t = measure(bench::make_case(name, shape.a, shape.b, depth, count, 1), options);
      std::printf("%-24s %9d %-8s %5d/%3d %8.4f %8.4f %8.4f %8.4f %8.4f %10.2f %10.2f\n",
                  shape.name, triangles, depth.name.c_str(), t.colliding, count, median(t.batch),
                  median(t.alone), median(t.ode), median(t.fcl_all), median(t.fcl_any),
                  ratio(t.ode, t.batch), ratio(t.ode, t.alone));
      std::fflush(stdout);
      if (csv.is_open())
        csv << shape.name << ',' << triangles << ',' << depth.name << ',' << count << ','
            << t.colliding << ',' << median(t.batch) << ',' << median(t.alone) << ','
            << median(t.ode) << ',' << median(t.fcl_all) << ',' << median(t.fcl_any) << '\n';
    }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "What a pair of meshes costs: this library in a batch and alone, ODE's own collider, "
      "FCL. One thread of the device's with POCL_MAX_PTHREAD_COUNT=1."};
  Options options;
  app.add_option("--pairs", options.pairs, "pairs a batch, fewer of large meshes")
      ->check(CLI::Range(4, 100000))
      ->capture_default_str();
  app.add_option("--repetitions", options.repetitions, "medians of so many")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--only", options.only, "only cases whose name has this, for instance 'shallow'");
  app.add_option("--csv", options.csv, "write the figures there too");
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pair_times: %s\n", error.what());
    return 1;
  }
  return 0;
}
