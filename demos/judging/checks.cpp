// SPDX-License-Identifier: BSD-3-Clause
#include "judging/checks.h"

#include <algorithm>
#include <cmath>

#include "judging/format.h"
#include "simulation/speeds.h"

namespace falling_objects {
namespace {

bool is_finite(dBodyID body) {
  const auto all_finite = [](const dReal* values, int count) {
    return std::all_of(values, values + count, [](dReal x) { return std::isfinite(x); });
  };
  return all_finite(dBodyGetPosition(body), 3) && all_finite(dBodyGetQuaternion(body), 4) &&
         all_finite(dBodyGetLinearVel(body), 3) && all_finite(dBodyGetAngularVel(body), 3);
}

}  // namespace

void Finding::add(double badness, const std::string& words) {
  if (count_ == 0) first_ = words;
  if (count_ == 0 || badness > worst_badness_) {
    worst_badness_ = badness;
    worst_ = words;
  }
  ++count_;
}

std::string Finding::describe() const {
  std::string text = what_ + ": " + std::to_string(count_) + "; first: " + first_;
  if (worst_ != first_) text += "; worst: " + worst_;
  return text;
}

std::string Checks::at(int step) const { return format("at %.2f s ", (step + 1) / hz_); }

bool Checks::after_step(const StepRecord& record, std::span<const dContactGeom> contacts) {
  if ((record.status & dBatchStatusDeviceFailed) != 0) device_.add(0, at(record.step));
  for (const dContactGeom& contact : contacts) {
    // The ground is always the larger.
    double diameter = INFINITY;
    for (const dGeomID geom : {contact.g1, contact.g2}) {
      const std::size_t index = index_of(geom);
      if (index < scene_.objects().size())
        diameter = std::min(diameter, 2 * scene_.shape_of(index).radius);
    }
    // That of a sheet's vertex is the way along its normal, however far the surface is there.
    if (scene_.touches_sheet(contact)) continue;
    const double depth = contact.depth;
    if (!(depth <= diameter)) {
      impossible_.add(depth, at(record.step) + format("%.3f m: ", depth) +
                                 scene_.name_of(index_of(contact.g1)) + " and " +
                                 scene_.name_of(index_of(contact.g2)));
    }
  }
  const Ground& ground = scene_.ground();
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) {
    const dBodyID body = scene_.objects()[i].body;
    if (!is_finite(body)) {
      not_finite_.add(0, at(record.step) + scene_.name_of(i));
      continue;
    }
    const dReal* p = dBodyGetPosition(body);
    const double below = ground.height(p[0], p[1]) - p[2];
    const double beyond = std::max(std::abs(p[0]), std::abs(p[1])) - ground.half_size();
    if ((below > scene_.shape_of(i).radius || beyond > 0) && lost_.emplace(i, record.step).second) {
      fell_out_.add(std::max(below, beyond),
                    at(record.step) + scene_.name_of(i) +
                        format(" at (%.2f, %.2f, %.2f)", static_cast<double>(p[0]),
                               static_cast<double>(p[1]), static_cast<double>(p[2])));
    }
  }
  return not_finite_.empty();
}

void Checks::after_measurement(int step, const std::vector<Penetration>& too_deep) {
  std::map<std::pair<std::size_t, std::size_t>, int> now;
  for (const Penetration& p : too_deep) {
    const std::pair pair{p.object, p.other};
    const auto before = too_deep_since_.find(pair);
    const int since = before == too_deep_since_.end() ? step : before->second;
    now.emplace(pair, since);
    if ((step - since) / hz_ > 0.5) {
      stuck_.add(p.depth, at(step) +
                              format("%.3f m (allowed %.3f m) for %.1f s: ", p.depth, p.allowed,
                                     (step - since) / hz_) +
                              scene_.name_of(p.object) + " and " + scene_.name_of(p.other));
    }
  }
  too_deep_since_ = std::move(now);
}

void Checks::collect_speeds(const StepRecord& record) {
  fastest_vertex_ = std::max(fastest_vertex_, record.fastest_vertex);
  const std::vector<double> now = speeds(scene_);
  final_speeds_.insert(final_speeds_.end(), now.begin(), now.end());
}

void Checks::judge_rest() {
  const double one_step = kGravity / hz_;
  const double average = mean(final_speeds_);
  const double fast = quantile(final_speeds_, 0.95);
  if (!(average <= one_step / 2) || !(fast <= one_step)) {
    restless_.add(0, format("mean speed %.3f m/s (allowed %.3f), 95th percentile %.3f m/s "
                            "(allowed %.3f)",
                            average, one_step / 2, fast, one_step));
  }
  if (!(fastest_vertex_ <= kVertexMayMove)) {
    restless_.add(0, format("a vertex of a sheet at %.3f m/s (allowed %.3f)", fastest_vertex_,
                            kVertexMayMove));
  }
}

void Checks::after_draping(const Draping& draping) {
  if (draping.inside > 0) {
    inside_.add(0, format("%lld, the deepest by %.3f m (allowed %.3f m)", draping.inside,
                          draping.deepest, kVertexMayBeInside));
  }
  if (draping.crossing_share() > kTrianglesMayCross) {
    crossing_.add(0, format("%lld of %lld (allowed %.1f %%)", draping.crossing, draping.triangles,
                            100 * kTrianglesMayCross));
  }
}

std::vector<std::string> Checks::failures() const {
  std::vector<std::string> result;
  for (const Finding* finding : {&not_finite_, &fell_out_, &impossible_, &stuck_, &device_,
                                 &restless_, &inside_, &crossing_}) {
    if (!finding->empty()) result.push_back(finding->describe());
  }
  return result;
}

}  // namespace falling_objects
