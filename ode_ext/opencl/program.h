// SPDX-License-Identifier: BSD-3-Clause
// The embedded kernels, built for a device, and their launches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <type_traits>
#include <vector>

#include "opencl/buffer.h"
#include "opencl/device.h"

namespace ode_ext {

// Of the widths that lib/lanes.h knows the widest that the device takes at once.
unsigned suitable_vector_width(const DeviceInfo& device);

// Options for those that a work-group goes through together (kernels/lib/group.h) as a program of
// their own, and for all others where they are.
inline constexpr const char* kLanesAreGroup = "-DOX_LANES_ARE_GROUP";
inline constexpr const char* kGroupsApart = "-DOX_GROUPS_APART";

class Program {
 public:
  // Builds all files of kernels/ (headers first, then *.cl, each preceded by a #line that names it)
  // as one program with "-cl-std=CL1.2" and `options`, quotients and roots rounded correctly where
  // the device can; those of kernels/paper/ only where these define OX_PAPER, those of groups or
  // all others where they say so (above); where they do not name OX_VECTOR_WIDTH, with that which
  // suits the device (lib/lanes.h). Throws DeviceError with device, driver, options and build log.
  Program(Device& device, const std::string& options);
  // The same with `source` instead, for tests and tools.
  Program(Device& device, const std::string& source, const std::string& options);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  cl_program get() const { return program_.get(); }
  Device& device() const { return *device_; }

 private:
  Device* device_;
  ProgramHandle program_;
};

// The embedded files as one source text, in their order. Lines that begin with `#include "` are
// blank there: they are for editors and offline checks, and what they name comes earlier in the
// text.
std::string embedded_source();

class Kernel {
 public:
  Kernel(Program& program, const char* name);
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  // Enqueues `groups` work-groups of `local` work-items; nothing if groups is 0. Arguments are
  // Buffers or trivially copyable values of the kernel's parameter types; those that are as they
  // were are not set again.
  template <class... Args>
  void launch(std::size_t groups, std::size_t local, const Args&... args) {
    cl_uint index = 0;
    (set_argument(index++, args), ...);
    enqueue(groups, local);
  }

  // Device time of the launches since the last call [ms]; call after Device::finish(). Programs
  // that never ask pay nothing for it: what has finished is added up whenever the list of events is
  // full.
  double take_milliseconds();
  const std::string& name() const { return name_; }

 private:
  template <class T>
  void set_argument(cl_uint index, const T& value) {
    if constexpr (std::is_same_v<T, Buffer>) {
      const cl_mem memory = value.get();
      set_argument_bytes(index, sizeof(cl_mem), &memory, value.id());
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      set_argument_bytes(index, sizeof(T), &value, 0);
    }
  }
  // buffer: of a Buffer its id, since one that is gone may lend its handle to the next.
  void set_argument_bytes(cl_uint index, std::size_t bytes, const void* value,
                          std::uint64_t buffer);
  void enqueue(std::size_t groups, std::size_t local);
  void add_up_finished();

  Device* device_;
  KernelHandle kernel_;
  std::string name_;
  struct Argument {
    std::uint64_t buffer = 0;
    std::size_t bytes = 0;  // 0: it is not known what the driver has
    std::array<std::byte, 32> value{};
  };
  std::vector<Argument> arguments_;  // as they were last set
  std::vector<EventHandle> events_;  // of launches not yet in milliseconds_, oldest first
  double milliseconds_ = 0;
  std::exception_ptr clock_failure_;  // told by take_milliseconds
};

struct SelfTestReport {
  bool keeps_denormals = false;  // OpenCL leaves it open in fp32, and nothing here may depend on it
};

// Runs kernels/self_test.cl once: contraction off is honoured, fma is exact, comparisons with NaN
// and infinity behave, atomic counters count. Throws DeviceError with a sentence on failure.
SelfTestReport self_test(Program& program);

// Runs kernels/self_test_group.cl once: whether the `items` of a work-group hand values on as
// kernels/lib/group.h says. Throws DeviceError with a sentence where they do not.
void self_test_groups(Program& of_groups, std::uint32_t items);

}  // namespace ode_ext
