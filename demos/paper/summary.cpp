// SPDX-License-Identifier: BSD-3-Clause
#include "paper/summary.h"

#include <iomanip>
#include <string>

#include "paper/hex.h"

namespace paper {
namespace {

using Json = nlohmann::ordered_json;

// null of nothing.
Json ratio(double part, double whole) { return whole > 0 ? Json(part / whole) : Json(); }

Json summarize(const Verdict& verdict, const std::vector<Result>& results) {
  Json json{{"claim", verdict.claim},
            {"identical", verdict.differing == 0},
            {"steps", verdict.steps},
            {"differing", verdict.differing}};
  for (const Comparison& comparison : verdict.comparisons) {
    Json pair{{"first", results[comparison.first].configuration.name()},
              {"second", results[comparison.second].configuration.name()},
              {"steps", comparison.steps},
              {"differing", comparison.differing}};
    if (comparison.differing > 0) pair["first_difference"] = comparison.first_difference;
    json["comparisons"].push_back(pair);
  }
  return json;
}

Json summarize(const Missed& missed) {
  return {{"pairs", missed.pairs},
          {"missed_pairs", missed.missed_pairs},
          {"missed_pair_share",
           ratio(static_cast<double>(missed.missed_pairs), static_cast<double>(missed.pairs))},
          {"contacts", missed.contacts},
          {"missed_contacts", missed.missed_contacts},
          {"missed_contact_share", ratio(static_cast<double>(missed.missed_contacts),
                                         static_cast<double>(missed.contacts))},
          {"false_pairs", missed.false_pairs}};
}

// An unproven ray stands in both lists: it is one ray.
Json settled(const Totals& totals) {
  const auto iterative = static_cast<double>(totals.iterative_rays);
  const auto bvh = static_cast<double>(totals.bvh_rays);
  const auto unproven = static_cast<double>(totals.unproven);
  return {{"iterative_rays", totals.iterative_rays},
          {"unproven", totals.unproven},
          {"bvh_rays", totals.bvh_rays},
          {"iterative_share", ratio(iterative, iterative + bvh - unproven)},
          {"unproven_share", ratio(unproven, iterative)},
          {"ns_per_iterative_ray", ratio(1e6 * totals.iterative_ms, iterative)},
          {"ns_per_bvh_ray", ratio(1e6 * totals.bvh_ms, bvh)}};
}

void print_percent(std::ostream& out, const Json& share) {
  if (share.is_null())
    out << "none to speak of";
  else
    out << std::fixed << std::setprecision(3) << 100 * share.get<double>() << " %";
}

}  // namespace

Json summarize(const Options& options, const Agreement& agreement,
               const std::vector<Result>& results) {
  Json json{{"scene", options.scene},
            {"objects", options.simulation.objects},
            {"sheets", options.simulation.sheets},
            {"steps", options.steps},
            {"hz", options.simulation.hz},
            {"seed", options.simulation.seed},
            {"every", options.every},
            {"driver", options.driver.name()},
            {"settled_from", settled_from(options.steps)},
            {"identical", agreement.holds()},
            {"verdicts", Json::array()}};
  for (const Verdict& verdict : agreement.verdicts())
    json["verdicts"].push_back(summarize(verdict, results));
  for (const Result& result : results) {
    Json& entry = json["configurations"][result.configuration.name()];
    entry["steps"] = result.totals.steps;
    entry["running_hash"] = hex(result.running_hash);
    entry["redone"] = result.totals.redone;
    entry["settled"] = settled(result.totals);
    if (!result.configuration.is_lossless()) entry["missed"] = summarize(result.totals.missed);
  }
  return json;
}

void print_summary(std::ostream& out, const Json& summary) {
  for (const Json& verdict : summary["verdicts"]) {
    out << "verdict: " << verdict["claim"].get<std::string>() << ": ";
    if (verdict["identical"].get<bool>()) {
      out << "identical in " << verdict["steps"] << " comparisons\n";
      continue;
    }
    out << verdict["differing"] << " of " << verdict["steps"] << " comparisons DIFFER\n";
    for (const Json& pair : verdict["comparisons"]) {
      if (pair["differing"] == 0) continue;
      out << "  " << pair["second"].get<std::string>() << " differs from "
          << pair["first"].get<std::string>() << " in " << pair["differing"]
          << " steps, first in step " << pair["first_difference"] << '\n';
    }
  }
  for (const auto& [name, result] : summary["configurations"].items()) {
    if (result.contains("missed")) {
      const Json& missed = result["missed"];
      out << name << ": misses ";
      print_percent(out, missed["missed_pair_share"]);
      out << " of the colliding pairs (" << missed["missed_pairs"] << " of " << missed["pairs"]
          << "), ";
      print_percent(out, missed["missed_contact_share"]);
      out << " of the contacts\n";
    }
  }
  if (!summary["configurations"].contains("iterative")) return;
  const Json& settled = summary["configurations"]["iterative"]["settled"];
  out << "iterative, from step " << summary["settled_from"] << ": ";
  print_percent(out, settled["iterative_share"]);
  out << " of the rays are iterative; of those cast in full: ";
  print_percent(out, settled["unproven_share"]);
  out << '\n';
}

}  // namespace paper
