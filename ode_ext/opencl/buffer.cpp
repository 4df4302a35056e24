// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/buffer.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <string>
#include <utility>

#include "opencl/error.h"

namespace ode_ext {
namespace {

constexpr std::size_t kPage = 4096;  // [bytes]

// What to take when `bytes` are needed and `old_capacity` was too little: see Buffer::reserve.
std::size_t grown_capacity(Device& device, std::size_t bytes, std::size_t old_capacity) {
  const std::size_t largest = static_cast<std::size_t>(device.info().largest_buffer);
  if (bytes > largest) {
    device.settle();
    throw DeviceError(CL_INVALID_BUFFER_SIZE,
                      "A buffer of " + std::to_string(bytes) + " bytes is needed, and " +
                          device.label() + " takes at most " + std::to_string(largest) +
                          " bytes in one. Ask for fewer contacts, make the scene smaller, or "
                          "choose another device with ODE_EXT_DEVICE.");
  }
  const std::size_t wanted = std::max(bytes, old_capacity + old_capacity / 2);
  const std::size_t pages = std::max<std::size_t>(1, wanted / kPage + (wanted % kPage != 0));
  return std::min(pages * kPage, largest);
}

MemoryHandle create_memory(Device& device, cl_mem_flags flags, std::size_t size,
                           void* host = nullptr) {
  cl_int code = CL_SUCCESS;
  MemoryHandle memory(clCreateBuffer(device.context(), flags, size, host, &code));
  device.check_call(code, "clCreateBuffer",
                    [&] { return "Asked for: " + std::to_string(size) + " bytes."; });
  return memory;
}

// Null: there is none to be had, but there may be room for a buffer like any other.
SharedHandle create_shared_memory(Device& device, std::size_t size) {
  return SharedHandle(
      clSVMAlloc(device.context(), CL_MEM_READ_WRITE | CL_MEM_SVM_FINE_GRAIN_BUFFER, size, 0),
      {&device});
}

}  // namespace

void SharedMemoryReleaser::operator()(void* data) const {
  // clEnqueueSVMFree would not wait, but PoCL before 3.1 frees what it finds where `data` was.
  if (!device->is_idle()) device->settle();
  if (device->is_idle()) clSVMFree(device->context(), data);  // else something may still use it
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_),
      is_shared_(other.is_shared_),
      shared_(std::move(other.shared_)),
      memory_(std::move(other.memory_)),
      id_(other.id_),
      capacity_(std::exchange(other.capacity_, 0)) {}

void Buffer::create(std::size_t size) {
  static std::atomic<std::uint64_t> count{0};
  SharedHandle shared;
  if (is_shared_) shared = create_shared_memory(*device_, size);
  const cl_mem_flags where = shared ? CL_MEM_USE_HOST_PTR : 0;
  memory_ = create_memory(*device_, CL_MEM_READ_WRITE | where, size, shared.get());
  shared_ = std::move(shared);
  id_ = ++count;
  capacity_ = size;
}

unsigned char* Buffer::within_reach(std::size_t bytes, std::size_t offset) const {
  const bool is_there = offset <= capacity_ && bytes <= capacity_ - offset;  // else OpenCL refuses
  if (!shared_ || !device_->is_idle() || !is_there) return nullptr;
  return static_cast<unsigned char*>(shared_.get()) + offset;
}

bool Buffer::grow(std::size_t bytes, std::size_t kept) {
  if (capacity_ > 0 && bytes <= capacity_) return false;
  const std::size_t old_capacity = std::exchange(capacity_, 0);
  SharedHandle old_shared = std::move(shared_);
  MemoryHandle old = std::move(memory_);  // OpenCL keeps it for the commands that need it
  if (kept == 0) {                        // first, so that old and new never need room at once
    old.reset();
    old_shared.reset();
  }
  create(grown_capacity(*device_, bytes, old_capacity));
  if (kept == 0) return true;
  try {
    copy_from(old_shared.get(), old.get(), kept);
  } catch (const DeviceError&) {
    release();
    throw;
  }
  return true;
}

void Buffer::copy_from(const void* old_shared, cl_mem old, std::size_t bytes) {
  unsigned char* target = within_reach(bytes, 0);
  if (target != nullptr && old_shared != nullptr) {
    std::memcpy(target, old_shared, bytes);
    return;
  }
  device_->check_call(
      clEnqueueCopyBuffer(device_->queue(), old, memory_.get(), 0, 0, bytes, 0, nullptr, nullptr),
      "clEnqueueCopyBuffer");
}

void Buffer::reserve(std::size_t bytes) { grow(bytes, 0); }

void Buffer::extend(std::size_t bytes) {
  const std::size_t kept = capacity_;
  if (!grow(bytes, kept)) return;
  try {
    fill_zero(capacity_ - kept, kept);
  } catch (const DeviceError&) {
    release();
    throw;
  }
}

void Buffer::write(const void* source, std::size_t bytes, std::size_t offset) {
  if (bytes == 0) return;
  if (unsigned char* target = within_reach(bytes, offset)) {
    std::memcpy(target, source, bytes);
    return;
  }
  device_->check_call(clEnqueueWriteBuffer(device_->queue(), memory_.get(), CL_FALSE, offset, bytes,
                                           source, 0, nullptr, nullptr),
                      "clEnqueueWriteBuffer");
}

void Buffer::fill_zero(std::size_t bytes, std::size_t offset) {
  if (bytes == 0) return;
  if (unsigned char* target = within_reach(bytes, offset)) {
    std::memset(target, 0, bytes);
    return;
  }
  const cl_uint zero = 0;
  // Size and offset must be multiples of the pattern.
  const std::size_t pattern = (bytes | offset) % sizeof(zero) == 0 ? sizeof(zero) : 1;
  device_->check_call(clEnqueueFillBuffer(device_->queue(), memory_.get(), &zero, pattern, offset,
                                          bytes, 0, nullptr, nullptr),
                      "clEnqueueFillBuffer");
}

void* Buffer::map_after(std::size_t kept, std::size_t bytes) {
  const std::size_t end = kept + bytes;
  if (end > capacity_ || capacity_ == 0) {
    const std::size_t largest = static_cast<std::size_t>(device_->info().largest_buffer);
    const std::size_t spare = is_shared_ ? end / 8 : 0;
    grow(std::max(end, std::min(end + spare, largest)), kept);
  }
  if (bytes == 0) return nullptr;
  if (shared_) return static_cast<unsigned char*>(shared_.get()) + kept;
  cl_int code = CL_SUCCESS;
  void* mapped =
      clEnqueueMapBuffer(device_->queue(), memory_.get(), CL_FALSE, CL_MAP_WRITE_INVALIDATE_REGION,
                         kept, bytes, 0, nullptr, nullptr, &code);
  try {
    device_->check_call(code, "clEnqueueMapBuffer");
  } catch (const DeviceError&) {
    unmap(mapped);
    throw;
  }
  return mapped;
}

int Buffer::enqueue_unmap(void* mapped) {
  if (mapped == nullptr || shared_) return CL_SUCCESS;
  return clEnqueueUnmapMemObject(device_->queue(), memory_.get(), mapped, 0, nullptr, nullptr);
}

// What stays mapped is not to be used again.
void Buffer::unmap(void* mapped) noexcept {
  if (enqueue_unmap(mapped) != CL_SUCCESS) release();
}

void Buffer::close(void* mapped) {
  try {
    device_->check_call(enqueue_unmap(mapped), "clEnqueueUnmapMemObject");
  } catch (const DeviceError&) {
    release();
    throw;
  }
}

void Buffer::read(void* target, std::size_t bytes, std::size_t offset) const {
  if (bytes == 0) return;
  device_->check_call(clEnqueueReadBuffer(device_->queue(), memory_.get(), CL_FALSE, offset, bytes,
                                          target, 0, nullptr, nullptr),
                      "clEnqueueReadBuffer");
}

PinnedMemory::~PinnedMemory() { release(); }

void PinnedMemory::reserve(std::size_t bytes) {
  if (capacity_ > 0 && bytes <= capacity_) return;
  const std::size_t old_capacity = capacity_;
  release();
  const std::size_t size = grown_capacity(*device_, bytes, old_capacity);
  memory_ = create_memory(*device_, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, size);
  cl_int code = CL_SUCCESS;
  device_->count_synchronization();
  data_ = clEnqueueMapBuffer(device_->queue(), memory_.get(), CL_TRUE, CL_MAP_READ | CL_MAP_WRITE,
                             0, size, 0, nullptr, nullptr, &code);
  try {
    device_->check_call(code, "clEnqueueMapBuffer");
  } catch (const DeviceError&) {
    release();
    throw;
  }
  capacity_ = size;
}

void PinnedMemory::release() {
  // The queue is in order: transfers to and from this memory end before the unmapping, and OpenCL
  // keeps the memory until that has been done.
  if (data_) {
    clEnqueueUnmapMemObject(device_->queue(), memory_.get(), data_, 0, nullptr, nullptr);
  }
  data_ = nullptr;
  memory_.reset();
  capacity_ = 0;
}

}  // namespace ode_ext
