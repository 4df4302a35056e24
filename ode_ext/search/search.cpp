// SPDX-License-Identifier: BSD-3-Clause
#include "search/search.h"

namespace ode_ext {

Search::Search(Program& program, std::uint32_t items_per_meshlet_pair)
    : pair_step_(program, "pair_step"),
      cull_(program, "cull"),
      match_(program, "match"),
      cross_(program, "cross_meshlets"),
      flood_(program, "flood"),
      vertex_step_(program, "vertex_step"),
      ray_step_(program, "ray_step"),
      items_per_meshlet_pair_(items_per_meshlet_pair) {}

void Search::relate(Launch per_pair, const BatchData& data) {
  data.launch(pair_step_, per_pair, data.pairs.objects, data.pairs.members, data.pairs.ranges);
}

void Search::cull(Launch per_pair, const BatchData& data) {
  data.launch(cull_, per_pair, data.lists.meshlets());
}

void Search::match(Launch per_meshlet, const BatchData& data) {
  data.launch(match_, per_meshlet, data.lists.meshlets(), data.lists.meshlet_pairs(),
              data.lists.crossings());
}

void Search::cross(Launch per_item, const BatchData& data) {
  data.launch(cross_, per_item, data.lists.meshlet_pairs(), data.lists.crossings());
}

void Search::flood(Launch per_side, const BatchData& data) {
  data.launch(flood_, per_side, data.lists.crossings(), data.lists.tasks(), data.lists.rays(),
              data.lists.flood_words());
}

void Search::choose_vertices(Launch per_vertex, const BatchData& data) {
  data.launch(vertex_step_, per_vertex, data.lists.tasks(), data.lists.rays());
}

void Search::cast(Launch per_ray, const BatchData& data) {
  data.launch(ray_step_, per_ray, data.lists.rays(), data.lists.crossings(), data.lists.hits());
}

void Search::take_milliseconds(StageTimes& ms) {
  add_time(ms, Stage::kPairStep, pair_step_);
  add_time(ms, Stage::kCull, cull_);
  add_time(ms, Stage::kMatch, match_);
  add_time(ms, Stage::kCross, cross_);
  add_time(ms, Stage::kFlood, flood_);
  add_time(ms, Stage::kVertexStep, vertex_step_);
  add_time(ms, Stage::kBvhRays, ray_step_);
}

}  // namespace ode_ext
