// SPDX-License-Identifier: BSD-3-Clause
#include "judging/expectations.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "judging/format.h"

namespace falling_objects {
namespace {

using Kind = Expectation::Kind;

constexpr double kTurn = 2 * std::numbers::pi;  // [rad]

double along(const dReal* v, const Point& axis) {
  return v[0] * axis[0] + v[1] * axis[1] + v[2] * axis[2];
}

Point position_of(const Object& object) {
  const dReal* p = dBodyGetPosition(object.body);
  return {p[0], p[1], p[2]};
}

// Of what is not a number it is none either: std::hypot takes some of that for 0.
double distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace

Expectations::Expectations(const Scene& scene, double hz) : scene_(scene), hz_(hz) {
  for (const Expectation& what : scene.description().expectations) {
    Watch watch;
    watch.what = what;
    watch.bodies = what.bodies;
    for (std::size_t i = 0; what.bodies.empty() && i < scene.objects().size(); ++i) {
      if (can_move(scene.objects()[i])) watch.bodies.push_back(i);
    }
    if (what.kind == Kind::kRatio) {
      watch.turnings = {turning_of(what.bodies[0]), turning_of(what.other)};
    } else if (what.kind == Kind::kScrew) {
      watch.turnings = {turning_of(what.bodies[0])};
    }
    watches_.push_back(std::move(watch));
  }
}

// About the axis of its hinge, or z.
Expectations::Turning Expectations::turning_of(std::size_t body) const {
  Turning turning{body, {0, 0, 1}, 0, {}};
  for (const JointDescription& joint : scene_.description().joints) {
    if ((joint.body != body && joint.other != body) || joint.kind != JointDescription::Kind::kHinge)
      continue;
    const double length = distance(joint.axis, {0, 0, 0});
    for (std::size_t k = 0; k < 3; ++k) turning.axis[k] = joint.axis[k] / length;
  }
  return turning;
}

void Expectations::after_step() {
  ++steps_;
  for (Watch& watch : watches_) look(watch, steps_ / hz_);
}

void Expectations::after_measurement(double deepest) {
  for (Watch& watch : watches_) {
    if (steps_ / hz_ >= watch.what.after) watch.deepest = std::max(watch.deepest, deepest);
  }
}

void Expectations::look(Watch& watch, double time) const {
  const auto second = static_cast<std::size_t>((steps_ - 1) / hz_);
  for (Turning& turning : watch.turnings) {
    const double angle =
        along(dBodyGetAngularVel(scene_.objects()[turning.body].body), turning.axis) / hz_;
    turning.in_all += angle;
    turning.by_second.resize(second + 1);
    turning.by_second[second] += angle;
  }
  double fastest = 0;
  for (const std::size_t i : watch.bodies) {
    const dReal* v = dBodyGetLinearVel(scene_.objects()[i].body);
    fastest = std::max(fastest, std::hypot(v[0], v[1], v[2]));
  }
  watch.speeds.push_back(fastest);
  if (time < watch.what.after || time > watch.what.until) return;
  ++watch.samples;
  const bool first = watch.start.empty();
  for (std::size_t k = 0; k < watch.bodies.size(); ++k) {
    const Point now = position_of(scene_.objects()[watch.bodies[k]]);
    if (first) watch.start.push_back(now);
    double off = distance(now, watch.start[k]);
    if (watch.what.kind == Kind::kScrew) {
      const Point& at = scene_.description().bodies[watch.bodies[k]].position;
      off = std::abs(now[2] - at[2] - watch.what.value * watch.turnings[0].in_all / kTurn);
    }
    // What is not a number is far off.
    watch.farthest = off >= 0 ? std::max(watch.farthest, off) : INFINITY;
    watch.lowest = std::isnan(now[2]) ? -INFINITY : std::min(watch.lowest, now[2]);
  }
}

std::string Expectations::name_of(const Watch& watch) const {
  if (watch.what.bodies.empty()) return "all";
  const std::string& first = scene_.description().bodies[watch.bodies[0]].name;
  if (watch.bodies.size() == 1) return first;
  return first + " to " + scene_.description().bodies[watch.bodies.back()].name;
}

std::vector<Outcome> Expectations::outcomes() const {
  std::vector<Outcome> result;
  for (const Watch& watch : watches_) result.push_back(judge(watch));
  return result;
}

Outcome Expectations::judge(const Watch& watch) const {
  const double last = std::isfinite(watch.what.until) ? watch.what.until : watch.what.after;
  const bool is_of_a_second = !watch.turnings.empty() || watch.what.kind == Kind::kStill;
  const double needed = std::ceil(last) + (is_of_a_second ? 1 : 0);
  if (steps_ < needed * hz_) {
    return {format("%s: a run of %.1f s is too short to tell, %.0f s are needed",
                   name_of(watch).c_str(), steps_ / hz_, needed),
            false};
  }
  // A way has a beginning and an end.
  const bool is_way = watch.what.kind == Kind::kStays || watch.what.kind == Kind::kMoves;
  if (watch.samples < (is_way ? 2 : 1)) {
    return {
        format("%s: too few steps after %.1f s to tell", name_of(watch).c_str(), watch.what.after),
        false};
  }
  switch (watch.what.kind) {
    case Kind::kRatio:
      return judge_ratio(watch);
    case Kind::kScrew:
      return judge_screw(watch);
    case Kind::kStill:
      return judge_still(watch);
    case Kind::kStays:
    case Kind::kMoves:
      return judge_way(watch);
    case Kind::kAbove:
      return judge_above(watch);
    case Kind::kApart:
      break;
  }
  return judge_apart(watch);
}

// Of each whole second, since what two gears do in a step is up to their play.
Outcome Expectations::judge_ratio(const Watch& watch) const {
  const Turning &one = watch.turnings[0], &other = watch.turnings[1];
  const double expected = watch.what.value;
  double worst = 0;
  const auto seconds = static_cast<std::size_t>(steps_ / hz_);
  const auto first = static_cast<std::size_t>(std::ceil(watch.what.after));
  for (std::size_t s = first; s < seconds; ++s) {
    const double off = std::abs(one.by_second[s] / other.by_second[s] / expected - 1);
    worst = off >= 0 ? std::max(worst, off) : INFINITY;
  }
  return {
      format("%s turns by %.2f, %s by %.2f: ratio %.4f, expected %.4f; of single seconds off by "
             "at most %.2f %%, allowed %.2f %%",
             name_of(watch).c_str(), one.in_all / kTurn,
             scene_.description().bodies[watch.what.other].name.c_str(), other.in_all / kTurn,
             one.in_all / other.in_all, expected, 100 * worst, 100 * watch.what.within),
      seconds > first && worst <= watch.what.within};
}

Outcome Expectations::judge_screw(const Watch& watch) const {
  const Turning& turning = watch.turnings[0];
  const double turns = std::abs(turning.in_all) / kTurn;
  double slowest = INFINITY;
  const auto seconds = static_cast<std::size_t>(steps_ / hz_);
  for (std::size_t s = static_cast<std::size_t>(std::ceil(watch.what.after)); s < seconds; ++s)
    slowest = std::min(slowest, std::abs(turning.by_second[s]) / kTurn);
  const double off = watch.farthest / std::abs(watch.what.value);
  // A second in which next to nothing is turned is one in which it is stuck.
  const bool stuck = slowest < 0.1 * turns / std::max(1.0, steps_ / hz_);
  return {format("%s turns by %.2f, expected %.2f at least, %.3f in the slowest second; off its "
                 "thread by at most %.3f pitches, allowed %.3f",
                 name_of(watch).c_str(), turning.in_all / kTurn, watch.what.turns, slowest, off,
                 watch.what.within),
          turns >= watch.what.turns && !stuck && off <= watch.what.within};
}

Outcome Expectations::judge_still(const Watch& watch) const {
  const auto second = static_cast<std::size_t>(std::max(1L, std::lround(hz_)));
  const auto last = static_cast<std::ptrdiff_t>(std::min(watch.speeds.size(), second));
  const double fastest = *std::max_element(watch.speeds.end() - last, watch.speeds.end());
  return {format("%s: fastest in the last second %.4f m/s, allowed %.4f", name_of(watch).c_str(),
                 fastest, watch.what.value),
          fastest <= watch.what.value};
}

Outcome Expectations::judge_way(const Watch& watch) const {
  const bool stays = watch.what.kind == Kind::kStays;
  return {format("%s: at most %.4f m from where it was at %.1f s, %s %.4f", name_of(watch).c_str(),
                 watch.farthest, watch.what.after, stays ? "allowed" : "expected at least",
                 watch.what.value),
          stays ? watch.farthest <= watch.what.value
                : watch.farthest >= watch.what.value && std::isfinite(watch.farthest)};
}

Outcome Expectations::judge_above(const Watch& watch) const {
  return {format("%s: at %.4f m at the lowest, allowed %.4f", name_of(watch).c_str(), watch.lowest,
                 watch.what.value),
          watch.lowest >= watch.what.value};
}

Outcome Expectations::judge_apart(const Watch& watch) const {
  if (watch.deepest < 0) {
    return {"all: how deep they are in one another cannot be told of open meshes", false};
  }
  return {format("all: at most %.4f m deep in one another after %.1f s, allowed %.4f",
                 watch.deepest, watch.what.after, watch.what.value),
          watch.deepest <= watch.what.value};
}

}  // namespace falling_objects
