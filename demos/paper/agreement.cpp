// SPDX-License-Identifier: BSD-3-Clause
#include "paper/agreement.h"

#include <algorithm>
#include <array>
#include <utility>

namespace paper {
namespace {

constexpr std::array<std::pair<Word, const char*>, 4> kClaims{
    {{kMonolithic, "pipelined == monolithic"},
     {kExact, "predicted == exact"},
     {kPlain, "Eq. 1 == Eq. 2 under redo"},
     {kBasic, "refit == basic"}}};

struct Claim {
  const char* text;
  Configuration counterpart;
};

std::vector<Claim> claims_of(const Configuration& configuration) {
  if (configuration.has(kCount)) return {{"counted == timed", configuration.without(kCount)}};
  std::vector<Claim> claims;
  for (const auto& [word, text] : kClaims) {
    if (configuration.has(word)) claims.push_back({text, configuration.without(word)});
  }
  if (configuration.has(kChecked)) {
    Configuration full = configuration.without(kChecked);
    full.rays = Rays::kFull;
    claims.push_back({"iterative == full", full});
  }
  return claims;
}

}  // namespace

Agreement::Agreement(const std::vector<Configuration>& configurations, std::size_t driver) {
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    if (i == driver || configurations[i].has(kIgnore)) continue;
    // By the paper's rule it matters which steps it took part in; it agrees with nobody else.
    const bool papers = configurations[i].follows_papers_rule();
    if (papers && configurations[i].is_sampled()) continue;
    for (const Claim& claim : claims_of(configurations[i])) {
      const auto found = std::find(configurations.begin(), configurations.end(), claim.counterpart);
      if (found == configurations.end() &&
          (papers || configurations[i].has(kEdges) != configurations[driver].has(kEdges)))
        continue;
      const std::size_t other = found != configurations.end()
                                    ? static_cast<std::size_t>(found - configurations.begin())
                                    : driver;
      comparisons_.push_back({claim.text, other, i});
    }
  }
}

void Agreement::after_step(int step, const std::vector<std::optional<std::uint64_t>>& hashes) {
  for (Comparison& comparison : comparisons_) {
    const auto& first = hashes[comparison.first];
    const auto& second = hashes[comparison.second];
    if (!first || !second) continue;
    ++comparison.steps;
    if (*first == *second) continue;
    if (comparison.differing++ == 0) comparison.first_difference = step;
  }
}

std::vector<Verdict> Agreement::verdicts() const {
  std::vector<Verdict> verdicts;
  for (const Comparison& comparison : comparisons_) {
    auto verdict = std::find_if(verdicts.begin(), verdicts.end(),
                                [&](const Verdict& v) { return v.claim == comparison.claim; });
    if (verdict == verdicts.end())
      verdict = verdicts.insert(verdict, Verdict{comparison.claim, 0, 0, {}});
    verdict->steps += comparison.steps;
    verdict->differing += comparison.differing;
    verdict->comparisons.push_back(comparison);
  }
  return verdicts;
}

bool Agreement::holds() const {
  return std::all_of(comparisons_.begin(), comparisons_.end(),
                     [](const Comparison& comparison) { return comparison.differing == 0; });
}

}  // namespace paper
