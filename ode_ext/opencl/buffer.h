// SPDX-License-Identifier: BSD-3-Clause
// Device memory that grows, and pinned host memory for transfers that do not block.
#pragma once

#include <cstddef>

#include "opencl/device.h"

namespace ode_ext {

class Buffer {
 public:
  explicit Buffer(Device& device) : device_(&device) {}
  Buffer(Buffer&& other) noexcept;  // leaves `other` empty
  Buffer& operator=(Buffer&&) = delete;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  // Room for at least `bytes`; contents are lost if it grows, and commands already enqueued keep
  // the old memory. Takes at least half as much again as it had, in whole pages of 4 KiB (so never
  // 0 bytes), as far as the device's largest buffer allows; never shrinks. Throws DeviceError; the
  // buffer then is empty (capacity 0), not half grown.
  void reserve(std::size_t bytes);
  // The same, but what was in it stays, and all that is new is 0. Old and new need room at once.
  void extend(std::size_t bytes);
  // Gives the memory back; commands already enqueued keep it until they are done.
  void release() {
    capacity_ = 0;
    memory_.reset();
  }
  std::size_t capacity() const { return capacity_; }  // [bytes]
  cl_mem get() const { return memory_.get(); }

  // The transfers do nothing for 0 bytes. Host memory given to them must live until
  // Device::finish() has returned, any call on the device has thrown DeviceError, or the Device is
  // gone. PinnedMemory sees to that by itself.

  // Enqueued, not waited for: `source` must stay as it is until the queue has passed it.
  void write(const void* source, std::size_t bytes, std::size_t offset = 0);
  void fill_zero(std::size_t bytes, std::size_t offset = 0);
  // Enqueued, not waited for: valid after Device::finish().
  void read(void* target, std::size_t bytes, std::size_t offset = 0) const;

 private:
  Device* device_;
  MemoryHandle memory_;
  std::size_t capacity_ = 0;
};

// Host memory the device copies to and from without blocking (CL_MEM_ALLOC_HOST_PTR, kept mapped).
class PinnedMemory {
 public:
  explicit PinnedMemory(Device& device) : device_(&device) {}
  ~PinnedMemory();
  PinnedMemory(const PinnedMemory&) = delete;
  PinnedMemory& operator=(const PinnedMemory&) = delete;

  // As Buffer::reserve; waits for the queue if it grows (one synchronization).
  void reserve(std::size_t bytes);
  std::size_t capacity() const { return capacity_; }  // [bytes]
  void* data() const { return data_; }                // null while the capacity is 0

 private:
  void release();

  Device* device_;
  MemoryHandle memory_;
  void* data_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace ode_ext
