// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "meshes/random.h"

namespace falling_objects {
namespace {

constexpr double kApart = 1.2 * kSheetSize;  // [m] between the middles of neighbours
constexpr double kLayer = 0.4;               // [m] between layers
constexpr double kLargestTurn = 0.1;         // [rad]: neighbours stay apart
// The collider is shown a vertex this much [m] further into what it rested on: a vertex that is
// held by the pull of its neighbours alone would otherwise be inside in every other step only.
constexpr double kPress = 0.003;
constexpr unsigned kThreads = 2;

}  // namespace

Sheets::Sheets(std::size_t count, std::uint64_t seed, Scene& scene)
    : scene_(scene), contacts_(scene, sheets_, count) {
  dVector3 g;
  dWorldGetGravity(scene.world(), g);
  const Vector gravity{g[0], g[1], g[2]};
  for (std::size_t i = 0; i < count; ++i) {
    sheets_.push_back(std::make_unique<Sheet>(scene.space(), gravity));
    const Sheet& sheet = *sheets_.back();
    set_index(sheet.geom(), scene.objects().size() + 1 + i);
    dGeomSetCategoryBits(sheet.geom(), kSheetBit);
    dGeomSetCollideBits(sheet.geom(), kSheetBit | kSkinBit);
  }
  place(seed);
}

void Sheets::introduce(dBatchColliderID collider) const {
  for (const auto& sheet : sheets_) {
    dBatchColliderTriMeshDataSetDeformable(collider, sheet->data(), 1);
  }
}

// Layers above the highest object, each filled from the middle, every other one moved aside by half
// a sheet.
void Sheets::place(std::uint64_t seed) {
  Random random(seed + 1);
  double highest = -INFINITY;
  for (const Object& object : scene_.objects()) {
    highest = std::max(highest, static_cast<double>(dBodyGetPosition(object.body)[2]));
  }
  constexpr std::array<std::array<int, 2>, 9> kSites{
      {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (std::size_t i = 0; i < sheets_.size(); ++i) {
    const std::size_t layer = i / kSites.size();
    const auto [column, row] = kSites[i % kSites.size()];
    const double aside = layer % 2 == 0 ? 0 : kSheetSize / 2;
    const Vector middle{kApart * column + aside, kApart * row + aside,
                        highest + 2 * kShapeRadius + kLayer * static_cast<double>(layer)};
    const double turn = random.between(-kLargestTurn, kLargestTurn);
    const double cosine = std::cos(turn), sine = std::sin(turn);
    for (Vector& p : sheets_[i]->cloth().positions()) {
      p = middle + Vector{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, 0};
    }
  }
}

void Sheets::show(double dt) {
  std::vector<Vector> shown;
  for (std::size_t i = 0; i < sheets_.size(); ++i) {
    const Cloth& cloth = sheets_[i]->cloth();
    shown.clear();
    for (std::size_t v = 0; v < cloth.positions().size(); ++v) {
      shown.push_back(cloth.free_flight(v, dt));
    }
    for (const ClothContact& plane : contacts_.planes_of(i)) {
      if (plane.owner > scene_.objects().size()) continue;
      shown[plane.vertex] = shown[plane.vertex] - kPress * plane.normal;
    }
    sheets_[i]->show(shown);
  }
}

// Sheets read where others are, so all are read before any moves. Each depends on its own planes
// only: how they are shared out among threads changes nothing.
void Sheets::step(double dt, std::span<const dContactGeom> contacts) {
  contacts_.sort(contacts);
  for_all([&](std::size_t i) { contacts_.read(i); });
  for_all([&](std::size_t i) { sheets_[i]->cloth().step(dt, contacts_.planes_of(i)); });
  push_bodies(dt);
  fastest_ = 0;
  for (const auto& sheet : sheets_) fastest_ = std::max(fastest_, sheet->cloth().fastest(dt));
}

void Sheets::for_all(const std::function<void(std::size_t)>& use) {
  const auto work = [&](std::size_t first) {
    for (std::size_t i = first; i < sheets_.size(); i += kThreads) use(i);
  };
  std::vector<std::thread> others;
  for (unsigned k = 1; k < std::min<std::size_t>(kThreads, sheets_.size()); ++k) {
    others.emplace_back(work, k);
  }
  work(0);
  for (std::thread& other : others) other.join();
}

// As forces, which the world's next step turns into the same impulses. A body that sleeps stays
// asleep under the weight of a sheet, and wakes when it is pushed.
void Sheets::push_bodies(double dt) {
  std::vector<Vector> impulses(scene_.objects().size());
  const auto for_each = [&](auto use) {
    for (std::size_t i = 0; i < sheets_.size(); ++i) {
      for (const ClothContact& plane : contacts_.planes_of(i)) {
        if (plane.owner < impulses.size()) use(plane);
      }
    }
  };
  for_each([&](const ClothContact& plane) {
    impulses[plane.owner] = impulses[plane.owner] + plane.impulse;
  });
  for (std::size_t i = 0; i < impulses.size(); ++i) {
    const dBodyID body = scene_.objects()[i].body;
    dMass mass;
    dBodyGetMass(body, &mass);
    const double change = length(impulses[i]) / mass.mass;
    if (change > dBodyGetAutoDisableLinearThreshold(body)) dBodyEnable(body);
  }
  for_each([&](const ClothContact& plane) {
    const dBodyID body = scene_.objects()[plane.owner].body;
    if (!dBodyIsEnabled(body)) return;
    const Vector force = (1 / dt) * plane.impulse;
    const Vector& at = plane.place;
    dBodyAddForceAtPos(body, force.x, force.y, force.z, at.x, at.y, at.z);
  });
}

}  // namespace falling_objects
