// SPDX-License-Identifier: BSD-3-Clause
#include "contacts/plane_assembly.h"

namespace ode_ext {

PlaneAssembly::PlaneAssembly(Program& program, Program& of_groups)
    : gather_(program, "feature_gather"),
      place_(program, "feature_place"),
      link_(program, "feature_link"),
      join_(program, "feature_join"),
      begin_(program, "region_begin"),
      count_(program, "region_count"),
      place_regions_(program, "region_place"),
      fill_(program, "region_fill"),
      propose_(program, "region_propose"),
      choose_(of_groups, "choose_planes"),
      reduce_(of_groups, "reduce_candidates") {}

void PlaneAssembly::run(Launch per_pair, Launch per_feature, Launch per_region,
                        const BatchData& data) {
  data.launch(gather_, per_feature);
  data.launch(place_, per_pair);
  for (Kernel* kernel : {&link_, &join_, &begin_, &count_, &place_regions_, &fill_, &propose_})
    data.launch(*kernel, per_feature);
  data.launch(choose_, per_region);
  data.launch(reduce_, per_region);
}

void PlaneAssembly::take_milliseconds(StageTimes& ms) {
  for (Kernel* kernel : {&gather_, &place_, &link_, &join_, &begin_, &count_, &place_regions_,
                         &fill_, &propose_, &choose_})
    add_time(ms, Stage::kAssembly, *kernel);
  add_time(ms, Stage::kContactStep, reduce_);
}

}  // namespace ode_ext
