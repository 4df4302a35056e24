// SPDX-License-Identifier: BSD-3-Clause
// Drops the demo's objects with the batch collider driving and, once they have settled, compares
// what it says of every pair with what FCL says. Exit code 1 if a pair with a vertex inside was
// overlooked or a contact is false.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/audit/frames.h"
#include "bench/audit/scene_audit.h"
#include "simulation/simulation.h"
#include "support/arguments.h"

namespace {

using ode_ext::audit::Findings;
using ode_ext::audit::Frames;
using ode_ext::audit::SceneAudit;

struct OdeSession {
  OdeSession() { dInitODE2(0); }
  ~OdeSession() { dCloseODE(); }
};

void print_header() {
  std::printf("%6s %8s %8s %9s %8s %8s %10s %6s %8s %10s\n", "step", "pairs", "crossing",
              "contained", "contact", "fragile", "edges only", "share", "missed", "false");
}

void print_row(const char* name, const Findings& f) {
  const long long colliding = f.intersecting + f.contained;
  const double share =
      colliding > 0 ? 100.0 * static_cast<double>(f.edges_only) / static_cast<double>(colliding)
                    : 0;
  std::printf("%6s %8lld %8lld %9lld %8lld %8lld %10lld %5.1f%% %8lld %10lld\n", name, f.pairs,
              f.intersecting, f.contained, f.in_contact, f.fragile, f.edges_only, share,
              f.overlooked, f.false_contacts);
  std::fflush(stdout);
}

int audit(const falling_objects::SimulationSettings& options, const Frames& frames) {
  const OdeSession session;
  std::vector<std::string> warnings;
  falling_objects::Scene scene(falling_objects::make_shapes(), options, warnings);
  falling_objects::Collision collision(options, scene.space());
  falling_objects::Simulation simulation(options, scene, collision, nullptr);
  const SceneAudit auditor(scene);
  falling_objects::ContactList contacts(options.max_contacts);
  Findings total;
  print_header();
  for (int frame = 0, step = 0; frame < frames.count; ++step) {
    if (frames.has(step)) {
      collision.collide(falling_objects::Collider::kBatch, contacts);
      const Findings found = auditor.look(contacts.contacts());
      print_row(std::to_string(step).c_str(), found);
      total += found;
      ++frame;
    }
    simulation.step();
  }
  print_row("all", total);
  if (total.errors() > 0) std::puts("audit: failed");
  return total.errors() > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  falling_objects::SimulationSettings options;
  Frames frames;
  CLI::App app("Compares the batch collider's contacts in a settled pile with FCL's answers.",
               "rigid_audit");
  app.add_option("--objects", options.objects, "How many fall")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  frames.add_options(app, 1);
  app.add_option("--seed", options.seed, "Of the placement and the ground")->capture_default_str();
  app.add_option("--max-contacts", options.max_contacts, "Contacts per pair at most")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--device", options.device, "OpenCL device, as in ODE_EXT_DEVICE");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  try {
    return audit(options, frames);
  } catch (const falling_objects::NoDevice& error) {
    std::fprintf(stderr, "no device: %s\n", error.message.c_str());
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
