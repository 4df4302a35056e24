// SPDX-License-Identifier: BSD-3-Clause
#include "collide/whole_step.h"

namespace ode_ext {

void WholeStep::run(Launch shares, const BatchData& data) {
  const auto& [meshes, pairs, lists, settings] = data;
  data.launch(kernel_, shares, pairs.objects, pairs.members, pairs.ranges, lists.meshlets(),
              lists.meshlet_pairs(), lists.crossings(), lists.tasks(), lists.rays(),
              lists.flood_words(), lists.hits(), lists.candidates(), settings.max_contacts,
              settings.max_contacts_deformable, lists.contacts(), lists.features(),
              lists.feature_parents(), lists.feature_slots(), lists.regions(), lists.members(),
              lists.faces(), lists.planes(), lists.edge_planes());
}

}  // namespace ode_ext
