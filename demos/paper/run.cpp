// SPDX-License-Identifier: BSD-3-Clause
#include "paper/run.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "paper/contestant.h"
#include "paper/machine.h"
#include "paper/schedule.h"
#include "paper/summary.h"
#include "paper/tables.h"
#include "paper/world.h"
#include "simulation/collision.h"
#include "simulation/exit_code.h"

namespace paper {
namespace {

using falling_objects::kExitCheckFailed;
using falling_objects::kExitNoDevice;
using falling_objects::kExitOk;
using falling_objects::kExitUsage;

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct OdeSession {
  OdeSession() { dInitODE2(0); }
  ~OdeSession() { dCloseODE(); }
};

class OutputFile {
 public:
  OutputFile(const std::string& directory, const std::string& name)
      : path_((std::filesystem::path(directory) / name).string()), stream_(path_) {
    if (!stream_) throw UsageError("cannot write '" + path_ + "'");
  }
  std::ostream& stream() { return stream_; }
  void close() {
    stream_.close();
    if (!stream_) throw std::runtime_error("writing '" + path_ + "' failed");
  }

 private:
  std::string path_;
  std::ofstream stream_;
};

void write_json(const std::string& directory, const std::string& name,
                const nlohmann::ordered_json& json) {
  OutputFile file(directory, name);
  file.stream() << json.dump(2) << '\n';
  file.close();
}

class Run {
 public:
  explicit Run(const Options& options);
  int run();

 private:
  // Returns the order in which they collided.
  std::vector<std::size_t> collide(int step);
  void record(int step, const std::vector<std::size_t>& order);
  void show_progress(int step) const;

  const Options& options_;
  World world_;
  std::vector<std::unique_ptr<Contestant>> contestants_;
  std::vector<Totals> totals_;
  std::size_t driver_;
  std::size_t reference_;  // whose contacts are all that there are
  Agreement agreement_;
  OutputFile steps_, work_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::size_t index_of(const std::vector<Configuration>& all, const Configuration& wanted) {
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), wanted) - all.begin());
}

Run::Run(const Options& options)
    : options_(options),
      world_(options.simulation),
      totals_(options.configurations.size()),
      driver_(index_of(options.configurations, options.driver)),
      reference_(index_of(options.configurations, Configuration{})),
      agreement_(options.configurations, driver_),
      steps_(options.out, "steps.csv"),
      work_(options.out, "work.csv") {
  if (reference_ == options.configurations.size()) reference_ = driver_;
  for (const Configuration& configuration : options.configurations) {
    contestants_.push_back(std::make_unique<Contestant>(configuration, options.simulation.device,
                                                        options.simulation.max_contacts));
    world_.introduce(contestants_.back()->collider());
  }
  write_steps_header(steps_.stream());
  write_work_header(work_.stream());
}

std::vector<std::size_t> Run::collide(int step) {
  std::vector<std::size_t> order = order_in(step, contestants_.size());
  std::erase_if(order, [&](std::size_t i) {
    return contestants_[i]->configuration().is_sampled() &&
           !is_measured_or_warming_up(step, options_.every);
  });
  for (const std::size_t i : order) contestants_[i]->collide(world_.space());
  return order;
}

void Run::record(int step, const std::vector<std::size_t>& order) {
  const bool settled = step >= settled_from(options_.steps);
  std::vector<std::optional<std::uint64_t>> hashes(contestants_.size());
  for (std::size_t place = 0; place < order.size(); ++place) {
    const Contestant& contestant = *contestants_[order[place]];
    const Configuration& configuration = contestant.configuration();
    hashes[order[place]] = contestant.hash();
    if (configuration.is_sampled() && !is_measured(step, options_.every)) continue;
    Totals& totals = totals_[order[place]];
    totals.add(contestant.collider(), settled);
    std::optional<Missed> missed;
    if (!configuration.is_lossless()) {
      missed = compare_contacts(contestants_[reference_]->contacts(), contestant.contacts());
      totals.missed += *missed;
    }
    write_step(steps_.stream(), step, place, contestant, missed);
    if (configuration.has(kCount)) write_work(work_.stream(), step, contestant);
  }
  agreement_.after_step(step, hashes);
}

void Run::show_progress(int step) const {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const int every = terminal ? 1 : std::max(1, static_cast<int>(options_.simulation.hz));
  if (options_.quiet || (step + 1) % every != 0) return;
  const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - start_;
  const double left = so_far.count() / (step + 1) * (options_.steps - step - 1);
  const Contestant& driver = *contestants_[driver_];
  std::fprintf(
      stderr, "%sstep %4d/%d  %6lld pairs  %6zu contacts  %5.0f s left%s", terminal ? "\r" : "",
      step + 1, options_.steps, dBatchColliderGetCount(driver.collider(), dBatchCounterPairs),
      driver.contacts().size(), left, !terminal || step + 1 == options_.steps ? "\n" : "  ");
}

int Run::run() {
  write_json(options_.out, "machine.json",
             describe_machine(dBatchColliderGetDeviceName(contestants_[driver_]->collider()),
                              options_.simulation.device, options_.command));
  for (int step = 0; step < options_.steps; ++step) {
    world_.prepare();
    record(step, collide(step));
    world_.advance(contestants_[driver_]->contacts());
    show_progress(step);
  }
  steps_.close();
  work_.close();
  std::vector<Result> results;
  for (std::size_t i = 0; i < contestants_.size(); ++i)
    results.push_back({options_.configurations[i], contestants_[i]->running_hash(), totals_[i]});
  const nlohmann::ordered_json summary = summarize(options_, agreement_, results);
  write_json(options_.out, "summary.json", summary);
  print_summary(std::cout, summary);
  return agreement_.holds() ? kExitOk : kExitCheckFailed;
}

int run_or_list(const Options& options) {
  if (options.list) {
    for (const Configuration& configuration : options.configurations)
      std::cout << configuration.name() << '\n';
    return kExitOk;
  }
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error) throw UsageError("cannot make '" + options.out + "': " + error.message());
  const OdeSession session;
  return Run(options).run();
}

}  // namespace

int run(const Options& options) {
  try {
    return run_or_list(options);
  } catch (const falling_objects::NoDevice& e) {
    std::cerr << "no device: " << e.message << '\n';
    return kExitNoDevice;
  } catch (const UsageError& e) {
    std::cerr << e.what() << '\n';
    return kExitUsage;
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return kExitCheckFailed;
  }
}

}  // namespace paper
