// SPDX-License-Identifier: BSD-3-Clause
// Device memory that grows, host memory for transfers that do not block, and what the host reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "opencl/device.h"

namespace ode_ext {

// Where a buffer is best kept.
enum class Memory {
  kDevice,
  // Where device and host both reach it, if they share memory: of what goes to and fro in each
  // pass, or is written in place. A command takes some 10 us, which for a single pair is a tenth of
  // all. What a device has no room for there is kept as any other.
  kShared,
};

// Frees memory of clSVMAlloc once all that has been enqueued is done.
struct SharedMemoryReleaser {
  Device* device = nullptr;
  void operator()(void* data) const;
};
using SharedHandle = std::unique_ptr<void, SharedMemoryReleaser>;

class Buffer {
 public:
  explicit Buffer(Device& device, Memory memory = Memory::kDevice)
      : device_(&device), is_shared_(memory == Memory::kShared && device.info().shares_memory) {}
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
    shared_.reset();
  }
  std::size_t capacity() const { return capacity_; }  // [bytes]
  cl_mem get() const { return memory_.get(); }
  // Of its memory; no two have one, in a process. 0: it has none.
  std::uint64_t id() const { return memory_ ? id_ : 0; }
  // Its contents, after Device::finish(), where it is shared; else null.
  const void* shared() const { return shared_.get(); }

  // The transfers do nothing for 0 bytes. Host memory given to them must live until
  // Device::finish() has returned, any call on the device has thrown DeviceError, or the Device is
  // gone. PinnedMemory sees to that by itself. While the device is idle, shared buffers are written
  // at once.

  // Enqueued, not waited for: `source` must stay as it is until the queue has passed it.
  void write(const void* source, std::size_t bytes, std::size_t offset = 0);
  void fill_zero(std::size_t bytes, std::size_t offset = 0);
  // Room for all of them and write().
  template <class T>
  void upload(const std::vector<T>& records) {
    reserve(records.size() * sizeof(T));
    write(records.data(), records.size() * sizeof(T));
  }
  // Room for `bytes` after the first `kept`, which stay, to be written in place
  // (opencl/mapped_records.h) once the device is idle. Of memory that is shared, which counts once
  // it is touched, it takes an eighth more, so that what comes next needs no copy of what is kept.
  // Null for no bytes.
  void* map_after(std::size_t kept, std::size_t bytes);
  // Enqueued: the end of that. Null is let pass. The first never throws. Where it fails the buffer
  // is empty then.
  void unmap(void* mapped) noexcept;
  void close(void* mapped);
  // Enqueued, not waited for: valid after Device::finish().
  void read(void* target, std::size_t bytes, std::size_t offset = 0) const;

 private:
  Device* device_;
  // As reserve(), but the first `kept` bytes stay. Returns whether it grew.
  bool grow(std::size_t bytes, std::size_t kept);
  void create(std::size_t size);
  void copy_from(const void* old_shared, cl_mem old, std::size_t bytes);
  int enqueue_unmap(void* mapped);
  // Where the host may write at once; null: it has to enqueue.
  unsigned char* within_reach(std::size_t bytes, std::size_t offset) const;

  bool is_shared_ = false;
  SharedHandle shared_;  // goes after memory_, which lies in it
  MemoryHandle memory_;
  std::uint64_t id_ = 0;
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

// What the host reads of a buffer: the buffer itself where that is shared, else a copy.
class HostView {
 public:
  explicit HostView(Device& device) : copy_(device) {}

  // Room for so much of `buffer`; waits for the queue if a copy grows.
  void reserve(const Buffer& buffer, std::size_t bytes) {
    if (buffer.shared() == nullptr) copy_.reserve(bytes);
  }
  // Enqueued, not waited for, into what has been reserved: at data() after Device::finish(), until
  // the buffer is next written to or grows.
  void read(const Buffer& buffer, std::size_t bytes) {
    data_ = buffer.shared();
    if (data_ != nullptr) return;
    data_ = copy_.data();
    buffer.read(copy_.data(), bytes);
  }
  const void* data() const { return data_; }

 private:
  PinnedMemory copy_;
  const void* data_ = nullptr;
};

}  // namespace ode_ext
