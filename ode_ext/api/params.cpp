// SPDX-License-Identifier: BSD-3-Clause
#include "api/params.h"

#include <algorithm>
#include <cfloat>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <sstream>

#include "api/guarded.h"
#include "ode/config.h"

namespace ode_ext::api {
namespace {

// Where dBatchColliderParams ended in each version of it, this one's last: fields are added at the
// end alone.
constexpr std::size_t kParamsSizes[] = {sizeof(dBatchColliderParams)};

void check(const dBatchColliderParams& p) {
  if (p.max_contacts < 1 || p.max_contacts > static_cast<int>(kMaxContacts))
    refuse("max_contacts is " + std::to_string(p.max_contacts) + ", expected 1 to " +
           std::to_string(kMaxContacts));
  if (p.max_contacts_deformable < 0 || p.max_contacts_deformable > static_cast<int>(kMaxContacts))
    refuse("max_contacts_deformable is " + std::to_string(p.max_contacts_deformable) +
           ", expected 0 (all) to " + std::to_string(kMaxContacts));
  if (p.trust_meshes < 0)
    refuse("trust_meshes is " + std::to_string(p.trust_meshes) + ", expected 0 or 1");
  // Used as a float, which is not to make 0 or infinity of it.
  const bool is_normal = p.open_thickness >= dReal{FLT_MIN} && p.open_thickness <= dReal{FLT_MAX};
  if (p.open_thickness != 0 && !is_normal) {
    std::ostringstream message;
    message << "open_thickness is " << p.open_thickness << " m, expected 0, or " << FLT_MIN
            << " to " << FLT_MAX;
    refuse(message.str());
  }
}

// Field `text` of a setting, or null past the last.
const char* setting_text(int index, const char* Setting::*text) {
  const auto all = settings();
  if (index < 0 || static_cast<std::size_t>(index) >= all.size()) return nullptr;
  return all[static_cast<std::size_t>(index)].*text;
}

}  // namespace

dBatchColliderParams complete(const dBatchColliderParams* given) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  if (given == nullptr) return params;
  if (std::ranges::find(kParamsSizes, given->struct_size) == std::end(kParamsSizes))
    refuse("params->struct_size is " + std::to_string(given->struct_size) + ", expected " +
           std::to_string(sizeof(params)) + "; fill params with dBatchColliderParamsInit first");
  std::memcpy(&params, given, given->struct_size);
  params.struct_size = sizeof(params);
  check(params);
  return params;
}

ColliderOptions to_options(const dBatchColliderParams& p) {
  ColliderOptions options;
  options.device = selection_or_environment(p.device);
  options.max_contacts = static_cast<std::uint32_t>(p.max_contacts);
  options.max_contacts_deformable = static_cast<std::uint32_t>(p.max_contacts_deformable);
  if (p.config != nullptr) apply_config(p.config, options);
  return options;
}

std::string selection_or_environment(const char* selection) {
  if (selection != nullptr) return selection;
  const char* environment = std::getenv("ODE_EXT_DEVICE");
  return environment == nullptr ? "" : environment;
}

}  // namespace ode_ext::api

using namespace ode_ext::api;

extern "C" {

void dBatchColliderParamsInitSize(dBatchColliderParams* params, size_t struct_size) {
  if (params == nullptr) return;
  // A program that was built with another header has another struct.
  std::memset(static_cast<void*>(params), 0, struct_size);
  dBatchColliderParams ours{};
  ours.struct_size = struct_size;
  ours.max_contacts = 16;
  std::memcpy(params, &ours, std::min(struct_size, sizeof(ours)));
}

const char* dBatchConfigName(int index) { return setting_text(index, &ode_ext::Setting::name); }
const char* dBatchConfigValues(int index) { return setting_text(index, &ode_ext::Setting::values); }
const char* dBatchConfigDefault(int index) {
  return setting_text(index, &ode_ext::Setting::initial);
}
const char* dBatchConfigMeaning(int index) {
  return setting_text(index, &ode_ext::Setting::meaning);
}

int dBatchConfigCheck(const char* config) {
  return guarded("dBatchConfigCheck", -1, [&] {
    if (config == nullptr) refuse("the config is NULL");
    ode_ext::ColliderOptions options;
    ode_ext::apply_config(config, options);
    return 0;
  });
}

}  // extern "C"
