// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/steps.h"

namespace ode_ext {

Steps::Steps(Program& program, bool has_whole, std::uint32_t items_per_meshlet_pair)
    : pair_step_(program, "pair_step"),
      cull_(program, "cull"),
      match_(program, "match"),
      cross_(program, "cross_meshlets"),
      flood_(program, "flood"),
      vertex_step_(program, "vertex_step"),
      ray_step_(program, "ray_step"),
      assembly_(program),
      items_per_meshlet_pair_(items_per_meshlet_pair) {
  if (has_whole) whole_.emplace(program, "whole_step");
}

void Steps::relate(Launch per_pair, const StepData& data) {
  data.launch(pair_step_, per_pair, data.pairs.objects, data.pairs.members, data.pairs.ranges);
}

void Steps::cull(Launch per_pair, const StepData& data) {
  data.launch(cull_, per_pair, data.lists.meshlets());
}

void Steps::match(Launch per_meshlet, const StepData& data) {
  data.launch(match_, per_meshlet, data.lists.meshlets(), data.lists.meshlet_pairs(),
              data.lists.crossings());
}

void Steps::cross(Launch per_item, const StepData& data) {
  data.launch(cross_, per_item, data.lists.meshlet_pairs(), data.lists.crossings());
}

void Steps::flood(Launch per_side, const StepData& data) {
  data.launch(flood_, per_side, data.lists.crossings(), data.lists.tasks(), data.lists.rays(),
              data.lists.flood_words());
}

void Steps::choose_vertices(Launch per_vertex, const StepData& data) {
  data.launch(vertex_step_, per_vertex, data.lists.tasks(), data.lists.rays());
}

void Steps::cast(Launch per_ray, const StepData& data) {
  data.launch(ray_step_, per_ray, data.lists.rays(), data.lists.crossings(), data.lists.hits());
}

void Steps::run_whole(Launch shares, const StepData& data) {
  const auto& [meshes, pairs, lists, settings] = data;
  data.launch(*whole_, shares, pairs.objects, pairs.members, pairs.ranges, lists.meshlets(),
              lists.meshlet_pairs(), lists.crossings(), lists.tasks(), lists.rays(),
              lists.flood_words(), lists.hits(), lists.candidates(), settings.max_contacts,
              settings.max_contacts_deformable, lists.contacts(), lists.features(),
              lists.feature_parents(), lists.feature_slots(), lists.regions(), lists.members(),
              lists.faces(), lists.planes(), lists.edge_planes());
}

void Steps::take_milliseconds(StageTimes& ms) {
  add_time(ms, Stage::kPairStep, pair_step_);
  add_time(ms, Stage::kCull, cull_);
  add_time(ms, Stage::kMatch, match_);
  add_time(ms, Stage::kCross, cross_);
  add_time(ms, Stage::kFlood, flood_);
  add_time(ms, Stage::kVertexStep, vertex_step_);
  add_time(ms, Stage::kBvhRays, ray_step_);
  assembly_.take_milliseconds(ms);
  if (whole_.has_value()) add_time(ms, Stage::kWholeStep, *whole_);
}

}  // namespace ode_ext
