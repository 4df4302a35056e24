// SPDX-License-Identifier: BSD-3-Clause
// The reduction of contacts/reduce.cl, plainly: one rule after the other on a sorted list. And how
// near each decision was to going the other way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "contacts/field_records.h"
#include "mesh/vec.h"
#include "support/test_scene.h"
#include "support/thickness.h"

namespace ode_ext::test {

// Deeper first; of equally deep ones by where they are and what they are of.
inline auto reduction_key(const Candidate& c) {
  return std::tuple(-c.depth, c.position[0], c.position[1], c.position[2], c.side_kind, c.vertex,
                    c.triangle, c.normal[0], c.normal[1], c.normal[2], c.feature[0], c.feature[1]);
}

struct Reduction {
  std::vector<Candidate> taken;  // in order
  // The least by which a choice was made: of depths and distances in multiples of `size`, of the
  // cosines between normals as they are.
  double margin = std::numeric_limits<double>::infinity();
};

class ReferenceReduce {
 public:
  // Of a pair of a scene, in multiples of the radius of its smaller mesh.
  ReferenceReduce(std::vector<Candidate> candidates, const TestScene& scene, std::size_t pair)
      : left_(std::move(candidates)), scene_(scene), pair_(pair) {
    radius_ = std::min(scene.built_mesh_of(pair, 0).radius, scene.built_mesh_of(pair, 1).radius);
    size_ = static_cast<double>(radius_);
    std::sort(left_.begin(), left_.end(), [](const Candidate& a, const Candidate& b) {
      return reduction_key(a) < reduction_key(b);
    });
  }

  Reduction run(std::size_t limit) {
    while (result_.taken.size() < limit &&
           (take_of_new_region() || take_of_new_manifold() || take_farthest())) {
    }
    return result_;
  }

 private:
  static Vec3f vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

  bool face_same_way(const Candidate& c, const Candidate& taken) {
    const float cosine = dot(vec(taken.normal), vec(c.normal));
    decided(static_cast<double>(cosine) - 0.9);
    return cosine > 0.9f;
  }
  bool face_one_another(const Candidate& c, const Candidate& taken) {
    const float cosine = dot(vec(taken.normal), vec(c.normal));
    decided(static_cast<double>(cosine) + 0.9);
    return cosine < -0.9f;
  }
  // From a contact that is taken, across its normal if both face one way.
  float apart2(const Candidate& c, const Candidate& taken) {
    const Vec3f n = vec(taken.normal);
    Vec3f d = vec(c.position) - vec(taken.position);
    if (face_same_way(c, taken)) d = d - dot(d, n) * n;
    return dot(d, d);
  }
  float nearest2(const Candidate& c) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const Candidate& t : result_.taken)
      nearest = std::min(nearest, is_near(c, t) ? 0.0f : apart2(c, t));
    return nearest;
  }
  bool is_near(const Candidate& c, const Candidate& taken) {
    const float gap2 = apart2(c, taken);
    const float merge = merge_distance(vec(taken.normal));
    decided((std::sqrt(static_cast<double>(gap2)) - static_cast<double>(merge)) / size_);
    return gap2 <= merge * merge;
  }
  // [m] what is nearer to one with this normal and faces the same way, or it, adds nothing.
  float merge_distance(Vec3f normal) const {
    const Point in_b{double{normal.x}, double{normal.y}, double{normal.z}};
    const Point in_world = rotate(scene_.pose_of(pair_, 1), in_b);
    double least = static_cast<double>(0.02f * radius_);
    for (std::size_t side = 0; side < 2; ++side) {
      if (!scene_.built_mesh_of(pair_, side).closed()) continue;
      const Vec3f size =
          scene_.built_mesh_of(pair_, side).box.hi - scene_.built_mesh_of(pair_, side).box.lo;
      const Point half{0.5 * double{size.x}, 0.5 * double{size.y}, 0.5 * double{size.z}};
      least = std::min(
          least, half_thickness_across(half, rotate_back(scene_.pose_of(pair_, side), in_world)));
    }
    return static_cast<float>(least);
  }
  bool is_near_any(const Candidate& c) {
    return std::any_of(result_.taken.begin(), result_.taken.end(),
                       [&](const Candidate& t) { return is_near(c, t); });
  }
  bool adds_nothing(const Candidate& c) {
    return std::any_of(result_.taken.begin(), result_.taken.end(), [&](const Candidate& t) {
      return (face_same_way(c, t) || face_one_another(c, t)) && is_near(c, t);
    });
  }
  void decided(double by) { result_.margin = std::min(result_.margin, std::fabs(by)); }

  void take(std::size_t i) {
    regions_.insert(left_[i].region);
    manifolds_.emplace(left_[i].region, left_[i].manifold);
    result_.taken.push_back(left_[i]);
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  // The first of those that `may`.
  template <class May>
  bool take_first(May may) {
    const auto first = std::find_if(left_.begin(), left_.end(), may);
    if (first == left_.end()) return false;
    const auto second = std::find_if(first + 1, left_.end(), may);
    if (second != left_.end()) decided(static_cast<double>(first->depth - second->depth) / size_);
    take(static_cast<std::size_t>(first - left_.begin()));
    return true;
  }
  bool take_of_new_region() {
    const auto may = [&](const Candidate& c) { return !regions_.contains(c.region); };
    if (result_.taken.empty()) return take_first(may);
    const std::size_t far = farthest_of(may, half_as_deep(may));
    if (far == left_.size()) return false;
    const ox_u32 region = left_[far].region;
    return take_first([&](const Candidate& c) { return may(c) && c.region == region; });
  }
  bool take_of_new_manifold() {
    const auto may = [&](const Candidate& c) {
      return !manifolds_.contains({c.region, c.manifold}) && !is_near_any(c);
    };
    const std::size_t far = farthest_of(may, half_as_deep(may));
    if (far == left_.size()) return false;
    const std::pair manifold(left_[far].region, left_[far].manifold);
    return take_first(
        [&](const Candidate& c) { return may(c) && std::pair(c.region, c.manifold) == manifold; });
  }
  bool take_farthest() {
    const std::size_t far = farthest_of([&](const Candidate& c) { return !adds_nothing(c); }, 0);
    if (far == left_.size()) return false;
    take(far);
    return true;
  }

  // [m] As the deepest of those that `may`.
  template <class May>
  float half_as_deep(May may) const {
    const auto deepest = std::find_if(left_.begin(), left_.end(), may);
    return deepest == left_.end() ? 0 : deepest->depth / 2;
  }

  // Of those that `may` and are so deep what is farthest from all that are taken.
  template <class May>
  std::size_t farthest_of(May may, float least_depth) {
    std::size_t best = left_.size();
    float farthest = -1, next = 0;
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (!may(left_[i])) continue;
      const float nearest = nearest2(left_[i]);
      if (least_depth > 0) decided(static_cast<double>(left_[i].depth - least_depth) / size_);
      if (left_[i].depth < least_depth) continue;
      if (nearest > farthest) {
        next = farthest;
        farthest = nearest;
        best = i;
      } else {
        next = std::max(next, nearest);
      }
    }
    if (best == left_.size()) return best;
    // Of those that are near what is taken the first is the deepest.
    if (farthest == 0) {
      const auto second =
          std::find_if(left_.begin() + static_cast<std::ptrdiff_t>(best) + 1, left_.end(), may);
      if (second != left_.end())
        decided(static_cast<double>(left_[best].depth - second->depth) / size_);
      return best;
    }
    decided((std::sqrt(static_cast<double>(farthest)) - std::sqrt(static_cast<double>(next))) /
            size_);
    return best;
  }

  std::vector<Candidate> left_;
  std::set<ox_u32> regions_;
  std::set<std::pair<ox_u32, ox_u32>> manifolds_;  // of a region each
  const TestScene& scene_;
  std::size_t pair_;
  float radius_ = 0;  // [m]
  double size_ = 0;   // the same
  Reduction result_;
};

}  // namespace ode_ext::test
