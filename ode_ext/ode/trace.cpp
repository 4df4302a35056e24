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
  void operator()(std::FILE* file) const {
    std::fputs("\n]\n", file);
    std::fclose(file);
  }
};

std::mutex mutex;
std::unique_ptr<std::FILE, CloseTrace> trace;
bool is_first = true;

struct Stage {
  const char* name;
  int index;
};
constexpr Stage kHostStages[] = {{"gather", dBatchStageGather},
                                 {"meshes", dBatchStageMeshes},
                                 {"device", dBatchStageDevice},
                                 {"export", dBatchStageExport}};
constexpr Stage kKernels[] = {{"deform_step", dBatchStageDeformStep},
                              {"pair_step", dBatchStagePairStep},
                              {"vertex_step", dBatchStageVertexStep},
                              {"iterative_rays", dBatchStageIterativeRays},
                              {"bvh_rays", dBatchStageBvhRays},
                              {"basic_rays", dBatchStageBasicRays},
                              {"monolithic", dBatchStageMonolithic},
                              {"cull", dBatchStageCull},
                              {"match", dBatchStageMatch},
                              {"cross", dBatchStageCross},
                              {"flood", dBatchStageFlood},
                              {"assembly", dBatchStageAssembly},
                              {"contact_step", dBatchStageContactStep},
                              {"whole_step", dBatchStageWholeStep}};

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
  const std::lock_guard lock(mutex);
  if (trace != nullptr) return;
  trace.reset(std::fopen(path, "w"));
  if (trace == nullptr)
    throw std::runtime_error("ODE_EXT_TRACE names '" + std::string(path) +
                             "', which cannot be written: " + std::strerror(errno));
  std::fputs("[\n", trace.get());
}

void trace_pass(std::chrono::steady_clock::time_point start, const dBatchColliderStats& stats) {
  const std::lock_guard lock(mutex);
  if (trace == nullptr) return;
  const double begin = std::chrono::duration<double, std::micro>(start.time_since_epoch()).count();
  write_event("pass", 1, begin, 1e3 * stats.ms[dBatchStagePass],
              ",\"args\":{\"pairs\":" + std::to_string(stats.pairs) +
                  ",\"rays_iterative\":" + std::to_string(stats.actual[dBatchBufferRaysIterative]) +
                  ",\"rays_bvh\":" + std::to_string(stats.actual[dBatchBufferRaysBvh]) +
                  ",\"rays_basic\":" + std::to_string(stats.actual[dBatchBufferRaysBasic]) +
                  ",\"meshlet_pairs\":" + std::to_string(stats.actual[dBatchBufferMeshletPairs]) +
                  ",\"contacts\":" + std::to_string(stats.actual[dBatchBufferContacts]) + "}");
  double time = begin;
  double device_begin = begin;
  for (const Stage& stage : kHostStages) {
    if (stage.index == dBatchStageDevice) device_begin = time;
    write_event(stage.name, 1, time, 1e3 * stats.ms[stage.index], "");
    time += 1e3 * stats.ms[stage.index];
  }
  time = device_begin;  // when within the device stage a kernel ran is not known, only for how long
  for (const Stage& kernel : kKernels) {
    write_event(kernel.name, 2, time, 1e3 * stats.ms[kernel.index], "");
    time += 1e3 * stats.ms[kernel.index];
  }
}

}  // namespace ode_ext
