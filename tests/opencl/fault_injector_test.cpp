// SPDX-License-Identifier: BSD-3-Clause
// Fails every OpenCL call in turn and looks whether each failure is told and nothing leaks. The
// OpenCL functions that create or release something are replaced by ones that count and pass on,
// since a leak checker cannot tell the library's leaks from those of the drivers.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "opencl/buffer.h"
#include "opencl/error.h"
#include "opencl/mapped_records.h"
#include "opencl/program.h"
#include "opencl/self_test.h"

namespace {

std::atomic<int> contexts{0}, queues{0}, memories{0}, mappings{0}, shared{0}, programs{0},
    kernels{0}, events{0};

const void* object_of(const void* address) {
  Dl_info info{};
  ::dladdr(address, &info);
  return info.dli_fbase;
}

// Whether the call comes from the library or from this program, which may hold inlined parts of it;
// drivers use these functions too.
bool is_ours(const void* caller) {
  const void* object = object_of(caller);
  return object == object_of(reinterpret_cast<const void*>(&ode_ext::opencl_error_name)) ||
         object == object_of(reinterpret_cast<const void*>(&is_ours));
}

bool succeeded(cl_int code) { return code == CL_SUCCESS; }
bool succeeded(const void* created) { return created != nullptr; }

struct Counting {
  std::atomic<int>& count;
  int change;
  const void* caller;
};

// Calls the OpenCL library's function and counts if that was for us and succeeded.
template <class Function, class... Args>
auto pass_on(Function original, const Counting& counting, Args... args) {
  const auto result = original(args...);
  if (succeeded(result) && is_ours(counting.caller)) counting.count += counting.change;
  return result;
}

}  // namespace

// The function of that name in the library behind this program.
#define NEXT(function) reinterpret_cast<decltype(&function)>(::dlsym(RTLD_NEXT, #function))

extern "C" {

cl_context clCreateContext(const cl_context_properties* properties, cl_uint count,
                           const cl_device_id* devices,
                           void(CL_CALLBACK* notify)(const char*, const void*, size_t, void*),
                           void* data, cl_int* code) {
  static const auto original = NEXT(clCreateContext);
  return pass_on(original, {contexts, +1, __builtin_return_address(0)}, properties, count, devices,
                 notify, data, code);
}

cl_command_queue clCreateCommandQueue(cl_context context, cl_device_id device,
                                      cl_command_queue_properties properties, cl_int* code) {
  static const auto original = NEXT(clCreateCommandQueue);
  return pass_on(original, {queues, +1, __builtin_return_address(0)}, context, device, properties,
                 code);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* host,
                      cl_int* code) {
  static const auto original = NEXT(clCreateBuffer);
  return pass_on(original, {memories, +1, __builtin_return_address(0)}, context, flags, size, host,
                 code);
}

void* clEnqueueMapBuffer(cl_command_queue queue, cl_mem memory, cl_bool blocking,
                         cl_map_flags flags, size_t offset, size_t size, cl_uint wait_count,
                         const cl_event* wait, cl_event* event, cl_int* code) {
  static const auto original = NEXT(clEnqueueMapBuffer);
  return pass_on(original, {mappings, +1, __builtin_return_address(0)}, queue, memory, blocking,
                 flags, offset, size, wait_count, wait, event, code);
}

void* clSVMAlloc(cl_context context, cl_svm_mem_flags flags, size_t size, cl_uint alignment) {
  static const auto original = NEXT(clSVMAlloc);
  return pass_on(original, {shared, +1, __builtin_return_address(0)}, context, flags, size,
                 alignment);
}

void clSVMFree(cl_context context, void* data) {
  static const auto original = NEXT(clSVMFree);
  original(context, data);
  if (is_ours(__builtin_return_address(0))) --shared;
}

cl_program clCreateProgramWithSource(cl_context context, cl_uint count, const char** texts,
                                     const size_t* sizes, cl_int* code) {
  static const auto original = NEXT(clCreateProgramWithSource);
  return pass_on(original, {programs, +1, __builtin_return_address(0)}, context, count, texts,
                 sizes, code);
}

cl_kernel clCreateKernel(cl_program program, const char* name, cl_int* code) {
  static const auto original = NEXT(clCreateKernel);
  return pass_on(original, {kernels, +1, __builtin_return_address(0)}, program, name, code);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t* offset, const size_t* global, const size_t* local,
                              cl_uint wait_count, const cl_event* wait, cl_event* event) {
  static const auto original = NEXT(clEnqueueNDRangeKernel);
  return pass_on(original, {events, +1, __builtin_return_address(0)}, queue, kernel, dimensions,
                 offset, global, local, wait_count, wait, event);
}

cl_int clReleaseContext(cl_context context) {
  static const auto original = NEXT(clReleaseContext);
  return pass_on(original, {contexts, -1, __builtin_return_address(0)}, context);
}

cl_int clReleaseCommandQueue(cl_command_queue queue) {
  static const auto original = NEXT(clReleaseCommandQueue);
  return pass_on(original, {queues, -1, __builtin_return_address(0)}, queue);
}

cl_int clReleaseMemObject(cl_mem memory) {
  static const auto original = NEXT(clReleaseMemObject);
  return pass_on(original, {memories, -1, __builtin_return_address(0)}, memory);
}

cl_int clEnqueueUnmapMemObject(cl_command_queue queue, cl_mem memory, void* data,
                               cl_uint wait_count, const cl_event* wait, cl_event* event) {
  static const auto original = NEXT(clEnqueueUnmapMemObject);
  return pass_on(original, {mappings, -1, __builtin_return_address(0)}, queue, memory, data,
                 wait_count, wait, event);
}

cl_int clReleaseProgram(cl_program program) {
  static const auto original = NEXT(clReleaseProgram);
  return pass_on(original, {programs, -1, __builtin_return_address(0)}, program);
}

cl_int clReleaseKernel(cl_kernel kernel) {
  static const auto original = NEXT(clReleaseKernel);
  return pass_on(original, {kernels, -1, __builtin_return_address(0)}, kernel);
}

cl_int clReleaseEvent(cl_event event) {
  static const auto original = NEXT(clReleaseEvent);
  return pass_on(original, {events, -1, __builtin_return_address(0)}, event);
}

}  // extern "C"

namespace ode_ext {
namespace {

constexpr const char* kTwoKernels = R"(
__kernel void twice(__global const uint* in, __global uint* out) {
  const uint i = (uint)get_global_id(0);
  out[i] = 2u * in[i];
}
// Long enough (some 100 ms) that nobody has waited for it by accident.
__kernel void slow(__global uint* out) {
  uint x = 1u;
  for (uint i = 0u; i < 100000000u; ++i) x = x * 1664525u + (x >> 16);
  out[get_global_id(0)] = x | 1u;
}
)";

// One of everything the room offers. The host memory goes before the device does.
std::vector<std::uint32_t> scenario() {
  std::vector<std::uint32_t> result;
  {
    Device device("");
    std::vector<std::uint32_t> in(256), out(256);
    std::iota(in.begin(), in.end(), 0u);
    Program program(device, kTwoKernels, "");
    Kernel kernel(program, "twice");
    Buffer source(device, Memory::kShared), target(device);
    PinnedMemory pinned(device);
    source.reserve(4 * in.size());
    source.reserve(8192);
    target.reserve(4 * out.size());
    pinned.reserve(4 * out.size());
    pinned.reserve(8192);
    source.write(in.data(), 4 * in.size());
    target.fill_zero(4 * out.size());
    for (int i = 0; i < 3; ++i) kernel.launch(4, 64, source, target);
    target.read(pinned.data(), 4 * out.size());
    target.read(out.data(), 4 * out.size());
    device.finish();
    kernel.take_milliseconds();
    kernel.launch(4, 64, source, target);
    device.finish();
    kernel.launch(4, 64, source, target);
    device.finish();
    kernel.take_milliseconds();  // tells of clocks that could not be read before
    kernel.launch(4, 64, source, target);
    source.release();  // while it is in use
    device.finish();
    source.extend(1);
    source.extend(8192);
    HostView view(device);
    view.reserve(target, 4 * out.size());
    for (const Memory memory : {Memory::kDevice, Memory::kShared}) {
      Buffer written(device, memory), dropped(device, memory);
      MappedRecords<std::uint32_t> records(written, 0, in.size()), unused(dropped, 0, 1);
      device.finish();
      for (const std::uint32_t number : in) records.push_back(number);
      records.close();
      kernel.launch(4, 64, written, target);
      view.read(target, 4 * out.size());
      device.finish();
      if (std::memcmp(view.data(), out.data(), 4 * out.size()) != 0) out.clear();
    }
    kernel.take_milliseconds();
    result = out;
  }
  return result;
}

std::vector<int> live() {
  return {contexts, queues, memories, mappings, shared, programs, kernels, events};
}

std::vector<std::uint32_t> even_numbers() {
  std::vector<std::uint32_t> numbers(256);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint32_t>(2 * i);
  return numbers;
}

TEST(Handles, AreCountedAndAllGivenBack) {
  const std::vector<int> before = live();
  {
    Device device("");
    Buffer buffer(device), shared_buffer(device, Memory::kShared);
    PinnedMemory pinned(device);
    buffer.reserve(1);
    shared_buffer.reserve(1);
    pinned.reserve(1);
    Program program(device, kTwoKernels, "");
    Kernel kernel(program, "twice");
    kernel.launch(1, 1, buffer, buffer);
    std::vector<int> during = before;
    const int created[] = {1, 1, 3, 1, device.info().shares_memory ? 1 : 0, 1, 1, 1};
    for (std::size_t i = 0; i < during.size(); ++i) during[i] += created[i];
    EXPECT_EQ(live(), during) << "the counting functions are not the ones that are called";
  }
  EXPECT_EQ(live(), before);
}

// Fails call after call until `action` makes fewer calls than that, and returns how many it made.
// (How many can vary: a launch looks whether earlier ones have finished.)
template <class Action>
long long fail_each_call(int code, const Action& action) {
  const std::vector<int> before = live();
  for (long long nth = 1;; ++nth) {
    fault_injector::arm(nth, code);
    try {
      action();
      EXPECT_LT(fault_injector::calls_checked(), nth) << "a failure was not told";
      fault_injector::disarm();
      return nth - 1;
    } catch (const DeviceError& error) {
      const std::string expected = std::string(" failed with ") + opencl_error_name(code);
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
    EXPECT_EQ(live(), before) << "after the failure of call " << nth;
  }
}

TEST(Faults, AreToldWhicheverCallFailsAndLeakNothing) {
  const std::vector<int> before = live();
  EXPECT_GT(fail_each_call(CL_OUT_OF_RESOURCES, [] { EXPECT_EQ(scenario(), even_numbers()); }), 40);
  EXPECT_EQ(scenario(), even_numbers());
  EXPECT_EQ(live(), before);
}

TEST(Faults, AreThrownOnlyWhenTheDeviceNoLongerTouchesHostMemory) {
  Device device("");
  Program program(device, kTwoKernels, "");
  Kernel kernel(program, "slow");
  Buffer buffer(device);
  buffer.reserve(4);
  std::uint32_t number = 0;
  kernel.launch(1, 1, buffer);
  buffer.read(&number, 4);
  fault_injector::arm(1, CL_OUT_OF_RESOURCES);
  EXPECT_THROW(buffer.fill_zero(4), DeviceError);
  fault_injector::disarm();
  EXPECT_NE(number, 0u) << "still to be written when the exception came";
}

TEST(Faults, OfTheSelfTestAreToldAndLeakNothing) {
  for (const bool may_share : {false, true}) {
    Device device("", 0, may_share);
    Program program(device, "");
    const long long failures = fail_each_call(CL_OUT_OF_HOST_MEMORY, [&] { self_test(program); });
    EXPECT_GT(failures, device.info().shares_memory ? 7 : 10);  // five transfers need no calls
    EXPECT_NO_THROW(self_test(program));
  }
}

}  // namespace
}  // namespace ode_ext
