// SPDX-License-Identifier: BSD-3-Clause
#include "ode/contact_ids.h"

#include "contacts/contact_features.h"

namespace ode_ext {
namespace {

static_assert(kFeatureShift == dBatchFeatureShift);
static_assert(static_cast<int>(FeatureKind::kUnknown) == dBatchFeatureNone &&
              static_cast<int>(FeatureKind::kVertex) == dBatchFeatureVertex &&
              static_cast<int>(FeatureKind::kEdge) == dBatchFeatureEdge &&
              static_cast<int>(FeatureKind::kFacet) == dBatchFeatureFacet);

// Compared as numbers, in ODE's precision: between here and the program ODE may have turned a 0
// into -0.
bool is_where(const Contact& known, const dContactGeom& contact, bool swapped) {
  for (std::size_t k = 0; k < 3; ++k)
    if (static_cast<dReal>(known.position[k]) != contact.pos[k] ||
        static_cast<dReal>(known.normal[k]) != (swapped ? -contact.normal[k] : contact.normal[k]))
      return false;
  return static_cast<dReal>(known.depth) == contact.depth;
}

bool has_sides(const Contact& known, const dContactGeom& contact, bool swapped) {
  return static_cast<int>(known.triangles[swapped ? 1 : 0]) == contact.side1 &&
         static_cast<int>(known.triangles[swapped ? 0 : 1]) == contact.side2;
}

}  // namespace

dBatchContactId ContactIds::id_of(const dContactGeom& contact) {
  const bool swapped = contact.g1 != first_;
  // Sides tell apart those in one place, but callbacks of the program may have changed them.
  std::size_t found = known_.size();
  for (std::size_t i = 0; i < known_.size(); ++i) {
    const std::size_t k = (next_ + i) % known_.size();
    if (!is_where(known_[k], contact, swapped)) continue;
    const bool certain = has_sides(known_[k], contact, swapped);
    if (certain || found == known_.size()) found = k;
    if (certain) break;
  }
  if (found == known_.size()) return kNoContactId;
  next_ = found + 1;
  const auto& features = known_[found].features;
  return {features[swapped ? 1 : 0], features[swapped ? 0 : 1]};
}

}  // namespace ode_ext
