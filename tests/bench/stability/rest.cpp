// SPDX-License-Identifier: BSD-3-Clause
// Single bodies dropped onto a plate of many triangles come to rest and stay where they are.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bench/stability/bench.h"
#include "bench/stability/ground.h"
#include "bench/stability/trials.h"
#include "geometry/mesh_oracle.h"
#include "meshes/shapes.h"

namespace ode_ext::stability {
namespace {

constexpr double kDrop = 0.02;                        // [m]
constexpr double kTilt = 3 * std::numbers::pi / 180;  // [rad], of what was flat
constexpr double kSettled = 5, kEnd = 10;             // [s]

struct Faller {
  std::string name;
  Shape shape;
  TestPose flat;  // stands on a face
};

// The worst of several drops.
struct Rest {
  double speed = 0, spin = 0;  // [m/s], [rad/s]: at any time from 5 s on
  double drift = 0;            // [m]: from 5 s to 10 s
  double depth = 0;            // [m]: in the ground, at the end
};

std::vector<Faller> make_fallers() {
  std::vector<Faller> fallers;
  fallers.push_back({"cube", box_shape({0.4, 0.4, 0.4}), {}});
  fallers.push_back({"cylinder", solid_shape(make_cylinder(0.2, 0.4, 24)), {}});
  falling_objects::TriangleMesh torus = falling_objects::make_bumpy_torus();
  fallers.push_back({"bumpy torus", {{torus.vertices, torus.indices}, {}}, {}});
  // The face opposite to the corner (1, -1, -1) goes down.
  const double angle = std::acos(-1 / std::sqrt(3.0));
  fallers.push_back({"tetrahedron", solid_shape(make_tetrahedron(0.5)),
                     turned(cross({-1, 1, 1}, {0, 0, -1}), angle)});
  return fallers;
}

double lowest(const Shape& shape, const TestPose& pose) {
  double low = INFINITY;
  for (int i = 0; i < shape.mesh.vertex_count(); ++i) {
    low = std::min(low, to_world(pose, shape.mesh.vertex(static_cast<std::size_t>(i)))[2]);
  }
  return low;
}

// Turned about the vertical, tilted, and at its height over the origin.
TestPose dropped(const Faller& faller, Random& random) {
  const double yaw = random.uniform(0, 2 * std::numbers::pi);
  const double towards = random.uniform(0, 2 * std::numbers::pi);
  const TestPose tilt = turned({std::cos(towards), std::sin(towards), 0}, kTilt);
  TestPose pose = composed(tilt, composed(turned({0, 0, 1}, yaw), faller.flat));
  pose.position = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0};
  pose.position[2] = kDrop - lowest(faller.shape, pose);
  return pose;
}

oracle::Pose oracle_pose(const TestPose& pose) {
  const auto& r = pose.rotation;
  const Point& p = pose.position;
  return {{{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}}}, {p[0], p[1], p[2]}};
}

Rest run(const Faller& faller, double hz, Collider collider, const TrialOptions& options) {
  const GroundSize size{.size = 4};
  const Shape slab = regular_slab(size);
  Random random(options.seed);  // the same drops for all
  Bench bench(
      {.collider = collider, .hz = hz, .max_contacts = options.max_contacts, .seed = options.seed});
  const std::size_t drops = options.quick ? 1 : 5;
  std::vector<dBodyID> bodies;
  std::vector<TestPose> grounds;
  for (std::size_t cell = 0; cell < drops; ++cell) {
    const double x = 2 * size.size * static_cast<double>(cell);
    grounds.push_back(ground_pose(size, x));
    bench.add_fixed(slab, grounds.back(), cell);
    TestPose pose = dropped(faller, random);
    pose.position[0] += x;
    bodies.push_back(bench.add_body(faller.shape, pose, cell));
  }
  while (bench.time() < kSettled) bench.step();
  std::vector<Point> settled;
  for (const dBodyID body : bodies) settled.push_back(position(body));
  Rest rest;
  while (bench.time() < kEnd) {
    bench.step();
    for (std::size_t i = 0; i < drops; ++i) {
      rest.speed = std::max(rest.speed, length(velocity(bodies[i])));
      rest.spin = std::max(rest.spin, length(angular_velocity(bodies[i])));
      rest.drift = std::max(rest.drift, distance(position(bodies[i]), settled[i]));
    }
  }
  const oracle::Mesh body(faller.shape.mesh.vertices, faller.shape.mesh.indices);
  const oracle::Mesh ground(slab.mesh.vertices, slab.mesh.indices);
  for (std::size_t i = 0; i < drops; ++i) {
    const double depth =
        oracle::penetration(body, oracle_pose(pose(bodies[i])), ground, oracle_pose(grounds[i]));
    rest.depth = std::max(rest.depth, depth);
  }
  return rest;
}

}  // namespace

void run_rest(const TrialOptions& options, Report& report) {
  report.note(
      "rest: dropped from 0.02 m, tilted by 3 degrees, onto a slab with 2,048 triangles on "
      "top, mu 0.8.\nFastest and drift: from 5 s to 10 s; depth: of vertices, at the end. "
      "The worst of 5 drops (1 with --quick).");
  std::vector<Row> rows;
  std::vector<std::string> restless;
  for (const double hz : {240.0, 60.0}) {
    for (const Faller& faller : make_fallers()) {
      for (const Collider collider : kColliders) {
        if (collider == Collider::kBoxes && !faller.shape.box) continue;
        say("rest: %s at %.0f Hz, %s", faller.name.c_str(), hz, name_of(collider));
        const Rest rest = run(faller, hz, collider, options);
        rows.push_back({{"Hz", hz},
                        {"body", faller.name},
                        {"collider", name_of(collider)},
                        {"fastest mm/s", 1000 * rest.speed},
                        {"spin mrad/s", 1000 * rest.spin},
                        {"drift mm", 1000 * rest.drift},
                        {"depth mm", 1000 * rest.depth}});
        // What gravity makes of a body in one step is as fast as one at rest can be.
        const bool rests = rest.speed <= 9.81 / hz;
        if (collider == Collider::kExt && !rests) restless.push_back(faller.name);
      }
    }
  }
  report.table("rest: how still they lie", rows);
  report.target("no mesh is ever faster than one step of gravity makes it", restless.empty());
}

}  // namespace ode_ext::stability
