// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/run.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include "falling_objects/interruption.h"
#include "falling_objects/output_file.h"
#include "falling_objects/report.h"
#include "falling_objects/snapshot.h"
#include "falling_objects/usage_error.h"
#include "falling_objects/world.h"
#include "judging/checks.h"
#include "judging/expectations.h"
#include "judging/penetration.h"
#include "record/gltf_recorder.h"
#include "simulation/sheets.h"
#include "simulation/simulation.h"

namespace falling_objects {
namespace {

constexpr double kMeasureEvery = 0.1;      // [s] between two looks of the oracle
constexpr double kRecordEvery = 1.0 / 30;  // [s] between two poses of a recording
constexpr double kDrapeEvery = 1;          // [s] ... at the sheets, which takes it longer

struct OdeSession {
  OdeSession() { dInitODE2(0); }
  ~OdeSession() { dCloseODE(); }
};

int steps_in(double seconds, double hz) {
  return std::max(1, static_cast<int>(std::lround(seconds * hz)));
}

// What a run leaves behind, one after the other: what cannot be written takes nothing else with it.
class Outputs {
 public:
  template <class Write>
  void write(Write write_one) {
    try {
      write_one();
    } catch (const std::exception& e) {
      std::cerr << e.what() << '\n';
      complete_ = false;
    }
  }
  bool complete() const { return complete_; }

 private:
  bool complete_ = true;
};

void close(std::ofstream& file, const std::string& path) {
  file.close();
  if (!file) throw std::runtime_error("writing '" + path + "' failed");
}

// Of a run that was cut short nothing is known.
int print_verdict(const Options& options, const Checks& checks,
                  const std::vector<Outcome>& outcomes, bool finished) {
  if (!finished) {
    if (options.check || options.check_rest) std::cout << "check: not finished\n";
    return kExitCheckFailed;
  }
  for (const Outcome& outcome : outcomes) {
    std::cout << (outcome.holds ? "holds: " : "does not hold: ") << outcome.words << '\n';
  }
  if (!options.check && !options.check_rest) return kExitOk;
  std::vector<std::string> failures = checks.failures();
  for (const Outcome& outcome : outcomes) {
    if (!outcome.holds) failures.push_back(outcome.words);
  }
  for (const std::string& failure : failures) std::cout << "check: failed: " << failure << '\n';
  if (failures.empty()) std::cout << "check: passed\n";
  return failures.empty() ? kExitOk : kExitCheckFailed;
}

int run_scene(const Options& options, const MakeSpectator& watch) {
  World world(options);
  const Scene& scene = world.scene();
  for (const std::string& warning : world.warnings()) std::cerr << "warning: " << warning << '\n';
  const Sheets* sheets = world.sheets();
  std::unique_ptr<DrapingMeter> draping_meter;
  if (sheets != nullptr) draping_meter = std::make_unique<DrapingMeter>(scene, sheets->all());
  const Simulation& simulation = world.simulation();
  const Collision& collision = world.collision();
  std::unique_ptr<Spectator> spectator = watch ? watch(world) : nullptr;
  std::ofstream csv, snapshot;
  if (!options.csv.empty()) csv = open_output(options.csv);
  if (!options.snapshot.empty()) snapshot = open_output(options.snapshot);
  const PenetrationMeter meter(scene);
  Checks checks(scene, options.hz);
  Expectations expectations(scene, options.hz);
  Progress progress(options);
  std::unique_ptr<GltfRecorder> recorder;
  if (!options.record.empty()) {
    open_output(options.record);
    recorder = std::make_unique<GltfRecorder>(scene);
    recorder->record(0);
  }
  std::vector<StepRecord> records;
  Summary summary;
  const int measure_every = steps_in(kMeasureEvery, options.hz);
  const int drape_every = steps_in(kDrapeEvery, options.hz);
  const int record_every = steps_in(kRecordEvery, options.hz);
  const int rest_from = options.steps - static_cast<int>(options.rest_steps());
  Outputs outputs;
  bool finite = true;
  const Interruption interruption;
  const auto goes_on = [&] { return finite && interruption.signal() == 0; };
  for (int step = 0; step < options.steps && (step == 0 || goes_on()); ++step) {
    StepRecord record = world.step();
    finite = checks.after_step(record, simulation.contacts());
    expectations.after_step();
    if (finite && recorder && (step + 1) % record_every == 0) {
      recorder->record((step + 1) / options.hz);
    }
    if (finite && ((step + 1) % measure_every == 0 || step + 1 == options.steps)) {
      const PenetrationMeter::Result measured = meter.measure();
      checks.after_measurement(step, measured.too_deep);
      if (meter.measures_all()) expectations.after_measurement(measured.deepest);
      if (meter.measures_any()) record.deepest_penetration = measured.deepest;
    }
    if (finite && sheets != nullptr &&
        ((step + 1) % drape_every == 0 || step + 1 == options.steps)) {
      const Draping draping = draping_meter->measure();
      record.deepest_vertex = draping.deepest;
      record.crossing_share = draping.crossing_share();
      if (step + 1 == options.steps) checks.after_draping(draping);
      summary.draping = draping;
    }
    if (options.check_rest && step >= rest_from) checks.collect_speeds(record);
    records.push_back(record);
    progress.show(record);
    if (spectator) outputs.write([&] { spectator->after_step(record); });
    if (!outputs.complete()) spectator.reset();
  }
  progress.finish();
  if (options.check_rest) checks.judge_rest();

  summary.lost_objects = checks.lost_objects();
  summary.measures_all = meter.measures_all();
  summary.measures_any = meter.measures_any();
  summary.hash = simulation.hash();
  if (collision.has_batch()) summary.device = collision.device();
  print_report(std::cout, options, records, summary);
  if (spectator) outputs.write([&] { spectator->finish(std::cout); });
  if (csv.is_open()) {
    outputs.write([&] {
      write_csv(csv, records);
      close(csv, options.csv);
    });
  }
  if (recorder) outputs.write([&] { recorder->write(options.record); });
  if (snapshot.is_open()) {
    outputs.write([&] {
      const std::vector<std::unique_ptr<Sheet>> none;
      write_snapshot(snapshot, scene, sheets != nullptr ? sheets->all() : none);
      close(snapshot, options.snapshot);
    });
  }
  const bool finished = static_cast<int>(records.size()) == options.steps || !finite;
  const int verdict = print_verdict(options, checks, expectations.outcomes(), finished);
  outputs.write([] {
    if (!std::cout.flush()) throw std::runtime_error("the report could not be written");
  });
  if (static_cast<int>(records.size()) < options.steps) {
    std::cerr << "stopped after step " << records.size() << " of " << options.steps << ": "
              << (finite ? "interrupted" : "a position or velocity is no longer finite") << '\n';
    return interruption.signal() != 0 ? 128 + interruption.signal() : kExitCheckFailed;
  }
  return outputs.complete() ? verdict : kExitCheckFailed;
}

template <class Work>
int exit_code_of(const Options& options, Work work) {
  try {
    const OdeSession session;
    return work();
  } catch (const NoDevice& e) {
    std::cerr << "no device: " << e.message << '\n';
    return kExitNoDevice;
  } catch (const UsageError& e) {
    std::cerr << e.what() << '\n';
    return kExitUsage;
  } catch (const std::bad_alloc&) {
    std::cerr << "not enough memory for " << options.objects << " objects\n";
    return kExitUsage;
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return kExitCheckFailed;
  }
}

}  // namespace

int run(const Options& options, const MakeSpectator& watch) {
  return exit_code_of(options, [&] { return run_scene(options, watch); });
}

int run_window(const Options& options, const std::function<int(const Options&)>& show) {
  return exit_code_of(options, [&] { return show(options); });
}

}  // namespace falling_objects
