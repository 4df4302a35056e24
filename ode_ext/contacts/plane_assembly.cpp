// SPDX-License-Identifier: BSD-3-Clause
#include "contacts/plane_assembly.h"

namespace ode_ext {

PlaneAssembly::PlaneAssembly(Program& program)
    : gather_(program, "feature_gather"),
      place_(program, "feature_place"),
      link_(program, "feature_link"),
      join_(program, "feature_join"),
      begin_(program, "region_begin"),
      count_(program, "region_count"),
      place_regions_(program, "region_place"),
      fill_(program, "region_fill"),
      propose_(program, "region_propose"),
      choose_(program, "choose_planes"),
      reduce_(program, "reduce_candidates") {}

void PlaneAssembly::assemble(Launch per_pair, Launch per_feature, Launch per_region,
                             const BatchData& data) {
  const AppendLists& lists = data.lists;
  data.launch(gather_, per_feature, lists.crossings(), lists.hits(), lists.features(),
              lists.feature_parents(), lists.feature_slots(), lists.faces());
  data.launch(place_, per_pair);
  data.launch(link_, per_feature, lists.features(), lists.feature_slots());
  data.launch(join_, per_feature, lists.crossings(), lists.features(), lists.feature_parents(),
              lists.feature_slots());
  data.launch(begin_, per_feature, lists.features(), lists.feature_parents(), lists.regions());
  data.launch(count_, per_feature, lists.features(), lists.feature_parents(), lists.regions());
  data.launch(place_regions_, per_feature, lists.regions());
  data.launch(fill_, per_feature, lists.features(), lists.regions(), lists.members(),
              lists.faces());
  data.launch(propose_, per_feature, lists.features(), lists.regions(), lists.faces(),
              lists.planes(), lists.edge_planes());
  data.launch(choose_, per_region, lists.features(), lists.regions(), lists.members(),
              lists.faces(), lists.planes(), lists.edge_planes(), lists.candidates());
}

void PlaneAssembly::reduce(Launch per_pair, const BatchData& data) {
  data.launch(reduce_, per_pair, data.lists.candidates(), data.settings.max_contacts,
              data.settings.max_contacts_deformable, data.pairs.ranges, data.lists.contacts());
}

void PlaneAssembly::take_milliseconds(StageTimes& ms) {
  for (Kernel* kernel : {&gather_, &place_, &link_, &join_, &begin_, &count_, &place_regions_,
                         &fill_, &propose_, &choose_})
    add_time(ms, Stage::kAssembly, *kernel);
  add_time(ms, Stage::kContactStep, reduce_);
}

}  // namespace ode_ext
