// SPDX-License-Identifier: BSD-3-Clause
// What --check and --check-rest look for; --help says it in words.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "judging/draping.h"
#include "judging/penetration.h"
#include "simulation/scene.h"
#include "simulation/step_record.h"

namespace falling_objects {

// One kind of failure: how often, and the first and the worst in words.
class Finding {
 public:
  explicit Finding(std::string what) : what_(std::move(what)) {}
  void add(double badness, const std::string& words);
  bool empty() const { return count_ == 0; }
  std::string describe() const;

 private:
  std::string what_;
  long long count_ = 0;
  double worst_badness_ = 0;
  std::string first_, worst_;
};

class Checks {
 public:
  Checks(const Scene& scene, double hz) : scene_(scene), hz_(hz) {}

  // After every step. Returns false if a state is not finite: nothing can go on from there.
  bool after_step(const StepRecord& record, std::span<const dContactGeom> contacts);
  // `too_deep`: what the oracle found deeper than allowed.
  void after_measurement(int step, const std::vector<Penetration>& too_deep);
  // Where the sheets are at the end.
  void after_draping(const Draping& draping);
  // In every step of the last 0.5 s.
  void collect_speeds(const StepRecord& record);
  void judge_rest();

  std::size_t lost_objects() const { return lost_.size(); }
  std::vector<std::string> failures() const;

 private:
  std::string at(int step) const;

  const Scene& scene_;
  double hz_;
  std::map<std::size_t, int> lost_;  // object, step
  // Pairs too deep at the last measurement, and the step since when.
  std::map<std::pair<std::size_t, std::size_t>, int> too_deep_since_;
  std::vector<double> final_speeds_;
  double fastest_vertex_ = 0;

  Finding not_finite_{"a state that is not finite"};
  Finding fell_out_{"objects below the ground or out of the bowl"};
  Finding impossible_{"contacts deeper than the smaller object's bounding diameter"};
  Finding stuck_{"pairs deeper inside each other than half their thinnest part for over 0.5 s"};
  Finding device_{"the device failed"};
  Finding restless_{"not at rest at the end"};
  Finding inside_{"vertices of sheets inside an object or the ground"};
  Finding crossing_{"triangles of sheets that cross an object or the ground"};
};

}  // namespace falling_objects
