// SPDX-License-Identifier: BSD-3-Clause
// All that a run starts from, as a scene file says it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "meshes/shapes.h"
#include "meshes/triangle_mesh.h"
#include "scene_file/gravity.h"

namespace falling_objects {

using Quaternion = std::array<double, 4>;  // w, x, y, z; of length 1

enum class Solver { kQuick, kExact };  // dWorldQuickStep, dWorldStep

struct WorldSettings {
  Point gravity{0, 0, -kGravity};  // [m/s^2]
  Solver solver = Solver::kQuick;
  int iterations = 20;  // of the quick solver
  double erp = 0.2, cfm = 1e-5;
  double surface_layer = 0.005;                          // how deep bodies rest in each other [m]
  double correcting_speed = 1;                           // at which overlaps part, at most [m/s]
  double linear_damping = 0.01, angular_damping = 0.02;  // shares of a speed lost in a step
};

struct ContactSettings {
  int per_pair = 16;  // contacts at most
  double mu = 0.5;
  double bounce = 0, bounce_speed = 0.1;     // a share of the speed; from which speed on [m/s]
  std::optional<double> soft_erp, soft_cfm;  // of contacts; none: the world's
};

// A place to look from.
struct CameraHint {
  Point eye{}, target{};  // [m]
};

// Objects above a bowl, of all meshes of the scene in equal numbers; sheets of cloth above them.
struct Drop {
  int objects = 1000;
  int sheets = 0;
};

enum class Motion { kFree, kFixed, kDriven };  // driven: goes on with its velocity, whatever comes

struct BodyDescription {
  std::string name;
  std::size_t mesh = 0;
  Point position{};  // of the center of mass [m]
  Quaternion rotation{1, 0, 0, 0};
  Point velocity{}, spin{};  // [m/s], [rad/s]
  double density = 500;      // [kg/m^3]
  std::optional<double> mu;  // two bodies rub with the smaller of theirs; none: that of the scene
  Motion motion = Motion::kFree;
};

struct Motor {
  double speed;  // [m/s], [rad/s]
  double force;  // at most [N], [N m]
};

struct JointDescription {
  enum class Kind { kHinge, kSlider };
  Kind kind = Kind::kHinge;
  std::size_t body = 0;
  std::optional<std::size_t> other;  // none: the world
  Point anchor{};                    // [m], of a hinge
  Point axis{0, 0, 1};
  std::optional<Motor> motor;
};

// What the scene is to show; falling_objects --check judges it.
struct Expectation {
  enum class Kind { kRatio, kScrew, kStill, kStays, kMoves, kAbove, kApart };
  Kind kind = Kind::kStill;
  std::vector<std::size_t> bodies;  // empty: all that can move
  std::size_t other = 0;            // of a ratio
  // Ratio: of the two speeds; screw: pitch [m]; still: speed [m/s]; stays, moves: [m];
  // above: height [m]; apart: depth [m].
  double value = 0;
  double within = 0;  // ratio: a share of it; screw: a share of a pitch
  double turns = 0;   // screw: so many at least
  double after = 0, until = std::numeric_limits<double>::infinity();  // [s] while it holds
};

struct SceneDescription {
  std::string title;
  std::vector<std::string> files;  // that were read for it
  int steps = 600;
  double hz = 60;
  WorldSettings world;
  ContactSettings contact;
  std::optional<CameraHint> camera;
  std::vector<NamedMesh> meshes;  // centered on their centers of mass
  std::optional<Drop> drop;
  std::vector<BodyDescription> bodies;
  std::vector<JointDescription> joints;
  std::vector<Expectation> expectations;
};

}  // namespace falling_objects
