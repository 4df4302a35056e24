// SPDX-License-Identifier: BSD-3-Clause
// Non-convex bodies are thrown at each other without gravity, friction and bounce: nothing may give
// them energy. What does is contacts that are too deep or point the wrong way.
#include <algorithm>
#include <string>
#include <vector>

#include "bench/stability/bench.h"
#include "bench/stability/trials.h"
#include "meshes/shapes.h"

namespace ode_ext::stability {
namespace {

constexpr double kSpeed = 1;      // [m/s], of each, towards the other
constexpr double kSeconds = 3;    // [s], at most
constexpr double kGained = 1.01;  // of the kinetic energy at the start

struct Throw {
  std::size_t shapes[2];
  TestPose poses[2];
  Point direction;  // of the first; the second flies the other way
};

struct Flight {
  dBodyID bodies[2];
  double energy;    // at the start [J]
  double most = 1;  // of it
  bool touched = false, parted = false;
};

// Horseshoe, bumpy torus, jack, gear and L, of about half a metre around their centres.
std::vector<Shape> make_shapes() {
  std::vector<Shape> shapes;
  for (falling_objects::NamedMesh& named : falling_objects::make_shapes()) {
    shapes.push_back({{std::move(named.mesh.vertices), std::move(named.mesh.indices)}, {}});
  }
  shapes.push_back(solid_shape(make_l(0.8)));
  return shapes;
}

double radius(const Shape& shape) {
  double largest = 0;
  for (int i = 0; i < shape.mesh.vertex_count(); ++i) {
    largest = std::max(largest, length(shape.mesh.vertex(static_cast<std::size_t>(i))));
  }
  return largest;
}

std::vector<Throw> make_throws(int count, const std::vector<Shape>& shapes, Random& random) {
  std::vector<Throw> throws;
  for (int i = 0; i < count; ++i) {
    Throw thrown{};
    double apart = 0.05;  // [m] between their bounding spheres
    for (std::size_t k = 0; k < 2; ++k) {
      thrown.shapes[k] = static_cast<std::size_t>(random.below(static_cast<int>(shapes.size())));
      thrown.poses[k] = random.pose(0);
      apart += radius(shapes[thrown.shapes[k]]);
    }
    // Past each other by up to half a radius of such a shape.
    const Point d = random.direction();
    const Point aside = random.uniform(0, 0.25) * unit(cross(d, random.direction()));
    thrown.direction = d;
    thrown.poses[0].position = -apart / 2 * d + aside;
    thrown.poses[1].position = apart / 2 * d - aside;
    throws.push_back(thrown);
  }
  return throws;
}

double energy(const Flight& flight) {
  return kinetic_energy(flight.bodies[0]) + kinetic_energy(flight.bodies[1]);
}

std::vector<Flight> run(const std::vector<Throw>& throws, const std::vector<Shape>& shapes,
                        double hz, Collider collider, const TrialOptions& options) {
  Bench bench({.collider = collider,
               .hz = hz,
               .mu = 0,
               .gravity = 0,
               .max_contacts = options.max_contacts,
               .seed = options.seed});
  std::vector<Flight> flights;
  for (const Throw& thrown : throws) {
    const std::size_t cell = flights.size();
    Flight flight{};
    for (std::size_t k = 0; k < 2; ++k) {
      TestPose pose = thrown.poses[k];
      pose.position[0] += 5.0 * static_cast<double>(cell);
      flight.bodies[k] = bench.add_body(shapes[thrown.shapes[k]], pose, cell);
      const Point v = (k == 0 ? kSpeed : -kSpeed) * thrown.direction;
      dBodySetLinearVel(flight.bodies[k], v[0], v[1], v[2]);
    }
    flight.energy = energy(flight);
    flight.most = 1;
    flights.push_back(flight);
  }
  while (bench.time() < kSeconds) {
    bench.step();
    for (std::size_t cell = 0; cell < flights.size(); ++cell) {
      Flight& flight = flights[cell];
      if (flight.parted) continue;
      flight.touched = flight.touched || bench.contacts(cell) > 0;
      flight.most = std::max(flight.most, energy(flight) / flight.energy);
      const Point apart = position(flight.bodies[1]) - position(flight.bodies[0]);
      const Point away = velocity(flight.bodies[1]) - velocity(flight.bodies[0]);
      const Throw& thrown = throws[cell];
      const double reach = radius(shapes[thrown.shapes[0]]) + radius(shapes[thrown.shapes[1]]);
      flight.parted = length(apart) > reach && dot(apart, away) > 0;
      if (flight.parted) bench.retire(cell);
    }
  }
  return flights;
}

}  // namespace

void run_throws(const TrialOptions& options, Report& report) {
  const int count = options.quick ? 40 : 200;
  report.note(
      "throws: two non-convex meshes at 1 m/s each against one another, no gravity, mu 0, "
      "no bounce,\nuntil they have parted or for 3 s. Energy is of the start.");
  const std::vector<Shape> shapes = make_shapes();
  Random random(options.seed);
  const std::vector<Throw> throws = make_throws(count, shapes, random);
  std::vector<Row> rows;
  std::vector<std::pair<double, int>> gained_with_ext;
  for (const double hz : {240.0, 60.0}) {
    for (const Collider collider : kMeshColliders) {
      say("throws: %d at %.0f Hz, %s", count, hz, name_of(collider));
      int gained = 0, touched = 0, parted = 0;
      double most = 0;
      for (const Flight& flight : run(throws, shapes, hz, collider, options)) {
        gained += !(flight.most <= kGained);  // not finite is gained, too
        touched += flight.touched;
        parted += flight.parted;
        most = std::max(most, flight.most);
      }
      rows.push_back({{"Hz", hz},
                      {"collider", name_of(collider)},
                      {"throws", count},
                      {"in contact", touched},
                      {"parted", parted},
                      {"energy above 1.01", gained},
                      {"most energy", most}});
      if (collider == Collider::kExt) gained_with_ext.emplace_back(hz, gained);
    }
  }
  report.table("throws: how many gain energy", rows);
  for (const auto& [hz, gained] : gained_with_ext) {
    report.target("no throw at " + std::to_string(static_cast<int>(hz)) + " Hz gains energy",
                  gained == 0);
  }
}

}  // namespace ode_ext::stability
