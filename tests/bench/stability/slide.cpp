// SPDX-License-Identifier: BSD-3-Clause
// A box slides over flat ground of many triangles, whose edges it should not feel.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bench/stability/bench.h"
#include "bench/stability/ground.h"
#include "bench/stability/trials.h"

namespace ode_ext::stability {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr Point kBox{0.5, 0.5, 0.2};  // [m], too low to topple
// It comes to rest after v^2 / (2 mu g) = 5.14 m and v / (mu g) = 1.87 s.
constexpr double kMu = 0.3, kSpeed = 5.5, kGravity = 9.81;  // , [m/s], [m/s^2]
constexpr double kBraking = 1.5, kEnd = 3;  // [s]: over which it is measured; when it is at rest

struct Ground {
  std::string name;
  Shape shape;
};

struct Track {
  Point direction, start;
  dBodyID body;
  double hop = 0, sideways = 0;  // [m]
  double deceleration = 0;       // [m/s^2]
  double travelled = 0;          // [m]
};

std::vector<Ground> make_grounds(const GroundSize& size, const TrialOptions& options) {
  Random random(options.seed);
  return {{"regular slab", regular_slab(size)},
          {"irregular slab", irregular_slab(size, random)},
          {"open sheet", open_sheet(size)}};
}

std::vector<double> headings(const TrialOptions& options) {
  if (options.quick) return {0, 45};
  return {0, 30, 45, 60, 90, 135, 200, 290};
}

std::vector<Track> run(const std::vector<Ground>& grounds, const GroundSize& size,
                       Collider collider, const TrialOptions& options) {
  const Shape box = box_shape(kBox);
  Bench bench({.collider = collider,
               .mu = kMu,
               .gravity = kGravity,
               .max_contacts = options.max_contacts,
               .seed = options.seed});
  std::vector<Track> tracks;
  for (const Ground& ground : grounds) {
    for (const double degrees : headings(options)) {
      const std::size_t cell = tracks.size();
      const double heading = degrees * kDegree;
      const double x = 1.5 * size.size * static_cast<double>(cell);
      const Point along{std::cos(heading), std::sin(heading), 0};
      const Point start = Point{x, 0, kBox[2] / 2} - 2.6 * along;  // half of the way
      bench.add_fixed(ground.shape, ground_pose(size, x), cell);
      const dBodyID body = bench.add_body(box, turned({0, 0, 1}, heading, start), cell);
      dBodySetLinearVel(body, kSpeed * along[0], kSpeed * along[1], 0);
      // Else ODE brakes along x and along y, whatever the way that a body moves.
      bench.set_friction_direction(cell, along);
      tracks.push_back({along, start, body});
    }
  }
  while (bench.time() < kEnd) {
    bench.step();
    const bool measured = std::abs(bench.time() - kBraking) < 1e-9;
    for (Track& track : tracks) {
      const Point way = position(track.body) - track.start;
      track.travelled = dot(way, track.direction);
      track.hop = std::max(track.hop, way[2]);
      track.sideways = std::max(track.sideways, std::abs(cross(track.direction, way)[2]));
      if (measured) {
        track.deceleration = (kSpeed - dot(velocity(track.body), track.direction)) / kBraking;
      }
    }
  }
  return tracks;
}

}  // namespace

void run_slide(const TrialOptions& options, Report& report) {
  report.note(
      "slide: a box of 0.5 x 0.5 x 0.2 m at 5.5 m/s over ground of 2,048 triangles, mu 0.3 "
      "along and\nacross its way (dContactFDir1), 240 Hz");
  const GroundSize size;
  const std::vector<Ground> grounds = make_grounds(size, options);
  std::array<std::vector<Track>, 3> tracks;
  for (std::size_t c = 0; c < tracks.size(); ++c) {
    say("slide: %s", name_of(kColliders[c]));
    tracks[c] = run(grounds, size, kColliders[c], options);
  }
  std::vector<Row> rows;
  double hop = 0, sideways = 0, off = 0;
  std::size_t i = 0;
  for (const Ground& ground : grounds) {
    for (const double degrees : headings(options)) {
      Row row{{"ground", ground.name}, {"heading", degrees}};
      for (std::size_t c = 0; c < tracks.size(); ++c) {
        const Track& track = tracks[c][i];
        const std::string name = name_of(kColliders[c]);
        row[name + " hop"] = 1000 * track.hop;
        row[name + " side"] = 1000 * track.sideways;
        row[name + " decel"] = track.deceleration / (kMu * kGravity);
        row[name + " way"] = track.travelled;
      }
      rows.push_back(row);
      const Track& ext = tracks[0][i++];
      hop = std::max(hop, ext.hop);
      sideways = std::max(sideways, ext.sideways);
      off = std::max(off, std::abs(ext.deceleration / (kMu * kGravity) - 1));
    }
  }
  report.table("slide: hop [mm], sideways [mm], deceleration [mu g], way [m]", rows);
  report.target("the mesh hops less than 1 mm", hop < 1e-3);
  report.target("it is moved sideways less than 1 mm", sideways < 1e-3);
  report.target("it slows down by mu g within 5 %", off <= 0.05);
}

}  // namespace ode_ext::stability
