// SPDX-License-Identifier: BSD-3-Clause
#include "paper/configuration.h"

#include <array>
#include <stdexcept>
#include <utility>

namespace paper {
namespace {

constexpr std::array<std::pair<Word, const char*>, 8> kWords{{{kChecked, "checked"},
                                                              {kBasic, "basic"},
                                                              {kMonolithic, "monolithic"},
                                                              {kExact, "exact"},
                                                              {kPlain, "plain"},
                                                              {kIgnore, "ignore"},
                                                              {kCount, "count"},
                                                              {kEdges, "edges"}}};

[[noreturn]] void refuse(std::string_view name, const std::string& why) {
  std::string words;
  for (const auto& [word, text] : kWords) words += std::string(words.empty() ? "" : ", ") + text;
  throw std::invalid_argument("'" + std::string(name) + "' is no configuration: " + why +
                              "; a name is 'full' or 'iterative', then any of " + words +
                              ", with '-' between them");
}

Rays parse_rays(std::string_view name, std::string_view word) {
  if (word == "full") return Rays::kFull;
  if (word == "iterative") return Rays::kIterative;
  refuse(name, "it begins with '" + std::string(word) + "'");
}

Word parse_word(std::string_view name, std::string_view text) {
  for (const auto& [word, known] : kWords) {
    if (text == known) return word;
  }
  refuse(name, "nothing is called '" + std::string(text) + "'");
}

}  // namespace

std::string Configuration::name() const {
  std::string name = rays == Rays::kFull ? "full" : "iterative";
  for (const auto& [word, text] : kWords) {
    if (has(word)) name += std::string("-") + text;
  }
  return name;
}

std::string Configuration::config() const {
  std::string config = rays == Rays::kFull ? "rays=full"
                       : has(kChecked)     ? "rays=iterative"
                                           : "rays=iterative-paper";
  if (has(kBasic)) config += ",deformable_target=basic";
  if (has(kMonolithic)) config += ",organization=monolithic";
  if (has(kExact)) config += ",workload=exact";
  if (has(kPlain)) config += ",prediction=plain";
  if (has(kIgnore)) config += std::string(",misprediction=ignore,confidence=") + kPapersConfidence;
  config += has(kEdges) ? ",edges=on" : ",edges=off";  // the paper has none
  if (has(kCount)) config += ",count_work=on";
  return config;
}

Configuration parse_configuration(std::string_view name) {
  Configuration configuration;
  std::string_view rest = name;
  const auto take = [&] {
    const std::size_t end = rest.find('-');
    const std::string_view word = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    return word;
  };
  configuration.rays = parse_rays(name, take());
  if (name.ends_with('-')) refuse(name, "it ends with '-'");
  while (!rest.empty()) {
    const Word word = parse_word(name, take());
    if (configuration.has(word)) refuse(name, "it says something twice");
    configuration.words |= word;
  }
  if (configuration.has(kChecked) && configuration.rays == Rays::kFull)
    refuse(name, "only iterative rays can be checked");
  if (configuration.has(kEdges) && (configuration.words & ~unsigned{kEdges | kPlain | kExact}) != 0)
    refuse(name, "edges go with 'plain' and 'exact' alone");
  if (configuration.has(kEdges) && configuration.rays != Rays::kFull)
    refuse(name, "edges go with full rays alone");
  return configuration;
}

std::vector<Configuration> default_configurations(std::string_view scene) {
  const std::vector<unsigned> timed{0, kMonolithic, kExact, kPlain, kIgnore, kPlain | kIgnore};
  const std::vector<unsigned> counted{kCount, kMonolithic | kCount};
  std::vector<Configuration> result;
  const auto add = [&](Rays rays, unsigned words, const std::vector<unsigned>& variants) {
    for (const unsigned variant : variants) result.push_back({rays, words | variant});
  };
  if (scene == "rigid-deformable") {
    // The paper's three algorithms, and with a refitted BVH in place of the basic one. Of the full
    // rays the paper says nothing here: they are the reference.
    add(Rays::kFull, 0, {0, kEdges});
    add(Rays::kIterative, 0, timed);
    add(Rays::kIterative, kBasic, {0, kMonolithic, kExact});
    result.push_back({Rays::kIterative, kChecked});
    add(Rays::kIterative, 0, counted);
    add(Rays::kIterative, kBasic, counted);
  } else {
    add(Rays::kFull, 0, timed);
    add(Rays::kFull, 0, {kEdges});
    add(Rays::kIterative, 0, timed);
    result.push_back({Rays::kIterative, kChecked});
    add(Rays::kFull, 0, counted);
    add(Rays::kIterative, 0, counted);
  }
  return result;
}

}  // namespace paper
