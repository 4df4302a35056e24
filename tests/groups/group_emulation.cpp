// SPDX-License-Identifier: BSD-3-Clause
// What a work-group goes through together (kernels/lib/group.h), on a processor, where no device
// has its instructions: to be loaded before OpenCL's loader (LD_PRELOAD). Kernels of that kind then
// run here, compiled for the host, in place of those of the device, on the device's memory; all
// others run as they are.
//
// Each work-item of a group is a context of its own and runs alone until it meets the others: as
// far ahead of them as can be, and now the first, now the last goes first. So most of what is
// written without ox_settle() where others read it comes to light, but not what two do in turns
// between two meetings; and where they do not all meet at one place of the code the program ends
// with a list of where they are.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <ucontext.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr std::uint32_t kItems = 16;     // OX_LANES
constexpr std::size_t kGroups = 3;       // fewer than pairs, so that each takes several
constexpr std::size_t kParameters = 37;  // OX_SCENE_PARAMETERS
constexpr std::size_t kStack = std::size_t{1} << 18;  // [bytes]

enum class Meeting { kOfItem, kBits, kSettle, kEnd };

struct Item {
  ucontext_t context;
  std::vector<char> stack = std::vector<char>(kStack);
  Meeting meeting = Meeting::kEnd;
  const void* place = nullptr;  // in the code
  std::uint32_t value = 0, other = 0, result = 0;
};

std::array<Item, kItems> items;
ucontext_t outside;
std::uint32_t current = 0;
bool backwards = false;
std::size_t group = 0;
std::uint64_t meetings = 0;
const char* kernel_name = "";
void (*kernel)() = nullptr;
std::vector<std::uint64_t> arguments;

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "group_emulation: %s, in %s, group %zu\n", what, kernel_name, group);
  for (std::uint32_t i = 0; i < kItems; ++i) {
    Dl_info library{};
    dladdr(items[i].place, &library);
    const auto offset =
        static_cast<const char*>(items[i].place) - static_cast<const char*>(library.dli_fbase);
    std::fprintf(stderr, "  item %u: kind %d at +0x%tx, value %u\n", i,
                 static_cast<int>(items[i].meeting), offset, items[i].value);
  }
  std::abort();
}

void meet() {
  ++meetings;
  for (const Item& item : items)
    if (item.meeting != items[0].meeting || item.place != items[0].place)
      fail("work-items do not meet at one place");
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < kItems; ++i)
    if (items[i].value != 0) bits |= 1u << i;
  for (Item& item : items) {
    if (item.meeting == Meeting::kOfItem && item.other >= kItems) fail("there is no such item");
    item.result = item.meeting == Meeting::kOfItem ? items[item.other].value : bits;
  }
}

std::uint32_t first() { return backwards ? kItems - 1 : 0; }
std::uint32_t last() { return kItems - 1 - first(); }

void go_on_with(std::uint32_t next) {
  const std::uint32_t before = std::exchange(current, next);
  if (before != next) swapcontext(&items[before].context, &items[next].context);
}

std::uint32_t wait_for_others(Meeting meeting, const void* place, std::uint32_t value,
                              std::uint32_t other) {
  Item& own = items[current];
  own.meeting = meeting;
  own.place = place;
  own.value = value;
  own.other = other;
  if (current == last()) {
    meet();
    backwards = (meetings * 2654435761u >> 7 & 1u) != 0;
    go_on_with(first());
  } else {
    go_on_with(backwards ? current - 1 : current + 1);
  }
  return own.result;
}

template <std::size_t... I>
void call_with(std::index_sequence<I...>) {
  reinterpret_cast<void (*)(decltype(static_cast<void>(I), std::uint64_t{})...)>(kernel)(
      arguments[I]...);
}

void run_item() {
  if (arguments.size() == 1)
    call_with(std::make_index_sequence<1>());
  else
    call_with(std::make_index_sequence<kParameters>());
  wait_for_others(Meeting::kEnd, nullptr, 0, 0);
  setcontext(&outside);
}

void run(const char* name, void (*function)(), std::vector<std::uint64_t> values) {
  kernel_name = name;
  kernel = function;
  arguments = std::move(values);
  for (group = 0; group < kGroups; ++group) {
    for (Item& item : items) {
      getcontext(&item.context);
      item.context.uc_stack.ss_sp = item.stack.data();
      item.context.uc_stack.ss_size = item.stack.size();
      item.context.uc_link = nullptr;
      makecontext(&item.context, run_item, 0);
    }
    current = first();
    swapcontext(&outside, &items[current].context);
  }
}

}  // namespace

// Kernels, and what they call: the functions of OpenCL C by their mangled names.
extern "C" {
void self_test_group();
void cull();
void flood();
void choose_planes();
void reduce_candidates();

std::uint32_t ox_emulated_of_item(std::uint32_t value, std::uint32_t item) {
  return wait_for_others(Meeting::kOfItem, __builtin_return_address(0), value, item);
}
std::uint32_t ox_emulated_bits(std::uint32_t holds) {
  return wait_for_others(Meeting::kBits, __builtin_return_address(0), holds, 0);
}
}

using Float3 = float __attribute__((vector_size(16)));  // as OpenCL passes it
using Int3 = std::int32_t __attribute__((vector_size(16)));
using Word = std::uint32_t;
#define OF_OPENCL(type, name, mangled, parameters) \
  extern type name parameters __asm__(mangled);    \
  type name parameters

OF_OPENCL(void, cl_barrier, "_Z7barrierj", (Word)) {
  wait_for_others(Meeting::kSettle, __builtin_return_address(0), 0, 0);
}
OF_OPENCL(std::size_t, cl_group, "_Z12get_group_idj", (Word)) { return group; }
OF_OPENCL(std::size_t, cl_groups, "_Z14get_num_groupsj", (Word)) { return kGroups; }
OF_OPENCL(std::size_t, cl_item, "_Z12get_local_idj", (Word)) { return current; }
OF_OPENCL(Word, cl_add, "_Z10atomic_addPU8CLglobalVjj", (volatile Word * at, Word more)) {
  const Word was = *at;
  *at = was + more;
  return was;
}
OF_OPENCL(Word, cl_cmpxchg, "_Z14atomic_cmpxchgPU8CLglobalVjjj",
          (volatile Word * at, Word expected, Word value)) {
  const Word was = *at;
  if (was == expected) *at = value;
  return was;
}
OF_OPENCL(Word, cl_clz, "_Z3clzj", (Word v)) {
  return v == 0 ? 32 : static_cast<Word>(__builtin_clz(v));
}
OF_OPENCL(Word, cl_popcount, "_Z8popcountj", (Word v)) {
  return static_cast<Word>(__builtin_popcount(v));
}
OF_OPENCL(Word, cl_min, "_Z3minjj", (Word a, Word b)) { return std::min(a, b); }
OF_OPENCL(Word, cl_mul_hi, "_Z6mul_hijj", (Word a, Word b)) {
  return static_cast<Word>(std::uint64_t{a} * b >> 32);
}
OF_OPENCL(float, cl_fma, "_Z3fmafff", (float a, float b, float c)) { return std::fma(a, b, c); }
OF_OPENCL(float, cl_sqrt, "_Z4sqrtf", (float v)) { return std::sqrt(v); }
OF_OPENCL(float, cl_fabs, "_Z4fabsf", (float v)) { return std::fabs(v); }
OF_OPENCL(Float3, cl_fabs3, "_Z4fabsDv3_f", (Float3 v)) {
  return Float3{std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])};
}
OF_OPENCL(Int3, cl_to_int3, "_Z16convert_int3_rteDv3_f", (Float3 v)) {
  const auto nearest = [](float of) { return static_cast<std::int32_t>(std::nearbyint(of)); };
  return Int3{nearest(v[0]), nearest(v[1]), nearest(v[2])};
}
OF_OPENCL(Float3, cl_to_float3, "_Z14convert_float3Dv3_i", (Int3 v)) {
  return Float3{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
OF_OPENCL(float, cl_clamp, "_Z5clampfff", (float v, float lo, float hi)) {
  return std::fmin(std::fmax(v, lo), hi);
}
OF_OPENCL(Float3, cl_vload3, "_Z6vload3mPU8CLglobalKf", (std::size_t i, const float* p)) {
  return Float3{p[3 * i], p[3 * i + 1], p[3 * i + 2]};
}
OF_OPENCL(void, cl_vstore3, "_Z7vstore3Dv3_fmPU8CLglobalf", (Float3 v, std::size_t i, float* p)) {
  for (std::size_t k = 0; k < 3; ++k) p[3 * i + k] = v[k];
}

// In place of the loader's.
namespace {

struct KernelOfDevice {
  std::string name;
  std::map<cl_uint, std::vector<char>> arguments;
};
std::map<cl_kernel, KernelOfDevice> kernels;
std::map<std::string, std::uint64_t> launches;

template <class Function>
Function* of_loader(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}
#define OF_LOADER(name) of_loader(&name, #name)

void (*emulated(const std::string& name))() {
  return name == "cull"                ? cull
         : name == "flood"             ? flood
         : name == "choose_planes"     ? choose_planes
         : name == "reduce_candidates" ? reduce_candidates
                                       : nullptr;
}

// The memory of a buffer, which a processor's device hands out as it is.
std::uint64_t mapped(cl_command_queue queue, cl_mem memory) {
  std::size_t size = 0;
  clGetMemObjectInfo(memory, CL_MEM_SIZE, sizeof(size), &size, nullptr);
  cl_int code = CL_SUCCESS;
  void* const there = clEnqueueMapBuffer(queue, memory, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0,
                                         size, 0, nullptr, nullptr, &code);
  if (code != CL_SUCCESS) {
    std::fprintf(stderr, "group_emulation: clEnqueueMapBuffer gives %d\n", code);
    std::abort();
  }
  return reinterpret_cast<std::uint64_t>(there);
}

void launch(cl_command_queue queue, const KernelOfDevice& of_device) {
  clFinish(queue);
  std::vector<std::uint64_t> values(kParameters, 0);
  std::vector<std::pair<cl_mem, void*>> memories;
  for (const auto& [index, bytes] : of_device.arguments) {
    if (bytes.size() == sizeof(cl_uint)) {
      cl_uint value = 0;
      std::memcpy(&value, bytes.data(), sizeof(value));
      values[index] = value;
      continue;
    }
    cl_mem memory = nullptr;
    std::memcpy(&memory, bytes.data(), sizeof(memory));
    if (memory == nullptr) continue;
    values[index] = mapped(queue, memory);
    memories.emplace_back(memory, reinterpret_cast<void*>(values[index]));
  }
  run(of_device.name.c_str(), emulated(of_device.name), std::move(values));
  ++launches[of_device.name];
  for (const auto& [memory, there] : memories)
    clEnqueueUnmapMemObject(queue, memory, there, 0, nullptr, nullptr);
  clFinish(queue);
}

// The group's own test, as the library makes it on a device.
const bool is_tested = [] {
  std::array<cl_uint, kGroups * kItems> results{};
  run("self_test_group", self_test_group, {reinterpret_cast<std::uint64_t>(results.data())});
  if (std::count(results.begin(), results.end(), 1u) != static_cast<long>(results.size()))
    fail("the self-test of groups fails");
  return true;
}();

}  // namespace

extern "C" {

__attribute__((visibility("default"))) cl_kernel clCreateKernel(cl_program program,
                                                                const char* name, cl_int* code) {
  const cl_kernel made = OF_LOADER(clCreateKernel)(program, name, code);
  kernels[made] = {name, {}};
  return made;
}

__attribute__((visibility("default"))) cl_int clSetKernelArg(cl_kernel of, cl_uint index,
                                                             std::size_t size, const void* value) {
  if (value != nullptr) {
    const char* const bytes = static_cast<const char*>(value);
    kernels[of].arguments[index].assign(bytes, bytes + size);
  }
  return OF_LOADER(clSetKernelArg)(of, index, size, value);
}

__attribute__((visibility("default"))) cl_int clEnqueueNDRangeKernel(
    cl_command_queue queue, cl_kernel of, cl_uint dimensions, const std::size_t* offset,
    const std::size_t* global, const std::size_t* local, cl_uint waits, const cl_event* wait_for,
    cl_event* event) {
  const KernelOfDevice& of_device = kernels[of];
  if (emulated(of_device.name) == nullptr || of_device.arguments.size() != kParameters)
    return OF_LOADER(clEnqueueNDRangeKernel)(queue, of, dimensions, offset, global, local, waits,
                                             wait_for, event);
  launch(queue, of_device);
  return event != nullptr ? clEnqueueMarkerWithWaitList(queue, 0, nullptr, event) : CL_SUCCESS;
}

__attribute__((visibility("default"))) cl_int clReleaseCommandQueue(cl_command_queue queue) {
  for (const auto& [name, count] : launches)
    std::fprintf(stderr, "group_emulation: %s launched %llu times\n", name.c_str(),
                 static_cast<unsigned long long>(count));
  std::fprintf(stderr, "group_emulation: %llu meetings\n",
               static_cast<unsigned long long>(meetings));
  return OF_LOADER(clReleaseCommandQueue)(queue);
}
}
