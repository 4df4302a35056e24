// SPDX-License-Identifier: BSD-3-Clause
#include "ode/trace.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string>
#include <system_error>

#include "ode/messages.h"
#include "ode/output_of_environment.h"
#include "opencl/fork_guard.h"

namespace ode_ext {
namespace {

std::mutex trace_mutex;
std::FILE* trace = nullptr;
bool is_first = true;
bool is_given_up = false;  // and what is written of it stays

// At the end of the program, in which threads may still make passes. A forked child leaves the
// parent's file alone.
struct CloseTrace {
  ~CloseTrace() {
    if (is_lost_by_fork()) return;
    const std::lock_guard lock(trace_mutex);
    if (trace == nullptr) return;
    std::fputs("\n]\n", trace);
    std::fclose(trace);
    trace = nullptr;
  }
} close_trace;

// In any locale of the program's.
std::string with_three_decimals(double number) {
  std::array<char, 64> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed, 3);
  return end.ec == std::errc() ? std::string(text.data(), end.ptr) : "0";
}

void write_event(const char* name, int track, double start_us, double duration_us,
                 const std::string& arguments) {
  std::fprintf(trace,
               "%s{\"name\":\"%s\",\"ph\":\"X\",\"pid\":1,\"tid\":%d,\"ts\":%s,\"dur\":%s%s}",
               is_first ? "" : ",\n", name, track, with_three_decimals(start_us).c_str(),
               with_three_decimals(duration_us).c_str(), arguments.c_str());
  is_first = false;
}

}  // namespace

void open_trace_of_environment() {
  const HeldMessages held;
  const std::lock_guard lock(trace_mutex);
  if (trace != nullptr || is_given_up) return;
  trace = open_output_of_environment("ODE_EXT_TRACE");
  if (trace != nullptr) std::fputs("[\n", trace);
}

void trace_pass(std::chrono::steady_clock::time_point start, const PassStats& stats) {
  const std::lock_guard lock(trace_mutex);
  if (trace == nullptr) return;
  const double begin = std::chrono::duration<double, std::micro>(start.time_since_epoch()).count();
  std::string counts;
  for (const Counter& counter : counters()) {
    counts += (counts.empty() ? "" : ",") + ('"' + counter.name + "\":") +
              std::to_string(counter.read(stats, counter.index));
  }
  write_event("pass", 1, begin, 1e3 * stats.ms_pass, ",\"args\":{" + counts + "}");
  double host = begin, device = begin;
  for (const TimedStage& stage : timed_stages()) {
    if (stage.track == TimedStage::kHost) {
      if (stage.value == dBatchStageDevice) device = host;
      write_event(stage.name, 1, host, 1e3 * stage.milliseconds(stats), "");
      host += 1e3 * stage.milliseconds(stats);
    }
  }
  // When within the device stage a kernel ran is not known, only for how long.
  for (const TimedStage& stage : timed_stages()) {
    if (stage.track != TimedStage::kDevice) continue;
    write_event(stage.name, 2, device, 1e3 * stage.milliseconds(stats), "");
    device += 1e3 * stage.milliseconds(stats);
  }
  // Nothing waits in memory that a forked child would write once more.
  if (std::fflush(trace) == 0 && std::ferror(trace) == 0) return;
  std::fclose(trace);
  trace = nullptr;
  is_given_up = true;
  log(LogLevel::kError, "the trace cannot be written any more; it ends within this pass");
}

}  // namespace ode_ext
