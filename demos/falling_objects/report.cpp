// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/report.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <string_view>

#include "simulation/speeds.h"

namespace falling_objects {
namespace {

// `value` of those steps for which it is not negative.
template <class Value>
std::vector<double> column(const std::vector<StepRecord>& steps, Value value) {
  std::vector<double> result;
  for (const StepRecord& step : steps) {
    const auto v = static_cast<double>(value(step));
    if (v >= 0) result.push_back(v);
  }
  return result;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

void print_count(std::ostream& out, const char* name, const std::vector<double>& values) {
  out << "  " << std::left << std::setw(22) << name << std::right << std::setprecision(0)
      << std::setw(10) << quantile(values, 0.5) << std::setw(10) << largest(values) << '\n';
}

void print_time(std::ostream& out, const char* name, const std::vector<double>& values) {
  out << "  " << std::left << std::setw(22) << name << std::right << std::setprecision(3)
      << std::setw(10) << quantile(values, 0.5) << std::setw(10) << quantile(values, 0.95) << '\n';
}

// Steps in which nothing is near anything compare two empty passes: left out.
void print_ratio(std::ostream& out, const char* name, std::vector<StepRecord> steps) {
  std::erase_if(steps, [](const StepRecord& s) { return s.pairs == 0 || !(s.batch_ms > 0); });
  const auto ratios = column(steps, [](const StepRecord& s) { return s.ode_ms / s.batch_ms; });
  out << "  " << std::left << std::setw(22) << name << std::right << std::setprecision(2)
      << std::setw(9) << quantile(ratios, 0.5) << "x   10th..90th percentile "
      << quantile(ratios, 0.1) << "x .. " << quantile(ratios, 0.9) << "x   (" << ratios.size()
      << " steps; batch " << quantile(column(steps, [](auto& s) { return s.batch_ms; }), 0.5)
      << " ms, ODE " << quantile(column(steps, [](auto& s) { return s.ode_ms; }), 0.5) << " ms)\n";
}

void print_comparison(std::ostream& out, const std::vector<StepRecord>& steps) {
  out << "\nODE's time over the batch's, same poses, callbacks included\n";
  print_ratio(out, "all steps", steps);
  const auto last_third = static_cast<std::ptrdiff_t>(steps.size() - steps.size() / 3);
  print_ratio(out, "last third", {steps.begin() + last_third, steps.end()});
  const auto batch = column(steps, [](const StepRecord& s) { return s.batch_contacts; });
  const auto ode = column(steps, [](const StepRecord& s) { return s.ode_contacts; });
  out << std::setprecision(0) << "  contacts per step     batch " << quantile(batch, 0.5)
      << " median, " << largest(batch) << " most;  ODE " << quantile(ode, 0.5) << " median, "
      << largest(ode) << " most\n";
}

// The fastest vertex over as long as the checks look at.
void print_draping(std::ostream& out, const Options& options, const std::vector<StepRecord>& steps,
                   const Draping& draping) {
  const auto depths = column(steps, [](auto& s) { return s.deepest_vertex; });
  const auto shares = column(steps, [](auto& s) { return s.crossing_share; });
  const auto speeds = column(steps, [](auto& s) { return s.fastest_vertex; });
  const auto last = std::min(speeds.size(), options.rest_steps());
  out << std::setprecision(4) << "  deepest sheet vertex  " << largest(depths) << " m, at the end "
      << draping.deepest << " m; " << draping.inside << " deeper than " << kVertexMayBeInside
      << " m (measured on the meshes)\n"
      << "  sheet triangles that cross objects or the ground: at most " << std::setprecision(3)
      << 100 * largest(shares) << " %, at the end " << 100 * draping.crossing_share() << " % ("
      << draping.crossing << " of " << draping.triangles << ")\n"
      << "  fastest sheet vertex  " << largest(speeds) << " m/s, over the last 0.5 s "
      << largest({speeds.end() - static_cast<std::ptrdiff_t>(last), speeds.end()}) << " m/s\n";
}

}  // namespace

Progress::Progress(const Options& options)
    : quiet_(options.quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      steps_(options.steps),
      every_(terminal_ ? 1 : std::max(1, static_cast<int>(std::lround(options.hz)))),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

// Once a simulated second, or where that takes longer, every ten seconds.
void Progress::show(const StepRecord& r) {
  constexpr double kSilence = 10;  // [s]
  const auto now = std::chrono::steady_clock::now();
  const auto since = [&](auto start) { return std::chrono::duration<double>(now - start).count(); };
  if (quiet_ || ((r.step + 1) % every_ != 0 && since(last_) < kSilence)) return;
  last_ = now;
  const double left = since(start_) / (r.step + 1) * (steps_ - r.step - 1);
  std::fprintf(stderr,
               "%sstep %4d/%d  %6lld pairs  %6lld contacts  collide %8.2f ms  world %8.2f ms  "
               "%.2f m/s  %4.0f s left%s",
               terminal_ ? "\r" : "", r.step + 1, steps_, r.pairs, r.contacts, r.collide_ms,
               r.world_ms, r.mean_speed, left, terminal_ ? "  " : "\n");
}

void Progress::finish() {
  if (!quiet_ && terminal_) std::fputc('\n', stderr);
}

void print_report(std::ostream& out, const Options& options, const std::vector<StepRecord>& steps,
                  const Summary& summary) {
  const bool batch = !summary.device.empty();
  out << std::fixed << "scene " << options.scene << ": " << options.objects << " objects, ";
  if (options.has_sheets()) out << options.sheets << " sheets, ";
  out << steps.size() << " steps at " << std::setprecision(0) << options.hz << " Hz, seed "
      << options.seed << ", at most " << options.max_contacts << " contacts a pair\n";
  out << "collider: " << (options.collider == Collider::kBatch ? "batch" : "ODE's own");
  if (batch) out << ", device " << summary.device;
  out << "\n\n  per step                  median   largest\n";
  print_count(out, "pairs", column(steps, [](auto& s) { return s.pairs; }));
  print_count(out, "colliding pairs", column(steps, [](auto& s) { return s.colliding_pairs; }));
  print_count(out, "contacts", column(steps, [](auto& s) { return s.contacts; }));
  if (options.has_sheets()) {
    print_count(out, "contacts of sheets", column(steps, [](auto& s) { return s.sheet_contacts; }));
  }
  if (batch) print_count(out, "rays", column(steps, [](auto& s) { return s.rays; }));

  out << "\n  ms                        median      95 %\n";
  if (batch) {
    for (std::size_t stage = 0; stage < stages().size(); ++stage) {
      print_time(out, stage_name(stage), column(steps, [&](auto& s) { return s.stage_ms[stage]; }));
    }
  }
  print_time(out, "collide, all", column(steps, [](auto& s) { return s.collide_ms; }));
  if (options.has_sheets()) {
    print_time(out, "cloth solver", column(steps, [](auto& s) { return s.cloth_ms; }));
  }
  print_time(out, "world step", column(steps, [](auto& s) { return s.world_ms; }));
  if (options.compare) print_comparison(out, steps);

  const auto contact_depths = column(steps, [](auto& s) { return s.deepest_contact; });
  const auto depths = column(steps, [](auto& s) { return s.deepest_penetration; });
  const auto redone = std::count_if(steps.begin(), steps.end(), [](const StepRecord& s) {
    return (s.status & dBatchStatusRedone) != 0;
  });
  out << std::setprecision(4) << "\n  deepest contact       " << largest(contact_depths) << " m\n"
      << "  deepest penetration   ";
  if (depths.empty()) {
    out << "not measured" << (summary.measures_any ? "\n" : ": open meshes have no inside\n");
  } else {
    out << largest(depths) << " m, at the end " << depths.back() << " m (measured on the "
        << (summary.measures_all ? "meshes)\n" : "closed meshes alone)\n");
  }
  out << "  mean speed at the end " << (steps.empty() ? 0 : steps.back().mean_speed) << " m/s\n"
      << "  objects lost          " << summary.lost_objects << '\n';
  if (options.has_sheets()) print_draping(out, options, steps, summary.draping);
  if (batch) out << "  steps redone          " << redone << " (for larger buffers; nothing lost)\n";
  out << "  contact hash          " << std::hex << std::setw(16) << std::setfill('0')
      << summary.hash << std::dec << std::setfill(' ') << '\n';
}

const char* stage_name(std::size_t stage) { return dBatchStageName(stages().at(stage)); }

void write_csv(std::ostream& out, const std::vector<StepRecord>& steps) {
  out << "step,pairs,colliding_pairs,contacts,rays,status";
  for (const int stage : stages()) out << ',' << dBatchStageName(stage) << "_ms";
  out << ",collide_ms,world_ms,batch_ms,ode_ms,batch_contacts,ode_contacts,mean_speed,"
         "deepest_contact,deepest_penetration,sheet_contacts,cloth_ms,fastest_vertex,deepest_"
         "vertex,"
         "crossing_share\n"
      << std::setprecision(9);
  for (const StepRecord& s : steps) {
    out << s.step << ',' << s.pairs << ',' << s.colliding_pairs << ',' << s.contacts << ','
        << s.rays << ',' << s.status;
    for (const double ms : s.stage_ms) out << ',' << ms;
    out << ',' << s.collide_ms << ',' << s.world_ms << ',' << s.batch_ms << ',' << s.ode_ms << ','
        << s.batch_contacts << ',' << s.ode_contacts << ',' << s.mean_speed << ','
        << s.deepest_contact << ',';
    if (s.deepest_penetration >= 0) out << s.deepest_penetration;  // empty: not measured
    out << ',' << s.sheet_contacts << ',' << s.cloth_ms << ',' << s.fastest_vertex << ',';
    if (s.deepest_vertex >= 0) out << s.deepest_vertex;
    out << ',';
    if (s.crossing_share >= 0) out << s.crossing_share;
    out << '\n';
  }
}

}  // namespace falling_objects
