// SPDX-License-Identifier: BSD-3-Clause
#include "search/crossing_comparison.h"

#include <cmath>
#include <set>
#include <stdexcept>

namespace ode_ext::test {
namespace {

bool is_flat(const Mesh& mesh, std::uint32_t place, const ox_edge& edge) {
  if (mesh.topology->facets.empty() || edge.triangle[1] == OX_NONE) return false;
  const auto facet = [&](std::size_t k) {
    return mesh.topology->facets.at(Rig::shared().local_triangle(place, edge.triangle[k]));
  };
  return facet(0) == facet(1);
}

}  // namespace

std::map<CrossingKey, FoundCrossing> found_crossings(const TestScene& scene,
                                                     const StepRecords& records) {
  std::map<CrossingKey, FoundCrossing> found;
  for (const ox_edge_crossing& c : records.crossings) {
    const std::size_t pair = c.pair_side >> 1, side = c.pair_side & 1;
    const std::uint32_t source = scene.objects[scene.pairs[pair][side]].mesh;
    const std::uint32_t target = scene.objects[scene.pairs[pair][1 - side]].mesh;
    if (is_flat(*scene.scene.meshes[source], source, records.edges.at(c.edge))) continue;
    const auto end = [&](std::size_t k) {
      const ox_u32 vertex = records.edges.at(c.edge).vertex[k];
      return point_of(
          scene.scene.meshes[source]->vertices.at(Rig::shared().local_vertex(source, vertex)));
    };
    const Point from = end(0), to = end(1);
    const bool upward = from < to;
    const double t =
        upward ? static_cast<double>(c.t) : distance(from, to) - static_cast<double>(c.t);
    const std::uint32_t triangle = scene.scene.meshes[target]->topology->source_triangle.at(
        Rig::shared().local_triangle(target, c.triangle));
    const CrossingKey key{pair, static_cast<int>(side), upward ? from : to, upward ? to : from,
                          static_cast<int>(triangle)};
    if (!found.emplace(key, FoundCrossing{t, (c.leaves != 0) == upward}).second)
      throw std::runtime_error("two crossings of one edge and one triangle, pair " +
                               std::to_string(pair));
  }
  return found;
}

Comparison compare_crossings(const TestScene& scene, const std::vector<ReferenceSurface>& surfaces,
                             const std::map<CrossingKey, FoundCrossing>& found) {
  Comparison comparison;
  comparison.found = found.size();
  const auto note = [&](std::size_t pair, int side, double t, const std::string& what) {
    comparison.differences.push_back("pair " + std::to_string(pair) + " side " +
                                     std::to_string(side) + " at t " + std::to_string(t) + ": " +
                                     what);
  };
  std::set<CrossingKey> possible;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const TestPose &pa = scene.pose_of(i, 0), &pb = scene.pose_of(i, 1);
    const double epsilon = pair_epsilon(scene, i);
    // What rounds, and the grid, which is half an epsilon at most.
    const double tolerance = 1.5 * epsilon;
    const auto surface = [&](std::size_t side) -> const ReferenceSurface& {
      return surfaces[scene.objects[scene.pairs[i][side]].mesh];
    };
    for (const ReferenceCrossing& expected :
         reference_crossings(surface(0), pa, surface(1), pb, tolerance, kInflation * epsilon)) {
      const CrossingKey key{i, expected.side, expected.from, expected.to, expected.triangle};
      possible.insert(key);
      ++(expected.ambiguous ? comparison.ambiguous : comparison.certain);
      if (expected.ambiguous) continue;
      const auto actual = found.find(key);
      if (actual == found.end())
        note(i, expected.side, expected.t,
             "lacks the crossing with triangle " + std::to_string(expected.triangle));
      else if (actual->second.leaves != expected.leaves)
        note(i, expected.side, expected.t, "enters and leaves are not told apart");
      else if (!(std::fabs(actual->second.t - expected.t) <= expected.blur + tolerance))
        note(i, expected.side, expected.t, "is at " + std::to_string(actual->second.t));
    }
  }
  for (const auto& [key, crossing] : found)
    if (!possible.contains(key))
      note(std::get<0>(key), std::get<1>(key), crossing.t, "nothing is crossed there");
  return comparison;
}

}  // namespace ode_ext::test
