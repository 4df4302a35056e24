// SPDX-License-Identifier: BSD-3-Clause
// Thousands of passes in scenes that never stay the same: does memory grow, does speed fall, is
// anything lost? Exit code 1 if so.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

#include "soak/memory.h"
#include "soak/soak_thread.h"
#include "support/arguments.h"

namespace {

using namespace ode_ext::soak;
using Clock = std::chrono::steady_clock;

struct Options {
  long long passes = 20000;
  int threads = 2, bodies = 16, rows = 30;
  std::uint64_t seed = 1;
  double most_growth = 32;
  bool csv = false;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void say_nothing(int, const char*, va_list) {}  // failures are made on purpose

class Table {
 public:
  Table(const Options& options, const Progress& progress) : options_(options), progress_(progress) {
    std::puts(options.csv ? "pass,seconds,passes_per_second,resident_mib,in_use_mib"
                          : "    pass   seconds  passes/s  resident MiB  in use MiB");
  }

  void row() {
    const long long passes = progress_.passes;
    const double now = seconds_since(start_);
    const Memory memory = memory_now();
    in_use_.push_back(memory.in_use);
    std::printf(
        options_.csv ? "%lld,%.2f,%.1f,%.1f,%.1f\n" : "%8lld  %8.1f  %8.1f  %12.1f  %10.1f\n",
        passes, now, static_cast<double>(passes - last_passes_) / (now - last_), memory.resident,
        memory.in_use);
    std::fflush(stdout);
    last_ = now;
    last_passes_ = passes;
  }

  const std::vector<double>& in_use() const { return in_use_; }

 private:
  const Options& options_;
  const Progress& progress_;
  Clock::time_point start_ = Clock::now();
  double last_ = 0;
  long long last_passes_ = 0;
  std::vector<double> in_use_;
};

// Returns when `target` passes are done, or the run has failed. Ends the process if none comes any
// more.
void watch(long long target, const Progress& progress) {
  constexpr double kHang = 300;  // [s] for one pass; usual is a hundredth of a second
  long long last = -1;
  auto moved = Clock::now();
  while (progress.passes < target && !progress.stop) {
    if (last != progress.passes) {
      last = progress.passes;
      moved = Clock::now();
    }
    if (seconds_since(moved) > kHang) {
      std::printf("soak: no pass has ended for %g s\n", kHang);
      std::fflush(stdout);
      std::_Exit(1);  // threads that hang cannot be joined
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

int run(const Options& options) {
  dInitODE2(0);
  dSetMessageHandler(&say_nothing);
  Progress progress;
  std::vector<double> in_use;
  {
    std::vector<std::unique_ptr<SoakThread>> soaks;
    for (int i = 0; i < options.threads; ++i) {
      soaks.push_back(std::make_unique<SoakThread>(
          progress, options.seed + 1000 * static_cast<std::uint64_t>(i),
          static_cast<std::size_t>(options.bodies)));
    }
    Table table(options, progress);
    // Between rows no thread runs and every collider has its lists: those of one that is made anew,
    // or whose device failed, are tens of MiB that come and go.
    for (long long row = 1; row <= options.rows && !progress.stop; ++row) {
      const long long begin = options.passes * (row - 1) / options.rows;
      const long long end = options.passes * row / options.rows;
      std::vector<std::thread> threads;
      for (int i = 0; i < options.threads; ++i) {
        const long long from = begin + (end - begin) * i / options.threads;
        const long long to = begin + (end - begin) * (i + 1) / options.threads;
        threads.emplace_back(
            [&, i, share = to - from] { soaks[static_cast<std::size_t>(i)]->run(share); });
      }
      watch(end, progress);
      for (std::thread& thread : threads) thread.join();
      for (const auto& soak : soaks) soak->settle();
      table.row();
    }
    in_use = table.in_use();
  }
  dCloseODE();

  std::FILE* out = options.csv ? stderr : stdout;
  std::fprintf(
      out,
      "%lld passes, %lld pairs, %lld contacts; made %lld bodies, %lld meshes, %lld spaces,"
      " %lld colliders, %lld edits; the device failed in %lld passes; %lld pairs checked\n",
      progress.passes.load(), progress.pairs.load(), progress.contacts.load(),
      progress.bodies.load(), progress.meshes.load(), progress.spaces.load(),
      progress.colliders.load(), progress.edits.load(), progress.failures.load(),
      progress.checked.load());
  const double grown = growth(in_use);
  std::string flaw = progress.flaw();
  if (kResidentMemoryIsOurs) {
    std::fprintf(out, "memory in use grew by %.1f MiB after warm-up, allowed are %.1f\n", grown,
                 options.most_growth);
    if (flaw.empty() && grown > options.most_growth) flaw = "memory grows";
  } else {
    std::fprintf(out, "memory, the sanitizer's included, grew by %.1f MiB: not judged\n", grown);
  }
  if (flaw.empty() && progress.checked == 0) flaw = "no pair was checked";
  // What memory could be lost by has to have come to pass. (Whether a call that is to fail is made
  // at all depends on how long the passes take.)
  for (const auto& [count, what] : {std::pair{progress.colliders.load(), "collider"},
                                    {progress.meshes.load(), "mesh"},
                                    {progress.spaces.load(), "space"},
                                    {progress.edits.load(), "edit of a mesh"}})
    if (flaw.empty() && count == 0) flaw = std::string("no ") + what + " was among it";
  const char* sound = kResidentMemoryIsOurs ? "flat, and nothing lost" : "nothing lost";
  std::fprintf(out, "soak: %s\n", flaw.empty() ? sound : flaw.c_str());
  return flaw.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Passes over scenes in which bodies, meshes, spaces and colliders come and go, meshes are "
      "edited in place and the device fails now and then; a thread, a space and a collider each. "
      "Now and then a pair is asked of a fresh collider too, and must have the same bytes. Prints "
      "memory and speed over time. Exit code 1 if an answer differs, a pass does not end, or the "
      "median of memory in use over the last third of the run is larger than that of the middle "
      "third "
      "by more than --most-growth. In use is what was allocated and not freed; resident memory "
      "holds "
      "freed blocks as well.",
      "soak");
  app.add_option("--passes", options.passes, "Of all threads together")
      ->check(CLI::Range(1LL, 1000000000LL))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Each with a collider, a space and a world")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--bodies", options.bodies, "In each space, at most")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Of everything; with one thread a run can be repeated")
      ->capture_default_str();
  app.add_option("--rows", options.rows, "Of the table")
      ->check(CLI::Range(3, 10000))
      ->capture_default_str();
  app.add_option("--most-growth", options.most_growth,
                 "MiB that memory may grow by after warm-up. 32 is three times what was seen to "
                 "come and go; over a third of 20,000 passes it lets 5 KB a pass through, of 300 "
                 "passes 0.3 MB")
      ->capture_default_str();
  app.add_flag("--csv", options.csv, "The table as CSV, and the rest to stderr");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  return run(options);
}
