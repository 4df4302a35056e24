// SPDX-License-Identifier: BSD-3-Clause
#include "support/feature_watch.h"

#include <algorithm>
#include <sstream>

namespace ode_ext::test {
namespace {

// [m] The device places crossings with floats, in meshes a few metres across that it takes 4 of
// their roundings (2^-20 of the size) larger.
constexpr double kNear = 1e-4;

double distance_to_segment(const Point& p, const Point& from, const Point& to) {
  const Point along = to - from;
  const double t = std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
  return distance(p, from + t * along);
}

Point normal_of_triangle(const TestMesh& mesh, std::size_t t) {
  return unit(cross(mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 0)));
}

std::string name(unsigned feature) {
  std::ostringstream text;
  text << "kind " << kind_of(feature) << " number " << (feature & 0x3fffffffu);
  return text.str();
}

}  // namespace

FeatureWatch::FeatureWatch(const TestMesh& mesh, bool each) : mesh_(mesh) {
  std::set<std::array<unsigned, 2>> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  edges_.assign(edges.begin(), edges.end());
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const auto is_same = [&](std::size_t facet) {
      return distance(normal_of(facet), normal_of_triangle(mesh, t)) < 1e-4 &&
             std::fabs(dot(normal_of(facet), mesh.corner(t, 0) - mesh.corner(facet, 0))) < 1e-5;
    };
    if (each || std::none_of(facets_.begin(), facets_.end(), is_same)) facets_.push_back(t);
  }
}

Point FeatureWatch::normal_of(std::size_t facet) const { return normal_of_triangle(mesh_, facet); }

Point FeatureWatch::along(std::size_t edge) const {
  return unit(mesh_.vertex(edges_[edge][1]) - mesh_.vertex(edges_[edge][0]));
}

FeatureWatch::Places FeatureWatch::places(unsigned feature, unsigned other, const Point& place,
                                          const Point& normal, double depth) const {
  Places found;
  switch (kind_of(feature)) {
    case dBatchFeatureVertex:
      for (std::size_t v = 0; v < mesh_.vertices.size() / 3; ++v)
        if (distance(mesh_.vertex(v), place) < kNear) found.insert(v);
      break;
    case dBatchFeatureEdge:
      for (std::size_t e = 0; e < edges_.size(); ++e) {
        const auto [a, b] = edges_[e];
        // The contact of two edges is between them, on neither.
        const bool is_at =
            kind_of(other) == dBatchFeatureEdge
                ? std::fabs(dot(along(e), normal)) < 1e-4
                : distance_to_segment(place, mesh_.vertex(a), mesh_.vertex(b)) < kNear;
        if (is_at) found.insert(e);
      }
      break;
    case dBatchFeatureFacet:
      for (const std::size_t facet : facets_) {
        const Point across = normal_of(facet);
        const double height = std::fabs(dot(across, place - mesh_.corner(facet, 0)));
        // A vertex is cleared by the plane of its facet.
        const bool is_at =
            kind_of(other) == dBatchFeatureVertex
                ? std::fabs(height - depth) < kNear && length(cross(across, normal)) < 1e-4
                : height < kNear;
        if (is_at) found.insert(facet);
      }
      break;
    default:
      break;
  }
  return found;
}

std::string FeatureWatch::see(unsigned feature, unsigned other, const Point& place,
                              const Point& normal, double depth) {
  const Places here = places(feature, other, place, normal, depth);
  if (here.empty()) return name(feature) + " is of nothing where the contact is";
  const auto [known, is_new] = known_.try_emplace(feature, here);
  if (is_new) return "";
  std::erase_if(known->second, [&](std::size_t i) { return !here.contains(i); });
  return known->second.empty() ? name(feature) + " was of something else" : "";
}

std::string FeatureWatch::doubles() const {
  std::map<std::pair<unsigned, std::size_t>, unsigned> taken;
  for (const auto& [feature, places] : known_) {
    if (places.size() != 1) continue;
    const auto [other, is_new] = taken.try_emplace({kind_of(feature), *places.begin()}, feature);
    if (!is_new) return name(feature) + " and " + name(other->second) + " are of the same";
  }
  return "";
}

std::size_t FeatureWatch::count(unsigned kind) const {
  return static_cast<std::size_t>(std::count_if(
      known_.begin(), known_.end(), [&](const auto& k) { return kind_of(k.first) == kind; }));
}

std::optional<Point> FeatureWatch::direction(unsigned feature) const {
  const auto known = known_.find(feature);
  if (known == known_.end() || known->second.size() != 1) return {};
  const std::size_t only = *known->second.begin();
  if (kind_of(feature) == dBatchFeatureVertex) return {};
  return kind_of(feature) == dBatchFeatureEdge ? along(only) : normal_of(only);
}

std::string PairWatch::see(const Contacts& contacts, const std::vector<dBatchContactId>& ids,
                           const TestPose& pose1, const TestPose& pose2) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto seen = [&](FeatureWatch& watch, unsigned feature, unsigned other,
                          const TestPose& pose) {
      return watch.see(feature, other, to_local(pose, pos(contacts[i])),
                       rotate_back(pose, normal(contacts[i])), contacts[i].depth);
    };
    const auto [feature1, feature2] = ids[i];
    std::string wrong = seen(first, feature1, feature2, pose1);
    if (wrong.empty()) wrong = seen(second, feature2, feature1, pose2);
    if (!wrong.empty()) return "contact " + std::to_string(i) + ": " + wrong;
  }
  if (std::string wrong = first.doubles(); !wrong.empty()) return wrong;
  return second.doubles();
}

}  // namespace ode_ext::test
