// SPDX-License-Identifier: BSD-3-Clause
// Does the collider overlook anything? All ordered pairs of ten kinds of mesh in random poses,
// shallow, deep and one inside the other, and a settled pile: what it says is compared with FCL and
// other oracles, and so is what ODE's own collider says. With --check, exit code 1 if a pair was
// missed, a contact is false or a region of overlap has none.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/audit/audit_report.h"
#include "bench/audit/frames.h"
#include "bench/audit/kind_pair.h"
#include "bench/audit/scene_audit.h"
#include "simulation/simulation.h"
#include "support/arguments.h"

namespace {

using namespace ode_ext::audit;
using ode_ext::test::Random;

// Pairs with a mesh of more triangles than this get a fifth of the poses.
constexpr int kLarge = 50000;

struct Options {
  Trial trial;
  std::string first, second;  // only these kinds, if not empty
  int objects = 1000;
  Frames frames{.count = 60};
  bool check = false;
  std::string json;
};

struct OdeSession {
  OdeSession() { dInitODE2(0); }
  ~OdeSession() { dCloseODE(); }
};

// Independent numbers for every ordered pair of kinds.
std::uint64_t seed_of(std::uint64_t seed, std::size_t a, std::size_t b) {
  return Random(Random(seed).next() + 256 * a + b).next();
}

void audit_kinds(const Options& options, Report& report) {
  const OdeSession session;
  const std::vector<Kind> kinds = make_kinds();
  std::vector<std::unique_ptr<Body>> bodies;
  for (const Kind& kind : kinds) bodies.push_back(std::make_unique<Body>(kind.mesh));
  for (std::size_t a = 0; a < kinds.size(); ++a) {
    for (std::size_t b = 0; b < kinds.size(); ++b) {
      if (!options.first.empty() && kinds[a].name != options.first) continue;
      if (!options.second.empty() && kinds[b].name != options.second) continue;
      Trial trial = options.trial;
      trial.seed = seed_of(options.trial.seed, a, b);
      const int triangles =
          std::max(kinds[a].mesh.triangle_count(), kinds[b].mesh.triangle_count());
      if (triangles > kLarge) trial.poses = (trial.poses + 4) / 5;
      std::fprintf(stderr, "%s, %s: %zu of %zu\n", kinds[a].name.c_str(), kinds[b].name.c_str(),
                   a * kinds.size() + b + 1, kinds.size() * kinds.size());
      const KindPair pair(*bodies[a], *bodies[b], trial.seed);
      report.add(kinds[a].name, kinds[b].name, pair.run(trial, [&](const Miss& miss) {
        report.miss(kinds[a].name, kinds[b].name, options.trial.seed, miss);
      }));
    }
  }
}

Answers answers_of(const Findings& findings) {
  Answers answers;
  answers.found = findings.found;
  answers.missed = findings.overlooked + findings.edges_only;
  answers.false_contacts = findings.false_contacts;
  answers.on_edge = findings.fragile;
  answers.bare = findings.bare;
  answers.bare_full = findings.bare_full;
  answers.bare_slight = findings.bare_slight;
  answers.bare_beyond = findings.bare_beyond;
  return answers;
}

void audit_scene(const Options& options, Report& report) {
  const OdeSession session;
  falling_objects::SimulationSettings scene_options;
  scene_options.objects = options.objects;
  scene_options.seed = options.trial.seed;
  scene_options.max_contacts = options.trial.max_contacts;
  scene_options.device = options.trial.device;
  scene_options.compare = true;
  std::vector<std::string> warnings;
  falling_objects::Scene scene(falling_objects::make_shapes(), scene_options, warnings);
  falling_objects::Collision collision(scene_options, scene.space());
  falling_objects::Simulation simulation(scene_options, scene, collision, nullptr);
  const SceneAudit auditor(scene, scene_options.max_contacts);
  falling_objects::ContactList batch(scene_options.max_contacts), stock = batch;
  Tally total;
  for (int frame = 0, step = 0; frame < options.frames.count; ++step) {
    if (options.frames.has(step)) {
      collision.collide(falling_objects::Collider::kBatch, batch);
      collision.collide(falling_objects::Collider::kOde, stock);
      const Findings found = auditor.look(batch.contacts());
      total += {found.pairs,   found.intersecting, found.contained,
                found.regions, answers_of(found),  answers_of(auditor.look(stock.contacts()))};
      std::fprintf(stderr, "\rframe %d of %d ", ++frame, options.frames.count);
    }
    simulation.step();
  }
  std::fputs("\n", stderr);
  report.add_scene(total);
}

int run(const Options& options) {
  Report report;
  audit_kinds(options, report);
  if (options.frames.count > 0) audit_scene(options, report);
  report.finish();
  if (!options.json.empty()) {
    std::ofstream file(options.json);
    file << report.json(options.trial.seed).dump(2) << '\n';
    if (!file.flush()) throw std::runtime_error("cannot write " + options.json);
  }
  const bool passed = report.total().batch.errors() == 0 && report.total().colliding() > 0;
  std::printf("missed_pairs: %s\n", passed ? "nothing missed, nothing false" : "failed");
  return options.check && !passed ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Compares the batch collider's answers for random pairs of meshes, and for a "
      "settled pile, with FCL's; and ODE's own collider's beside them.",
      "missed_pairs");
  app.add_option("--poses", options.trial.poses,
                 "Per ordered pair of kinds; a fifth of it with 70,000 triangles")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--seed", options.trial.seed, "Of the poses and the pile")->capture_default_str();
  app.add_option("--first", options.first, "Only this kind as the first of a pair");
  app.add_option("--second", options.second, "Only this kind as the second");
  options.frames.add_options(app, 0);
  app.add_option("--objects", options.objects, "In the pile")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--max-contacts", options.trial.max_contacts, "Contacts per pair at most")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--device", options.trial.device, "OpenCL device, as in ODE_EXT_DEVICE");
  app.add_flag("--reference", options.trial.reference,
               "The reference of the contacts (tests/reference) in the collider's place, for the "
               "pairs; not for the pile");
  app.add_option("--json", options.json, "Writes the table to this file as well");
  app.add_flag("--check", options.check, "Exit code 1 unless nothing is missed or false");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  try {
    return run(options);
  } catch (const falling_objects::NoDevice& error) {
    std::fprintf(stderr, "no device: %s\n", error.message.c_str());
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
