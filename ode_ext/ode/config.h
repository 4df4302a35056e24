// SPDX-License-Identifier: BSD-3-Clause
// What serves the paper and tuning, as text: "rays=full,organization=monolithic". One table is what
// is read, what is listed (dBatchConfigName, ...) and what is documented.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "collide/options.h"

namespace ode_ext {

struct Setting {
  const char* name;
  const char* values;   // words with '|' between them; or a range of numbers, for people
  const char* initial;  // the value of a collider that was not told otherwise
  const char* meaning;  // a sentence without its full stop
  // Takes a value as it was written. False: it is none of `values`.
  bool (*take)(const Setting& setting, std::string_view text, ColliderOptions& options);
};

std::span<const Setting> settings();

// Throws std::invalid_argument, a sentence that says what there is instead.
void apply_config(std::string_view config, ColliderOptions& options);

}  // namespace ode_ext
