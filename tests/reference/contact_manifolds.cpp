// SPDX-License-Identifier: BSD-3-Clause
#include "reference/contact_manifolds.h"

#include <algorithm>

namespace ode_ext::test {

bool opposes(const Point& normal, const std::vector<Point>& taken) {
  return std::any_of(taken.begin(), taken.end(),
                     [&](const Point& other) { return dot(normal, other) < kOpposes; });
}

bool stays_inside(const ContactPair& pair, std::size_t side, const Point& position,
                  const ContactPlane& plane, double depth) {
  if (!pair.mesh(1 - side).closed) return false;
  const double way = depth + pair.epsilon();
  return pair.is_within(1 - side, position + (side == 0 ? way : -way) * plane.normal);
}

std::vector<ContactManifold> find_manifolds(const ContactPair& pair,
                                            const ContactFeatures& features,
                                            const ContactOptions& options) {
  const auto clear = [&](std::size_t region, const std::vector<Point>& taken) {
    if (features.regions[region].whole) {
      const auto whole = clear_whole(pair, features, region, options, taken);
      // None if all of the region is below no plane: a body contained in another with arms.
      if (!whole.empty()) return whole;
    }
    return clear_units(pair, features, region, options, taken);
  };
  std::vector<std::vector<ContactManifold>> of_region;
  const ContactManifold* leader = nullptr;
  for (std::size_t r = 0; r < features.regions.size(); ++r) of_region.push_back(clear(r, {}));
  for (const auto& manifolds : of_region)
    for (const ContactManifold& m : manifolds)
      if (leader == nullptr || m.depth > leader->depth) leader = &m;
  if (leader == nullptr) return {};
  const std::vector<Point> taken{leader->plane.normal};
  const std::size_t leading = leader->region;
  std::vector<ContactManifold> all;
  for (std::size_t r = 0; r < of_region.size(); ++r) {
    auto& found = of_region[r];
    const bool against = std::any_of(found.begin(), found.end(), [&](const ContactManifold& m) {
      return opposes(m.plane.normal, taken);
    });
    if (r != leading && against) found = clear(r, taken);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

}  // namespace ode_ext::test
