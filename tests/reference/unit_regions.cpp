// SPDX-License-Identifier: BSD-3-Clause
// The planes of a region that is not convex: its units are cleared one after the other, the deepest
// first, and what the way of one clears of the others needs no plane of its own.
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "reference/contact_manifolds.h"

namespace ode_ext::test {
namespace {

constexpr double kInfinity = ContactBox::infinity;

class UnitRegion {
 public:
  UnitRegion(const ContactPair& pair, const ContactFeatures& features, std::size_t region,
             const ContactOptions& options, const std::vector<Point>& taken)
      : pair_(pair),
        features_(features),
        region_(region),
        units_(features.regions[region].units),
        options_(options),
        taken_(taken),
        judge_(pair, features, region, options) {}

  std::vector<ContactManifold> clear() {
    pair_edges();
    for (const std::size_t i : units_) propose(features_.units[i]);
    for (std::size_t k = 0; k < units_.size(); ++k) least_.push_back(least_cost(k));
    while (const std::optional<std::size_t> k = deepest()) {
      const std::optional<std::size_t> plane = choose(features_.units[units_[*k]]);
      if (plane) take(*plane, *k);
      cleared_[*k] = true;
    }
    return manifolds_;
  }

 private:
  using Facets = std::array<std::size_t, 2>;  // of A and of B

  // The pairs of facets that meet along a curve which a crossing is an end of.
  std::vector<Facets> facet_pairs(const ContactFeature& crossing) const {
    std::vector<Facets> pairs;
    const FacetsAt at = facets_at(pair_, crossing);
    for (const std::size_t own : at.of_edge) {
      if (own == kNowhere) continue;
      pairs.push_back(crossing.side == 0 ? Facets{own, at.crossed} : Facets{at.crossed, own});
    }
    return pairs;
  }

  // Edges of both meshes that cross within one pair of facets.
  void pair_edges() {
    for (const std::size_t i : features_.regions[region_].features) {
      const ContactFeature& f = features_.features[i];
      if (!f.is_crossing() || f.flat) continue;
      for (const Facets& facets : facet_pairs(f)) edges_[facets][f.side].insert(f.edge);
    }
  }

  // The number of a plane among those of the region.
  std::optional<std::size_t> number_of(const std::optional<ContactPlane>& plane) {
    if (!plane) return std::nullopt;
    const auto [known, is_new] = numbers_.try_emplace(plane->key(), planes_.size());
    if (is_new) planes_.push_back(*plane);
    return known->second;
  }

  void propose(const ContactUnit& unit) {
    std::set<std::size_t> own;
    const auto add = [&](const std::optional<ContactPlane>& plane) {
      if (const auto number = number_of(plane)) own.insert(*number);
    };
    const std::size_t other = 1 - unit.side;
    const auto add_facets = [&](const std::vector<std::size_t>& facets) {
      for (const std::size_t facet : facets) add(face_plane(pair_, other, facet));
    };
    add_facets(unit.nearest);
    for (const std::size_t end : unit.ends) {
      const ContactFeature& f = features_.features[end];
      add_facets(f.nearest);
      if (!f.is_crossing()) continue;
      add_facets({facets_at(pair_, f).crossed});
      for (const Facets& facets : facet_pairs(f)) {
        for (const std::size_t edge : edges_.at(facets)[other])
          add(unit.side == 0 ? edge_plane(pair_, unit.edge, edge)
                             : edge_plane(pair_, edge, unit.edge));
      }
    }
    own_.emplace_back(own.begin(), own.end());
    cleared_.push_back(false);
  }

  // Of the planes that a unit proposes.
  double least_cost(std::size_t k) const {
    double least = kInfinity;
    for (const std::size_t q : own_[k])
      least = std::min(least, judge_.of_unit(planes_[q], features_.units[units_[k]]).judged);
    return least;
  }

  // The waiting unit with the largest least cost; of those with as large a one the first.
  std::optional<std::size_t> deepest() const {
    double most = -kInfinity;
    for (std::size_t k = 0; k < units_.size(); ++k)
      if (!cleared_[k]) most = std::max(most, least_[k]);
    for (std::size_t k = 0; k < units_.size(); ++k)
      if (!cleared_[k] && least_[k] >= most - kDepthTie * pair_.epsilon()) return k;
    return std::nullopt;
  }

  // Of all planes of the region the least judged.
  std::optional<std::size_t> choose(const ContactUnit& unit) const {
    std::vector<std::pair<double, std::size_t>> costs;
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      const double depth = judge_.depth_of_unit(planes_[p], unit);
      if (depth == kInfinity) continue;
      costs.emplace_back(depth, p);
    }
    // By depth, which no judgement makes less: the search ends where depth alone is too much.
    std::sort(costs.begin(), costs.end());
    std::vector<std::pair<double, std::size_t>> judged;
    double least = kInfinity;
    for (const auto& [depth, p] : costs) {
      if (depth > least) break;
      double value = judge_.of_unit(planes_[p], unit).judged;
      if (opposes(planes_[p].normal, taken_)) value *= kDetour;
      judged.emplace_back(value, p);
      least = std::min(least, value);
    }
    if (judged.empty()) return std::nullopt;
    std::sort(judged.begin(), judged.end(), [&](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first
                                : planes_[a.second].key() < planes_[b.second].key();
    });
    if (options_.check_ways) {
      for (const auto& [value, p] : judged)
        if (!is_stuck(unit, planes_[p])) return p;
    }
    return judged.front().second;
  }

  bool is_stuck(const ContactUnit& unit, const ContactPlane& plane) const {
    const double depth = judge_.depth_of_unit(plane, unit);
    for (const std::size_t end : unit.ends)
      if (stays_inside(pair_, unit.side, features_.features[end].position, plane, depth))
        return true;
    return false;
  }

  ContactManifold& manifold_of(std::size_t plane) {
    for (ContactManifold& known : manifolds_)
      if (known.plane.key() == planes_[plane].key()) return known;
    manifolds_.push_back({region_, planes_[plane], 0, {}, {}});
    chosen_.push_back(plane);
    taken_.push_back(planes_[plane].normal);
    return manifolds_.back();
  }

  // Moves by what the unit needs along the plane's normal, and sees what that clears.
  void take(std::size_t plane, std::size_t seed) {
    ContactManifold& made = manifold_of(plane);
    const double depth = judge_.depth_of_unit(planes_[plane], features_.units[units_[seed]]);
    made.depth = std::max(made.depth, depth);
    std::set<std::size_t> touching(made.features.begin(), made.features.end());
    std::vector<std::pair<std::size_t, std::size_t>> by_others;  // plane, unit
    for (std::size_t k = 0; k < units_.size(); ++k) {
      if (cleared_[k]) continue;
      const ContactUnit& unit = features_.units[units_[k]];
      const bool by_this = k == seed || clears(plane, plane, depth, unit);
      const std::optional<std::size_t> other = by_this ? plane : cleared_by(k, plane, depth);
      if (!other) continue;
      cleared_[k] = true;
      made.units.push_back(units_[k]);
      if (by_this)
        touching.insert(unit.ends.begin(), unit.ends.end());
      else if (options_.support_all)
        by_others.emplace_back(*other, k);
    }
    made.features.assign(touching.begin(), touching.end());
    for (const auto& [q, k] : by_others) support(q, features_.units[units_[k]]);
  }

  // Of the planes that a unit is past after the move the one it has least to go to.
  std::optional<std::size_t> cleared_by(std::size_t k, std::size_t plane, double depth) const {
    const ContactUnit& unit = features_.units[units_[k]];
    std::optional<std::size_t> best;
    double least = kInfinity;
    const auto look = [&](std::size_t q) {
      if (!clears(q, plane, depth, unit)) return;
      const double judged = judge_.of_unit(planes_[q], unit).judged;
      if (best && (judged > least || (judged == least && planes_[q].key() >= planes_[*best].key())))
        return;
      best = q;
      least = judged;
    };
    for (const std::size_t q : own_[k]) look(q);
    for (const std::size_t q : chosen_) look(q);
    return best;
  }

  void support(std::size_t plane, const ContactUnit& unit) {
    const double depth = judge_.depth_of_unit(planes_[plane], unit);
    for (ContactManifold& known : manifolds_)
      if (known.plane.key() == planes_[plane].key()) {
        known.depth = std::max(known.depth, depth);
        std::set<std::size_t> touching(known.features.begin(), known.features.end());
        touching.insert(unit.ends.begin(), unit.ends.end());
        known.features.assign(touching.begin(), touching.end());
        return;
      }
    manifolds_.push_back({region_, planes_[plane], depth, unit.ends, {}});
  }

  // Whether a unit is past plane q after the move.
  bool clears(std::size_t q, std::size_t plane, double depth, const ContactUnit& unit) const {
    const double way = depth * dot(planes_[plane].normal, planes_[q].normal);
    return judge_.depth_of_unit(planes_[q], unit) <= way + pair_.epsilon();
  }

  const ContactPair& pair_;
  const ContactFeatures& features_;
  const std::size_t region_;
  const std::vector<std::size_t>& units_;
  const ContactOptions& options_;
  std::vector<Point> taken_;
  PlaneJudge judge_;
  std::map<Facets, std::array<std::set<std::size_t>, 2>> edges_;
  std::vector<ContactPlane> planes_;
  std::map<decltype(ContactPlane{}.key()), std::size_t> numbers_;
  std::vector<std::vector<std::size_t>> own_;  // planes each unit proposes
  std::vector<double> least_;                  // cost of those
  std::vector<bool> cleared_;
  std::vector<std::size_t> chosen_;
  std::vector<ContactManifold> manifolds_;
};

}  // namespace

std::vector<ContactManifold> clear_units(const ContactPair& pair, const ContactFeatures& features,
                                         std::size_t region, const ContactOptions& options,
                                         const std::vector<Point>& taken) {
  return UnitRegion(pair, features, region, options, taken).clear();
}

}  // namespace ode_ext::test
