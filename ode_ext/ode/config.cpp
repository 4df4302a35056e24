// SPDX-License-Identifier: BSD-3-Clause
#include "ode/config.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <type_traits>

namespace ode_ext {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// What precedes the next separator; `rest` is what follows it.
std::string_view take_until(char separator, std::string_view& rest) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

// The whole of the text, or nothing.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// A word: the values of the option ascend from 0 in the order of the words.
template <auto kOption>
bool take_word(const Setting& setting, std::string_view text, ColliderOptions& options) {
  using Value = std::remove_reference_t<decltype(options.*kOption)>;
  std::string_view words = setting.values;
  for (int i = 0; !words.empty(); ++i) {
    if (take_until('|', words) != text) continue;
    options.*kOption = static_cast<Value>(i);
    return true;
  }
  return false;
}

template <auto kOption>
bool take_count(const Setting&, std::string_view text, ColliderOptions& options) {
  const auto count = number_of<std::uint32_t>(text);
  if (!count || *count < 1 || *count > std::numeric_limits<std::int32_t>::max()) return false;
  options.*kOption = *count;
  return true;
}

template <auto kOption>
bool take_factor(const Setting&, std::string_view text, ColliderOptions& options) {
  using Value = std::remove_reference_t<decltype(options.*kOption)>;
  const auto factor = number_of<Value>(text);
  if (!factor || !(*factor > 0) || !std::isfinite(*factor)) return false;
  options.*kOption = *factor;
  return true;
}

using O = ColliderOptions;
constexpr const char* kCount = "1 to 2147483647";
constexpr const char* kFactor = "a number above 0";

constexpr Setting kSettings[] = {
    {"rays", "full|iterative|iterative-paper", "full",
     "which rays are cast (GRAPP section 3): every ray in full; where a pair moved little, from "
     "the "
     "triangle met in the last pass, and what lies before what that finds is looked at; or as the "
     "paper, where a vertex without temporal data is dropped and what the walk finds is believed, "
     "which misses contacts",
     &take_word<&O::rays>},
    {"edges", "off|on", "on",
     "whether edges are cast besides vertices; off as the paper, which overlooks one colliding "
     "pair "
     "in ten of coarse meshes in random poses",
     &take_word<&O::edges>},
    {"organization", "pipelined|monolithic", "pipelined",
     "a kernel per step and per algorithm of rays, with append buffers in between; or one kernel "
     "with a switch for vertices and their rays, what the paper compares itself with",
     &take_word<&O::organization>},
    {"deformable_target", "refit|basic", "refit",
     "how rays find the triangles of a deformable mesh: through a BVH refitted in every pass; or "
     "by "
     "looking at every triangle, as the paper",
     &take_word<&O::deformable_target>},
    {"workload", "predicted|exact", "predicted",
     "how many work-groups a kernel is launched with (GRAPP section 4.2): predicted from the last "
     "pass; or read back before every launch",
     &take_word<&O::launches>},
    {"prediction", "pair-scaled|plain", "pair-scaled",
     "how workloads and sizes of buffers are predicted (GRAPP section 4.1): Eq. 1, last count * "
     "pairs now / pairs then * confidence; or Eq. 2, last count * confidence",
     &take_word<&O::prediction>},
    {"confidence", kFactor, "1.2",
     "the factor on predictions; below 1 costs time only, unless misprediction is not redo",
     &take_factor<&O::confidence>},
    {"misprediction", "redo|ignore|backtrack", "redo",
     "what happens when a buffer was predicted too small (GRAPP section 4.1): it grows and the "
     "pass "
     "is computed again; or, as the paper, what exceeds it is lost and counted; or the pass "
     "delivers nothing, returns 0 and makes no callback, and the next has room for it",
     &take_word<&O::misprediction>},
    {"initial_capacity", kCount, "16384",
     "entries of each append buffer at the start; buffers grow by themselves",
     &take_count<&O::initial_capacity>},
    {"work_group_size", kCount, "64", "work-items per work-group, at most what the device takes",
     &take_count<&O::work_group_size>},
    {"walk_limit", kCount, "32", "triangles that an iterative ray walks across at most",
     &take_count<&O::walk_limit>},
    {"displacement_limit", kFactor, "1",
     "how far the vertices of a pair may have moved since its last pass for iterative rays, in "
     "mean "
     "edge lengths of the target",
     &take_factor<&O::displacement_limit>},
    {"count_work", "off|on", "off",
     "whether the work of every work-item of vertices and their rays is counted "
     "(dBatchColliderGetWork), of all vertices; slow",
     &take_word<&O::count_work>},
};

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument("config: " + why); }

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

const Setting& setting_named(std::string_view name) {
  std::string names;
  for (const Setting& setting : kSettings) {
    if (name == setting.name) return setting;
    names += std::string(names.empty() ? "" : ", ") + setting.name;
  }
  refuse("nothing is called " + quoted(name) + "; there are " + names);
}

}  // namespace

std::span<const Setting> settings() { return kSettings; }

void apply_config(std::string_view config, ColliderOptions& options) {
  std::set<std::string_view> given;
  for (std::string_view rest = config; !rest.empty();) {
    const std::string_view entry = trimmed(take_until(',', rest));
    if (entry.empty()) continue;
    std::string_view value = entry;
    const std::string_view name = trimmed(take_until('=', value));
    const Setting& setting = setting_named(name);
    if (!given.insert(name).second) refuse(quoted(name) + " is said twice");
    if (!setting.take(setting, trimmed(value), options))
      refuse(setting.name + std::string(" is ") + quoted(trimmed(value)) + ", expected " +
             setting.values);
  }
}

}  // namespace ode_ext
