// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ode/ode.h>

#include <cstddef>

namespace ode_ext {

// Where a call for given pairs wants their contacts, and how many there were.
class PairOutput {
 public:
  // Contacts of pair i go to i * limit on; `counts` may be null.
  PairOutput(dContactGeom* contacts, int limit, int skip, int* counts)
      : contacts_(reinterpret_cast<unsigned char*>(contacts)),
        limit_(limit),
        skip_(skip),
        counts_(counts) {}

  int limit() const { return limit_; }
  int skip() const { return skip_; }
  dContactGeom* of(std::size_t pair) const {
    return reinterpret_cast<dContactGeom*>(contacts_ +
                                           static_cast<std::ptrdiff_t>(pair) * limit_ * skip_);
  }
  void note(std::size_t pair, int count) {
    if (counts_ != nullptr) counts_[pair] = count;
    total_ += count;
    colliding_ += count > 0;
  }
  int total() const { return total_; }
  long long colliding() const { return colliding_; }  // pairs

 private:
  unsigned char* contacts_;
  int limit_, skip_;
  int* counts_;
  int total_ = 0;
  long long colliding_ = 0;
};

}  // namespace ode_ext
