// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>

#include "reference/contact_constants.h"
#include "reference/reference_contacts.h"

namespace ode_ext::test {
namespace {

bool face_one_another(const ReferenceContact& a, const ReferenceContact& b) {
  return dot(a.normal, b.normal) < -kSamePatch;
}

bool face_same_way(const ReferenceContact& a, const ReferenceContact& b) {
  return dot(a.normal, b.normal) > kSamePatch;
}

// What faces one way is compared across the normal: how far one is in front of the other spreads
// nothing.
double apart(const ReferenceContact& a, const ReferenceContact& b) {
  const Point d = a.position - b.position;
  if (!face_same_way(a, b)) return length(d);
  return length(d - dot(d, a.normal) * a.normal);
}

}  // namespace

std::vector<ReferenceContact> reduced(const std::vector<ReferenceContact>& all,
                                      std::size_t max_contacts, const MergeDistance& merge) {
  std::vector<ReferenceContact> kept;
  // Something that is kept and faces the same way, or is faced by it.
  std::vector<bool> is_near(all.size(), false);
  std::vector<bool> is_merged(all.size(), false);              // the same, whatever way it faces
  std::vector<double> gaps(all.size(), ContactBox::infinity);  // to the nearest that is kept
  std::set<std::size_t> regions, manifolds;
  const auto take = [&](std::size_t i) {
    kept.push_back(all[i]);
    regions.insert(all[i].region);
    manifolds.insert(all[i].manifold);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double gap = apart(all[k], all[i]);
      const bool adds = !face_same_way(all[k], all[i]) && !face_one_another(all[k], all[i]);
      const bool is_apart = gap > merge(all[i].normal);
      gaps[k] = std::min(gaps[k], is_apart ? gap : 0);
      if (is_apart) continue;
      is_merged[k] = true;
      if (!adds) is_near[k] = true;
    }
  };
  const auto farthest_of = [&](const auto& may) {
    std::size_t farthest = all.size();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (may(i) && (farthest == all.size() || gaps[i] > gaps[farthest])) farthest = i;
    return farthest;
  };
  // All are sorted, so the first that `may` is the deepest. Of those half as deep the farthest says
  // of what the deepest is taken.
  const auto take_deepest_of_farthest = [&](const auto& may, const auto& of) {
    while (kept.size() < max_contacts) {
      std::size_t deepest = 0;
      while (deepest < all.size() && !may(deepest)) ++deepest;
      if (deepest == all.size()) break;
      const std::size_t far = farthest_of(
          [&](std::size_t i) { return may(i) && all[i].depth >= all[deepest].depth / 2; });
      std::size_t first = deepest;
      while (!may(first) || of(all[first]) != of(all[far])) ++first;
      take(first);
    }
  };
  take_deepest_of_farthest([&](std::size_t i) { return regions.count(all[i].region) == 0; },
                           [](const ReferenceContact& c) { return c.region; });
  take_deepest_of_farthest(
      [&](std::size_t i) { return manifolds.count(all[i].manifold) == 0 && !is_merged[i]; },
      [](const ReferenceContact& c) { return c.manifold; });
  while (kept.size() < max_contacts) {
    const std::size_t far = farthest_of([&](std::size_t i) { return !is_near[i]; });
    if (far == all.size()) break;
    take(far);
  }
  return kept;
}

}  // namespace ode_ext::test
