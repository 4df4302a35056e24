// SPDX-License-Identifier: BSD-3-Clause
// Records written into a buffer in place: where device memory is the host's there is no copy of
// them.
#pragma once

#include <cassert>
#include <cstddef>
#include <utility>

#include "opencl/buffer.h"

namespace ode_ext {

template <class T>
class MappedRecords {
 public:
  // Room for `more` records after the first `kept`, which stay. To be written once the device is
  // idle.
  MappedRecords(Buffer& buffer, std::size_t kept, std::size_t more)
      : buffer_(buffer),
        kept_(kept),
        most_(kept + more),
        size_(kept),
        records_(static_cast<T*>(buffer.map_after(kept * sizeof(T), more * sizeof(T)))) {}
  ~MappedRecords() {  // without close(): nobody needs them any more
    if (records_ != nullptr) buffer_.unmap(std::exchange(records_, nullptr));
  }
  MappedRecords(const MappedRecords&) = delete;
  MappedRecords& operator=(const MappedRecords&) = delete;

  void push_back(const T& record) {
    assert(size_ < most_);
    records_[size_++ - kept_] = record;
  }
  std::size_t size() const { return size_; }  // with those kept

  // Enqueued: the records are there for what is enqueued after it. Throws DeviceError.
  void close() { buffer_.close(std::exchange(records_, nullptr)); }

 private:
  Buffer& buffer_;
  std::size_t kept_, most_, size_;
  T* records_;
};

}  // namespace ode_ext
