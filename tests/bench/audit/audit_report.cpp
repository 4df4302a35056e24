// SPDX-License-Identifier: BSD-3-Clause
#include "bench/audit/audit_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

namespace ode_ext::audit {
namespace {

constexpr std::size_t kMostMisses = 10;

double share(long long part, long long whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

void print_row(const std::string& a, const std::string& b, const Tally& t) {
  std::printf(
      "%-9s %-9s %8lld %9lld %7lld %9lld %9lld %8lld %7lld %6.2f%% %6lld %7lld %7lld %6lld %6lld "
      "%6lld %6lld %8lld %6lld %6lld\n",
      a.c_str(), b.c_str(), t.pairs, t.intersecting, t.batch.on_edge, t.contained,
      t.contained - t.batch.missed_contained, t.batch.found, t.batch.missed,
      share(t.batch.missed, t.colliding()), t.batch.false_contacts, t.regions, t.batch.bare,
      t.batch.bare_full, t.batch.bare_slight, t.batch.bare_beyond, t.stock.missed,
      t.stock.missed_contained, t.stock.false_contacts, t.stock.bare);
  std::fflush(stdout);
}

void print_pose(std::ostream& out, const char* name, const test::TestPose& pose) {
  out << ' ' << name << " at";
  for (const double c : pose.position) out << ' ' << c;
  out << " turned";
  for (const double c : pose.rotation) out << ' ' << c;
}

nlohmann::json to_json(const Answers& a) {
  return {{"found", a.found},
          {"missed", a.missed},
          {"missed_contained", a.missed_contained},
          {"false", a.false_contacts},
          {"on_the_edge", a.on_edge},
          {"regions_uncovered", a.bare},
          {"regions_uncovered_in_full_lists", a.bare_full},
          {"regions_slight", a.bare_slight},
          {"regions_beyond_limit", a.bare_beyond}};
}

nlohmann::json to_json(const Tally& t) {
  return {{"poses", t.pairs},     {"colliding", t.intersecting}, {"contained", t.contained},
          {"regions", t.regions}, {"ode_ext", to_json(t.batch)}, {"stock_ode", to_json(t.stock)}};
}

}  // namespace

Report::Report() {
  std::puts(
      "poses; colliding by FCL; of wrong answers, those on the edge; one mesh inside the other, "
      "and of those found;\npairs found and missed; false contacts; regions of overlap, those "
      "without a "
      "contact, of these in pairs with as\nmany contacts as allowed; apart: those too slight, "
      "those beyond the limit. The last four columns are ODE's own\ncollider: missed, of those "
      "contained, false, regions without.\n");
  std::printf("%-9s %-9s %8s %9s %7s %9s %9s %8s %7s %7s %6s %7s %7s %6s %6s %6s %6s %8s %6s %7s\n",
              "first", "second", "poses", "colliding", "edge", "contained", "c. found", "found",
              "missed", "share", "false", "regions", "without", "full", "slight", "beyond",
              "missed", "cont.", "false", "without");
}

void Report::add_row(const std::string& a, const std::string& b, const Tally& tally) {
  print_row(a, b, tally);
  rows_.push_back({a, b, tally});
  total_ += tally;
}

void Report::add(const std::string& a, const std::string& b,
                 const std::array<Tally, 3>& by_approach) {
  Tally sum;
  for (std::size_t i = 0; i < by_approach.size(); ++i) {
    sum += by_approach[i];
    by_approach_[i] += by_approach[i];
  }
  add_row(a, b, sum);
}

void Report::add_scene(const Tally& tally) { add_row("settled", "pile", tally); }

void Report::miss(const std::string& a, const std::string& b, std::uint64_t seed,
                  const Miss& miss) {
  if (misses_.size() >= kMostMisses) return;
  std::ostringstream text;
  text.precision(17);
  text << (miss.answers.missed > 0           ? "missed"
           : miss.answers.false_contacts > 0 ? "false"
                                             : "regions without a contact")
       << ", " << miss.contacts << " contacts: --seed " << seed << " --first " << a << " --second "
       << b << ", pose " << miss.index << ", " << name_of(miss.poses.approach) << ':';
  print_pose(text, "first", miss.poses.a);
  print_pose(text, "second", miss.poses.b);
  misses_.push_back(text.str());
}

void Report::finish() const {
  std::puts("");
  for (std::size_t i = 0; i < by_approach_.size(); ++i) {
    print_row("all", name_of(static_cast<Approach>(i)), by_approach_[i]);
  }
  print_row("all", "", total_);
  if (!misses_.empty()) std::puts("\nThe first wrong answers:");
  for (const std::string& text : misses_) std::puts(text.c_str());
}

nlohmann::json Report::json(std::uint64_t seed) const {
  nlohmann::json rows = nlohmann::json::array();
  for (const Row& row : rows_) {
    rows.push_back({{"first", row.a}, {"second", row.b}, {"result", to_json(row.tally)}});
  }
  nlohmann::json approaches;
  for (std::size_t i = 0; i < by_approach_.size(); ++i) {
    approaches[name_of(static_cast<Approach>(i))] = to_json(by_approach_[i]);
  }
  return {{"seed", seed}, {"rows", rows}, {"approaches", approaches}, {"total", to_json(total_)}};
}

}  // namespace ode_ext::audit
