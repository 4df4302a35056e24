// SPDX-License-Identifier: BSD-3-Clause
#include "ode/trace.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

namespace ode_ext {
namespace {

struct CloseTrace {
  void operator()(std::FILE* stream) const {
    std::fputs("\n]\n", stream);
    std::fclose(stream);
  }
};

std::mutex trace_mutex;
std::unique_ptr<std::FILE, CloseTrace> trace;
bool is_first = true;

void write_event(const char* name, int track, double start_us, double duration_us,
                 const std::string& arguments) {
  std::fprintf(trace.get(),
               "%s{\"name\":\"%s\",\"ph\":\"X\",\"pid\":1,\"tid\":%d,\"ts\":%.3f,\"dur\":%.3f%s}",
               is_first ? "" : ",\n", name, track, start_us, duration_us, arguments.c_str());
  is_first = false;
}

}  // namespace

void open_trace_of_environment() {
  const char* path = std::getenv("ODE_EXT_TRACE");
  if (path == nullptr || *path == '\0') return;
  const std::lock_guard lock(trace_mutex);
  if (trace != nullptr) return;
  trace.reset(std::fopen(path, "w"));
  if (trace == nullptr)
    throw std::runtime_error("ODE_EXT_TRACE names '" + std::string(path) +
                             "', which cannot be written: " + std::strerror(errno));
  std::fputs("[\n", trace.get());
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
}

}  // namespace ode_ext
