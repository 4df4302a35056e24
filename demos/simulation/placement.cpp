// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "meshes/shapes.h"
#include "scene_file/rotation.h"

namespace falling_objects {
namespace {

// Few layers keep the fall short: the pile has to come to rest within the 10 s of the scene.
constexpr std::size_t kLayers = 5;
constexpr double kSpacing = 1.15;                              // [m] between neighbours
constexpr double kJitter = (kSpacing - 2 * kShapeRadius) / 2;  // [m]: spheres stay apart

std::size_t sites_for(std::size_t count) { return (count + kLayers - 1) / kLayers; }

// The sites of a square grid nearest to the middle.
std::vector<std::pair<double, double>> make_sites(std::size_t count) {
  const int reach = static_cast<int>(std::sqrt(static_cast<double>(count))) + 1;
  std::vector<std::pair<double, double>> sites;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) sites.emplace_back(kSpacing * i, kSpacing * j);
  }
  std::stable_sort(sites.begin(), sites.end(), [](const auto& a, const auto& b) {
    return std::hypot(a.first, a.second) < std::hypot(b.first, b.second);
  });
  sites.resize(count);
  return sites;
}

}  // namespace

double ground_half_size(std::size_t count) {
  const double sites = static_cast<double>(sites_for(count));
  const double outermost = kSpacing * std::sqrt(sites / std::numbers::pi);
  return std::max(12.0, 1.3 * outermost);
}

std::vector<Placement> place_objects(std::size_t count, std::size_t shape_count,
                                     const Ground& ground, Random& random) {
  // Equal numbers of each shape, in any order (Fisher and Yates).
  std::vector<std::size_t> shapes(count);
  for (std::size_t i = 0; i < count; ++i) shapes[i] = i % shape_count;
  for (std::size_t i = count; i > 1; --i) std::swap(shapes[i - 1], shapes[random.below(i)]);

  const auto sites = make_sites(sites_for(count));
  const auto jitter = [&] { return random.between(-kJitter, kJitter); };
  std::vector<Placement> placements;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [x, y] = sites[i % sites.size()];
    const auto layer = static_cast<double>(i / sites.size());
    const double lowest = ground.highest_near(x, y, kShapeRadius + kJitter) + kShapeRadius;
    Placement placement;
    placement.position = {x + jitter(), y + jitter(),
                          lowest + kJitter + layer * kSpacing + jitter()};
    placement.rotation = random_rotation(random);
    placement.shape = shapes[i];
    placements.push_back(placement);
  }
  return placements;
}

}  // namespace falling_objects
