// SPDX-License-Identifier: BSD-3-Clause
// The reduction of contact_step.cl, plainly: on a sorted list, one candidate after the other. And
// how near each decision was to going the other way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/vec.h"
#include "shared/types.h"

namespace ode_ext::test {

struct Reduction {
  std::vector<std::size_t> taken;  // into the candidates, in order
  // The least by which a choice was made: of depths and distances in multiples of `size`, of the
  // cosines between normals as they are.
  double margin = std::numeric_limits<double>::infinity();
};

class ReferenceReduce {
 public:
  // Candidates sorted by (side, position, vertex); `merge` [m]: what is nearer to another adds
  // nothing.
  ReferenceReduce(const std::vector<ox_candidate>& candidates, float merge, double size)
      : candidates_(candidates),
        merge2_(merge * merge),
        size_(size),
        patch_(candidates.size(), kNoPatch),
        taken_(candidates.size(), false),
        nearest2_(candidates.size(), std::numeric_limits<float>::infinity()) {}

  Reduction run(std::size_t limit) {
    std::uint32_t best_kind = OX_HIT_TOUCHING;
    for (std::size_t i = 0; i < candidates_.size(); ++i) best_kind = std::min(best_kind, kind(i));
    deepest_of_each_patch(best_kind, limit);
    farthest_apart(best_kind, limit);
    if (best_kind == OX_HIT_INSIDE) deep_ones_on_their_own(limit);
    return result_;
  }

 private:
  static constexpr int kNoPatch = -1;

  std::uint32_t kind(std::size_t i) const { return candidates_[i].side_kind & OX_HIT_KIND; }
  float depth(std::size_t i) const { return candidates_[i].depth; }
  static Vec3f vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
  float apart2(std::size_t i, std::size_t j) const {
    const Vec3f d = vec(candidates_[i].position) - vec(candidates_[j].position);
    return dot(d, d);
  }

  // The candidate of those that `may` for which `value` is greatest, the first of equals.
  template <class May, class Value>
  std::size_t greatest(May may, Value value) {
    std::size_t best = candidates_.size();
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      if (may(i) && (best == candidates_.size() || value(i) > value(best))) best = i;
    return best;
  }
  void decided(double by) { result_.margin = std::min(result_.margin, std::fabs(by)); }
  template <class May, class Value>
  void note_runner_up(std::size_t best, May may, Value value) {
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      if (i != best && may(i)) decided((value(best) - value(i)) / size_);
  }

  void take(std::size_t i) {
    taken_[i] = true;
    result_.taken.push_back(i);
    for (std::size_t k = 0; k < candidates_.size(); ++k)
      if (patch_[k] == patch_[i]) nearest2_[k] = std::min(nearest2_[k], apart2(k, i));
  }

  void deepest_of_each_patch(std::uint32_t best_kind, std::size_t limit) {
    const auto may = [&](std::size_t i) { return patch_[i] == kNoPatch && kind(i) == best_kind; };
    const auto value = [&](std::size_t i) { return static_cast<double>(depth(i)); };
    while (result_.taken.size() < limit) {
      const std::size_t best = greatest(may, value);
      if (best == candidates_.size()) return;
      note_runner_up(best, may, value);
      const Vec3f normal = vec(candidates_[best].normal);
      const int patch = static_cast<int>(result_.taken.size());
      for (std::size_t i = 0; i < candidates_.size(); ++i) {
        if (patch_[i] != kNoPatch || i == best) continue;
        const float cosine = dot(vec(candidates_[i].normal), normal);
        decided(static_cast<double>(cosine) - 0.9);
        if (cosine > 0.9f) patch_[i] = patch;
      }
      patch_[best] = patch;
      take(best);
    }
  }

  void farthest_apart(std::uint32_t best_kind, std::size_t limit) {
    const auto may = [&](std::size_t i) { return !taken_[i] && kind(i) == best_kind; };
    while (result_.taken.size() < limit) {
      // Of the farthest the deepest, of these the first.
      const std::size_t farthest = greatest(may, [&](std::size_t i) { return nearest2_[i]; });
      if (farthest == candidates_.size()) return;
      const std::size_t best =
          greatest([&](std::size_t i) { return may(i) && nearest2_[i] == nearest2_[farthest]; },
                   [&](std::size_t i) { return depth(i); });
      const auto distance = [&](std::size_t i) {
        return std::sqrt(static_cast<double>(nearest2_[i]));
      };
      if (std::isfinite(distance(best))) {  // else in no patch, with all patches full
        note_runner_up(best, may, distance);
        decided((distance(best) - std::sqrt(static_cast<double>(merge2_))) / size_);
      }
      if (nearest2_[best] <= merge2_) return;
      take(best);
    }
  }

  void deep_ones_on_their_own(std::size_t limit) {
    const auto may = [&](std::size_t i) {
      if (taken_[i] || kind(i) != OX_HIT_FALLBACK) return false;
      const float t = candidates_[i].t;
      const float reach2 = std::max(merge2_, t * t);
      return std::all_of(result_.taken.begin(), result_.taken.end(), [&](std::size_t other) {
        decided((std::sqrt(static_cast<double>(apart2(i, other))) -
                 std::sqrt(static_cast<double>(reach2))) /
                size_);
        return apart2(i, other) > reach2;
      });
    };
    const auto value = [&](std::size_t i) { return static_cast<double>(depth(i)); };
    while (result_.taken.size() < limit) {
      const std::size_t best = greatest(may, value);
      if (best == candidates_.size()) return;
      note_runner_up(best, may, value);
      taken_[best] = true;  // in its patch it stands for nobody else
      result_.taken.push_back(best);
    }
  }

  const std::vector<ox_candidate>& candidates_;
  float merge2_;
  double size_;
  std::vector<int> patch_;
  std::vector<bool> taken_;
  std::vector<float> nearest2_;
  Reduction result_;
};

}  // namespace ode_ext::test
