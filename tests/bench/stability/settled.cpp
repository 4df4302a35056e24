// SPDX-License-Identifier: BSD-3-Clause
// The rigid scene of falling_objects, once with the contacts of ode_ext and once with ODE's own:
// how still the pile lies, how deep its objects are in each other, and what that costs.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/stability/trials.h"
#include "judging/penetration.h"
#include "meshes/shapes.h"
#include "simulation/simulation.h"
#include "simulation/speeds.h"

namespace ode_ext::stability {
namespace {

using falling_objects::mean;
using falling_objects::quantile;

struct OdeSession {
  OdeSession() { dInitODE2(0); }
  ~OdeSession() { dCloseODE(); }
};

// Over the last third of the steps.
struct Pile {
  std::vector<double> speeds, depths;  // [m/s], [m]: of objects and of pairs, every half second
  std::vector<double> contacts, collide_ms, solver_ms;  // of steps
  double deepest = 0;                                   // [m], of the whole run, as far as looked
};

Pile run(falling_objects::Collider collider, const TrialOptions& trial) {
  const int steps = trial.quick ? std::min(trial.steps, 240) : trial.steps;
  falling_objects::SimulationSettings settings;
  settings.objects = trial.quick ? std::min(trial.objects, 60) : trial.objects;
  settings.seed = trial.seed;
  settings.max_contacts = trial.max_contacts;
  settings.collider = collider;
  const OdeSession session;
  std::vector<std::string> warnings;
  falling_objects::Scene scene(falling_objects::make_shapes(), settings, warnings);
  falling_objects::Collision collision(settings, scene.space());
  falling_objects::Simulation simulation(settings, scene, collision, nullptr);
  const falling_objects::PenetrationMeter meter(scene);
  const int half_second = static_cast<int>(std::lround(settings.hz / 2));
  Pile pile;
  for (int step = 0; step < steps; ++step) {
    const falling_objects::StepRecord record = simulation.step();
    const bool last = step + 1 == steps;
    if ((step + 1) % (4 * half_second) == 0) {
      say("settled: step %d of %d, %lld contacts", step + 1, steps, record.contacts);
    }
    const bool look = (step + 1) % half_second == 0 || last;
    if (look) pile.deepest = std::max(pile.deepest, meter.measure().deepest);
    if (step < steps - steps / 3) continue;
    pile.contacts.push_back(static_cast<double>(record.contacts));
    pile.collide_ms.push_back(record.collide_ms);
    pile.solver_ms.push_back(record.solver_ms);
    if (!look) continue;
    const std::vector<double> speeds = falling_objects::speeds(scene);
    pile.speeds.insert(pile.speeds.end(), speeds.begin(), speeds.end());
    const std::vector<double> depths = meter.all_depths();
    pile.depths.insert(pile.depths.end(), depths.begin(), depths.end());
  }
  return pile;
}

}  // namespace

void run_settled(const TrialOptions& options, Report& report) {
  report.note(
      "settled: the rigid scene of falling_objects at 60 Hz. Over the last third of the "
      "steps: speeds and depths\nof every half second, contacts and times as medians of "
      "steps. Depths are measured on the meshes.");
  std::vector<Row> rows;
  for (const auto collider : {falling_objects::Collider::kBatch, falling_objects::Collider::kOde}) {
    const char* name = collider == falling_objects::Collider::kBatch ? "ode_ext" : "stock";
    say("settled: %s", name);
    const Pile pile = run(collider, options);
    rows.push_back({{"collider", name},
                    {"mean m/s", mean(pile.speeds)},
                    {"95 % m/s", quantile(pile.speeds, 0.95)},
                    {"mean depth mm", 1000 * mean(pile.depths)},
                    {"95 % mm", 1000 * quantile(pile.depths, 0.95)},
                    {"deepest mm", 1000 * quantile(pile.depths, 1)},
                    {"deepest of run mm", 1000 * pile.deepest},
                    {"contacts", std::lround(quantile(pile.contacts, 0.5))},
                    {"collide ms", quantile(pile.collide_ms, 0.5)},
                    {"solver ms", quantile(pile.solver_ms, 0.5)}});
  }
  report.table("settled: how the pile lies, and what a step costs", rows);
}

}  // namespace ode_ext::stability
