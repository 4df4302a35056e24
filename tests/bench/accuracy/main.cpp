// SPDX-License-Identifier: BSD-3-Clause
// Measures how true the contacts of the batch collider are, and those of ODE's own beside it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/accuracy/markdown.h"
#include "bench/accuracy/reference_contestant.h"
#include "bench/accuracy/report.h"
#include "support/arguments.h"

namespace {

using namespace ode_ext::accuracy;

constexpr const char* kFooter = R"(
Every trial prints its figures for ode_ext and for stock ODE, which get the same scenes, and the
targets that --check asserts. Figures in brackets describe the scenes. The device is chosen by
ODE_EXT_DEVICE, as always.

Examples:
  contact_accuracy all --check --json accuracy.json
  contact_accuracy cubes --count 100 --seed 3
  contact_accuracy table --markdown docs/accuracy.md   what is between the page's markers

Exit codes: 0 done, 1 something failed, or a target was missed with --check.)";

struct Settings {
  Options options;
  std::string json, markdown;
  std::string collider = "ode_ext";
  ode_ext::test::ContactOptions reference;
  bool check = false;
};

Outcome measure_collider(const Measure& measure, const Settings& settings) {
  if (settings.collider == "reference") {
    ReferenceContestant reference(settings.reference);
    return measure(reference);
  }
  BatchOde batch;
  return measure(batch);
}

Result run(const Trial& trial, const Settings& settings) {
  std::fprintf(stderr, "%s: making the scenes\n", trial.name);
  ode_ext::test::OdeWorld world;
  const Measure measure = trial.prepare(settings.options, world);
  std::fprintf(stderr, "%s: stock ODE\n", trial.name);
  StockOde stock;
  const Outcome of_stock = measure(stock);
  std::fprintf(stderr, "%s: %s\n", trial.name, settings.collider.c_str());
  return {&trial, measure_collider(measure, settings), of_stock, stock.pairs_given_up()};
}

int run(const std::vector<const Trial*>& trials, const Settings& settings) {
  nlohmann::json results = nlohmann::json::array();
  bool met = true;
  for (const Trial* trial : trials) {
    const Result result = run(*trial, settings);
    print(result, stdout);
    met = met && meets_targets(result);
    results.push_back(json_of(result));
    if (trial->prepare == prepare_table && !settings.markdown.empty())
      write_table(settings.markdown, markdown_of(result.ode_ext.details, result.stock.details));
  }
  if (!settings.json.empty()) {
    std::ofstream file(settings.json);
    const nlohmann::json all{{"seed", settings.options.seed}, {"trials", results}};
    if (!(file << all.dump(2) << '\n' << std::flush))
      throw std::runtime_error("cannot write " + settings.json);
  }
  if (settings.check) std::puts(met ? "all targets met" : "targets missed");
  return settings.check && !met ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Measures how true contacts are.", "contact_accuracy");
  app.footer(kFooter);
  app.require_subcommand(1, 0);
  app.fallthrough();
  app.add_option("--seed", settings.options.seed, "Of the scenes")->capture_default_str();
  app.add_option("--count", settings.options.count,
                 "Scenes (table: per cell); 0: as many as the trial wants. Not for coincident")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  app.add_option("--json", settings.json, "File for all figures and details");
  app.add_option("--markdown", settings.markdown, "File for the table, or a page with its markers");
  app.add_option("--collider", settings.collider,
                 "ode_ext, or in its place the reference of its contacts (tests/reference)")
      ->check(CLI::IsMember({"ode_ext", "reference"}))
      ->capture_default_str();
  app.add_option("--prefer-faces", settings.reference.prefer_faces,
                 "Of the reference: by how much shallower a pair of edges must be than a face")
      ->capture_default_str();
  app.add_option("--walk", settings.reference.walk, "Of the reference: see ContactOptions")
      ->capture_default_str();
  app.add_option("--all-edge-pairs", settings.reference.all_edge_pairs, "The same")
      ->capture_default_str();
  app.add_option("--check-ways", settings.reference.check_ways, "The same")->capture_default_str();
  app.add_option("--edge-tie", settings.reference.edge_tie, "The same");
  app.add_option("--hold-along-edges", settings.reference.hold_along_edges, "The same");
  app.add_option("--support-all", settings.reference.support_all, "The same")
      ->capture_default_str();
  app.add_option("--by-component", settings.reference.by_component, "The same")
      ->capture_default_str();
  app.add_flag("--check", settings.check, "Fail where ode_ext misses a target");
  const CLI::App* all = app.add_subcommand("all", "All of the following");
  std::vector<std::pair<const Trial*, const CLI::App*>> commands;
  for (const Trial& trial : all_trials())
    commands.emplace_back(&trial, app.add_subcommand(trial.name, trial.sentence));
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  std::vector<const Trial*> trials;
  for (const auto& [trial, command] : commands) {
    if (command->parsed() || all->parsed()) trials.push_back(trial);
  }
  try {
    return run(trials, settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
