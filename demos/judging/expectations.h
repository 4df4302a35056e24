// SPDX-License-Identifier: BSD-3-Clause
// Whether what a scene is to show comes to pass ([[expect]] of its file).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "simulation/scene.h"

namespace falling_objects {

struct Outcome {
  std::string words;  // what was measured, and what was expected
  bool holds;
};

class Expectations {
 public:
  Expectations(const Scene& scene, double hz);

  void after_step();
  // How deep the deepest are in one another now, as measured on the meshes [m]; not called where
  // it cannot be.
  void after_measurement(double deepest);
  std::vector<Outcome> outcomes() const;

 private:
  // How far a body has turned about an axis, second by second.
  struct Turning {
    std::size_t body;
    Point axis;                     // of length 1
    double in_all = 0;              // [rad]
    std::vector<double> by_second;  // [rad]
  };
  // An expectation and what has been seen of it.
  struct Watch {
    Expectation what;
    std::vector<std::size_t> bodies;  // which it is about
    std::vector<Turning> turnings;    // of them, for ratios and screws
    std::vector<Point> start;         // where they were when it began to hold [m]
    int samples = 0;                  // looks at where they are
    double farthest = 0;              // from there, or off a screw's thread [m]
    double lowest = std::numeric_limits<double>::infinity();  // center of one [m]
    double deepest = -1;         // in one another [m]; negative: not measured yet
    std::vector<double> speeds;  // of the fastest, in each step [m/s]
  };
  Turning turning_of(std::size_t body) const;
  void look(Watch& watch, double time) const;
  Outcome judge(const Watch& watch) const;
  Outcome judge_ratio(const Watch& watch) const;
  Outcome judge_screw(const Watch& watch) const;
  Outcome judge_still(const Watch& watch) const;
  Outcome judge_way(const Watch& watch) const;
  Outcome judge_above(const Watch& watch) const;
  Outcome judge_apart(const Watch& watch) const;
  std::string name_of(const Watch& watch) const;

  const Scene& scene_;
  double hz_;
  int steps_ = 0;
  std::vector<Watch> watches_;
};

}  // namespace falling_objects
