// SPDX-License-Identifier: BSD-3-Clause
#include "cloth/cloth.h"

#include <algorithm>
#include <cmath>

namespace falling_objects {
namespace {

// Under its own weight a hanging link of n below it is too long by 2 n g h^2, h the substep: at
// 60 Hz 0.3 mm for the 20 rows that hang over an object's side, 1 % of their 25 mm.
constexpr int kSubsteps = 16;
constexpr double kDensity = 0.3;  // [kg/m^2], as a heavy cotton
// Air: broadside such a sheet falls at no more than g / kDrag = 1.6 m/s. Linear, because it stands
// for the cloth's inner friction too, which is what ends the last small swings.
constexpr double kDrag = 6;       // [1/s]
constexpr double kBending = 0.3;  // share of a fold that a substep takes back
// A vertex that starts below a plane comes up at this speed [m/s] and keeps none of it.
constexpr double kRise = 0.5;
// A vertex that ends a step having moved at less than this speed [m/s] has not moved: static
// friction of the threads. What is not held up gains g / 60 = 0.16 m/s in a step, so nothing that
// should fall is kept by it; where gravity is less, so is this.
constexpr double kRestSpeed = 0.03;
// Contacts come and go from step to step, and a vertex between two of them would swing from one to
// the other for ever. One that turns back in a step moves by half of what it would in the next, and
// so on; one that does not gets a quarter of it back in every step, all of it within 0.3 s. A sheet
// that is at rest as a whole gives nothing back, so that all swinging ends, until it is woken: when
// what it lies on moves, or half of what it lay on is gone.
constexpr double kTurnedBack = 0.5, kWentOn = 1.25, kLeastEagerness = 1.0 / 64;
constexpr double kCalmSpeed = 0.05;  // [m/s] mean of a sheet that is at rest as a whole
constexpr double kCalmAfter = 0.5;   // [s]

}  // namespace

Cloth::Cloth(unsigned quads, double size, Vector gravity)
    : quads_(quads),
      spacing_(size / quads),
      vertex_mass_(kDensity * size * size / (side() * side())),
      gravity_(gravity),
      rest_speed_(kRestSpeed * std::min(1.0, length(gravity) / kGravity)) {
  for (unsigned j = 0; j <= quads; ++j) {
    for (unsigned i = 0; i <= quads; ++i) {
      positions_.push_back({i * spacing_ - size / 2, j * spacing_ - size / 2, 0});
    }
  }
  velocities_.resize(positions_.size());
  last_ways_.resize(positions_.size());
  eagerness_.resize(positions_.size(), 1);
  for (unsigned j = 0; j < quads; ++j) {
    for (unsigned i = 0; i < quads; ++i) {
      const unsigned a = j * side() + i, b = a + 1, c = b + side(), d = a + side();
      triangles_.insert(triangles_.end(), {a, b, c, a, c, d});
    }
  }
}

Vector Cloth::free_flight(std::size_t vertex, double dt) const {
  return positions_[vertex] + dt * (velocities_[vertex] + dt * gravity_);
}

void Cloth::step(double dt, std::span<ClothContact> contacts) {
  const double h = dt / kSubsteps;
  const double kept = std::exp(-kDrag * h);
  start_ = positions_;
  planes_.clear();
  bool woken = false;
  for (ClothContact& contact : contacts) {
    const double speed = dot(contact.normal, contact.velocity);
    const double height =
        dot(contact.normal, positions_[contact.vertex]) + dt * speed - contact.offset;
    planes_.push_back(
        {contact.normal, contact.offset, speed, std::min(0.0, height), contact.vertex});
    contact.impulse = {};
    woken = woken || contact.wakes;
  }
  if (woken || 2 * contacts.size() < calm_contacts_) wake();
  for (int substep = 1; substep <= kSubsteps; ++substep) {
    previous_ = positions_;
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      velocities_[i] = kept * (velocities_[i] + h * gravity_);
      positions_[i] = positions_[i] + h * velocities_[i];
    }
    solve_distances();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Plane& plane = planes_[i];
      const double level = plane.offset - (dt - substep * h) * plane.speed +
                           std::min(0.0, plane.start + kRise * substep * h);
      if (dot(plane.normal, positions_[plane.vertex]) < level) solve_contact(contacts[i], level, h);
    }
    hold_pins();
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      velocities_[i] = (1 / h) * (positions_[i] - previous_[i]);
    }
  }
  settle(dt);
}

// Links to the next vertex and across both diagonals keep the sheet's size, those to the next but
// one keep it from folding sharply.
void Cloth::solve_distances() {
  const unsigned n = side();
  solve_links(n - 1, n, 1, 0, 1);
  solve_links(n, n - 1, 0, 1, 1);
  solve_links(n - 1, n - 1, 1, 1, 1);
  solve_links(n - 1, n - 1, -1, 1, 1);
  solve_links(n - 2, n, 2, 0, kBending);
  solve_links(n, n - 2, 0, 2, kBending);
}

// All links from a vertex to the one `across` columns and `along` rows further. The inner loop runs
// where neighbouring links share no vertex, so that a processor can overlap them.
void Cloth::solve_links(unsigned columns, unsigned rows, int across, int along, double stiffness) {
  const int n = static_cast<int>(side());
  const double rest = spacing_ * spacing_ * (across * across + along * along);
  const auto solve = [&](int i, int j) {
    Vector& a = positions_[static_cast<std::size_t>(j * n + i)];
    Vector& b = positions_[static_cast<std::size_t>((j + along) * n + i + across)];
    const Vector apart = b - a;
    // (1 - rest / length) / 2 to first order, without a root (Jakobsen 2001).
    const Vector half = (stiffness * (0.5 - rest / (dot(apart, apart) + rest))) * apart;
    a = a + half;
    b = b - half;
  };
  const int first = across < 0 ? -across : 0;
  if (along == 0) {
    for (int i = 0; i < static_cast<int>(columns); ++i) {
      for (int j = 0; j < static_cast<int>(rows); ++j) solve(i, j);
    }
  } else {
    for (int j = 0; j < static_cast<int>(rows); ++j) {
      for (int i = first; i < first + static_cast<int>(columns); ++i) solve(i, j);
    }
  }
  hold_pins();
}

// `level`: where the plane is now.
void Cloth::solve_contact(ClothContact& contact, double level, double h) {
  Vector& x = positions_[contact.vertex];
  Vector& before = previous_[contact.vertex];
  const double correction = level - dot(contact.normal, x);
  x = x + correction * contact.normal;
  // What was below before this substep is lifted, not thrown.
  const double lifted =
      std::clamp(level - h * dot(contact.normal, contact.velocity) - dot(contact.normal, before),
                 0.0, correction);
  before = before + lifted * contact.normal;
  const double pressed = correction - lifted;
  const Vector slip = x - before - h * contact.velocity;
  const Vector sideways = slip - dot(slip, contact.normal) * contact.normal;
  const double way = length(sideways);
  const double grip = contact.friction * correction;
  const Vector held = way <= grip ? sideways : (grip / way) * sideways;
  x = x - held;
  contact.impulse = contact.impulse + (vertex_mass_ / h) * (held - pressed * contact.normal);
}

void Cloth::hold_pins() {
  for (const std::size_t vertex : pinned_) positions_[vertex] = previous_[vertex];
}

void Cloth::wake() {
  calm_time_ = 0;
  calm_contacts_ = 0;
  std::fill(eagerness_.begin(), eagerness_.end(), 1.0);
}

void Cloth::settle(double dt) {
  const double went_on = calm_time_ >= kCalmAfter ? 1 : kWentOn;
  double sum = 0;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const Vector way = positions_[i] - start_[i];
    double& eagerness = eagerness_[i];
    eagerness = dot(way, last_ways_[i]) < 0 ? std::max(kLeastEagerness, kTurnedBack * eagerness)
                                            : std::min(1.0, went_on * eagerness);
    last_ways_[i] = way;
    const bool moves = eagerness * length(way) >= rest_speed_ * dt;
    const double share = moves ? eagerness : 0;
    positions_[i] = start_[i] + share * way;
    velocities_[i] = share * velocities_[i];
    sum += share * length(way);
  }
  mean_speed_ = sum / static_cast<double>(positions_.size()) / dt;
  calm_time_ = mean_speed_ < kCalmSpeed ? calm_time_ + dt : 0;
  if (calm_time_ >= kCalmAfter) calm_contacts_ = std::max(calm_contacts_, planes_.size());
}

double Cloth::fastest(double dt) const {
  double way = 0;
  for (std::size_t i = 0; i < start_.size(); ++i) {
    way = std::max(way, length(positions_[i] - start_[i]));
  }
  return way / dt;
}

}  // namespace falling_objects
