// SPDX-License-Identifier: BSD-3-Clause
#include "paper/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "simulation/exit_code.h"

namespace paper {
namespace {

using falling_objects::kExitOk;
using falling_objects::kExitUsage;

constexpr const char* kDeformableScene = "rigid-deformable";

constexpr const char* kDescription =
    "Measures the library as GRAPP section 5 does. One configuration drives the simulation, all\n"
    "others collide the same poses in the same step. demos/paper/figures.py draws the results.";

constexpr const char* kFooter = R"(
Configurations are 'full' or 'iterative' (rays), then any of
  checked      what iterative rays find is checked by full ones; without it the paper's rule, by
               which it is believed, and which misses contacts
  basic        every triangle of a deformable mesh instead of a refitted BVH
  monolithic   one kernel instead of the pipeline
  exact        the exact workload instead of the predicted one
  plain        predictions by Eq. 2 instead of Eq. 1
  ignore       what exceeds a prediction is lost; confidence 1.02, as in the paper
  count        the work of every work-item is counted
  edges        crossings of edges are searched; 'full-edges' is the library as it is by default
Those with basic or count are so slow that they are measured in every K-th step only (--every K);
they collide in the two steps before too, so that temporal data and predictions are as always.

DIR gets steps.csv (a row per step and configuration), work.csv (what was counted), machine.json
and summary.json (what must be identical, and whether it was).

Examples:
  paper run --out results                             the paper's scene, a thousand objects, 10 s
  paper run --objects 100 --steps 60 --out results    a try
  paper run --configurations full,full-monolithic --out results
  paper run --scene rigid --list                      the configurations of a scene

Exit codes: 0 done, 1 results differ that must be identical, or something failed, 2 wrong usage or
DIR cannot be written, 3 no device.)";

std::string command_line(int argc, const char* const* argv) {
  std::string command = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

void add_configuration(std::vector<Configuration>& configurations, const Configuration& added) {
  if (std::find(configurations.begin(), configurations.end(), added) == configurations.end())
    configurations.push_back(added);
}

void choose_configurations(const std::vector<std::string>& names, const std::string& driver,
                           Options& options) {
  for (const std::string& name : names)
    add_configuration(options.configurations, parse_configuration(name));
  if (names.empty()) options.configurations = default_configurations(options.scene);
  options.driver = parse_configuration(driver);
  if (options.driver.has(kCount))
    throw std::invalid_argument("'" + driver + "' does not collide in every step: it cannot drive");
  if (!options.driver.is_lossless())
    throw std::invalid_argument("'" + driver + "' may miss contacts: it cannot drive");
  add_configuration(options.configurations, options.driver);
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv, std::ostream& out,
                            std::ostream& err) {
  ParsedOptions parsed;
  Options& o = parsed.options;
  falling_objects::SimulationSettings& simulation = o.simulation;
  std::vector<std::string> names;
  std::string driver = "full";
  CLI::App app(kDescription, "paper");
  CLI::App* run = app.add_subcommand("run", "Run a scene and write what was measured");
  app.footer("paper run --help says more.");
  run->footer(kFooter);
  run->get_formatter()->column_width(34);
  run->add_option("--scene", o.scene,
                  "rigid (default): 1,000 objects of four shapes; rigid-deformable: 216 of them, "
                  "and 36 sheets of cloth that fall on them")
      ->check(CLI::IsMember({"rigid", kDeformableScene}))
      ->option_text("rigid|rigid-deformable");
  const CLI::Option* objects =
      run->add_option("--objects", simulation.objects, "How many objects (default: 1000, or 216)")
          ->check(CLI::Range(1, 1000000));
  const CLI::Option* sheets =
      run->add_option("--sheets", simulation.sheets, "How many sheets (default: 0, or 36)")
          ->check(CLI::Range(1, 1000));
  run->add_option("--steps", o.steps, "How many steps, 60 a second")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  run->add_option("--seed", simulation.seed, "Of the placement and the ground")
      ->capture_default_str();
  run->add_option("--every", o.every, "Measure slow configurations in every K-th step")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  CLI::Option* directory = run->add_option("--out", o.out, "Where the results go; made if missing");
  run->add_option("--configurations", names, "Which (default: all that the figures need)")
      ->delimiter(',')
      ->option_text("NAME,NAME...");
  run->add_option("--driver", driver, "Whose contacts drive the simulation")->capture_default_str();
  run->add_option("--device", simulation.device, "OpenCL device, as in ODE_EXT_DEVICE");
  run->add_flag("--quiet", o.quiet, "No progress");
  run->add_flag("--list", o.list, "Print the configurations and stop");
  try {
    app.parse(argc, argv);
    if (!run->parsed()) throw CLI::RequiredError("A subcommand");
    const bool deformable = o.scene == kDeformableScene;
    if (deformable && objects->empty()) simulation.objects = 216;
    if (deformable && sheets->empty()) simulation.sheets = 36;
    if (!deformable && simulation.sheets > 0)
      throw CLI::ValidationError("--sheets", "only with --scene rigid-deformable");
    if (!o.list && directory->count() == 0) throw CLI::RequiredError("--out");
    o.command = command_line(argc, argv);
    choose_configurations(names, driver, o);
  } catch (const CLI::ParseError& e) {
    parsed.exit_code = app.exit(e, out, err) == 0 ? kExitOk : kExitUsage;
  } catch (const std::invalid_argument& e) {
    err << e.what() << '\n';
    parsed.exit_code = kExitUsage;
  }
  return parsed;
}

}  // namespace paper
