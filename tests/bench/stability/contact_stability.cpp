// SPDX-License-Identifier: BSD-3-Clause
// Can one step on the contacts? Towers, slopes, slides, throws and bodies at rest, with the
// contacts of ode_ext, of ODE's own mesh collider and of ODE's boxes in the same run.
#include <CLI/CLI.hpp>
#include <cstdarg>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "bench/stability/bench.h"
#include "bench/stability/trials.h"
#include "simulation/collision.h"
#include "support/arguments.h"

namespace ode_ext::stability {

void say(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::vfprintf(stderr, format, arguments);
  va_end(arguments);
  std::fputc('\n', stderr);
}

namespace {

struct Trial {
  const char* name;
  const char* help;
  std::function<void(const TrialOptions&, Report&)> run;
};

const std::vector<Trial>& trials() {
  static const std::vector<Trial> all{
      {"towers", "Stacks of cubes stand wherever ODE's boxes do", run_towers},
      {"slope", "A box holds on a slope or slides, by the angle of friction", run_slope},
      {"slide", "A box slides over many triangles and does not feel their edges", run_slide},
      {"throws", "Non-convex bodies that meet gain no energy", run_throws},
      {"rest", "Single bodies lie still", run_rest},
      {"terrain", "Stones lie still on hills, wherever these are in their mesh", run_terrain},
      {"settled", "A thousand objects lie in a bowl", run_settled},
  };
  return all;
}

}  // namespace
}  // namespace ode_ext::stability

int main(int argc, char** argv) {
  using namespace ode_ext::stability;
  TrialOptions options;
  std::string json;
  bool check = false, reference = false;
  ode_ext::test::ContactOptions reference_options;
  CLI::App app(
      "Runs the same bodies with the contacts of ode_ext, of ODE's own mesh collider and "
      "of ODE's box geoms.",
      "contact_stability");
  app.footer(
      "The device is that of ODE_EXT_DEVICE. Exit status: 0, or 1 after an error, or with "
      "--check where a target was missed.");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--seed", options.seed, "Of all that is random")->capture_default_str();
  app.add_option("--max-contacts", options.max_contacts, "Contacts per pair at most")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--objects", options.objects, "How many fall, of settled")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--steps", options.steps, "How many steps, of settled")
      ->check(CLI::Range(3, 1000000))
      ->capture_default_str();
  app.add_flag("--quick", options.quick, "Fewer and shorter runs");
  app.add_option("--json", json, "Write all figures to this file");
  app.add_flag("--reference", reference,
               "The reference of the contacts (tests/reference) in ode_ext's place; not for "
               "settled");
  app.add_option("--prefer-faces", reference_options.prefer_faces,
                 "Of the reference: by how much shallower a pair of edges must be than a face")
      ->capture_default_str();
  app.add_option("--edge-tie", reference_options.edge_tie, "The same");
  app.add_flag("--hold-along-edges", reference_options.hold_along_edges, "The same");
  app.add_flag("--support-all", reference_options.support_all,
               "Of the reference: see ContactOptions");
  app.add_flag("--check", check, "Exit with 1 where a target is missed");
  for (const Trial& trial : trials()) app.add_subcommand(trial.name, trial.help);
  app.add_subcommand("all", "All of them");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  try {
    if (reference) use_reference(reference_options);
    Report report(std::cout);
    const bool all = app.got_subcommand("all");
    for (const Trial& trial : trials()) {
      if (all || app.got_subcommand(trial.name)) trial.run(options, report);
    }
    if (!json.empty()) report.write(json);
    return check && !report.all_met() ? 1 : 0;
  } catch (const falling_objects::NoDevice& error) {
    std::cerr << error.message << '\n';
    return 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
