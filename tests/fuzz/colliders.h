// SPDX-License-Identifier: BSD-3-Clause
// The colliders that a fuzzed program uses. Making one takes as long as a hundred programs do, so
// some are kept from program to program: what they answer must not depend on what came before.
#pragma once

#include <ode_ext/ode_ext.h>

#include <array>
#include <string>

#include "fuzz/byte_source.h"

namespace ode_ext::fuzz {

struct Collider {
  dBatchColliderID id = nullptr;
  bool complete = true;  // it promises to overlook nothing, and to notice every change
  // The answers of all these are the same, byte for byte.
  bool alike = true;
};

class Colliders {
 public:
  static constexpr std::size_t kKept = 4;

  Colliders() = default;
  ~Colliders() { renew(); }
  Colliders(const Colliders&) = delete;
  Colliders& operator=(const Colliders&) = delete;

  // One of the kept ones, made where it is not there. Throws std::runtime_error without a device.
  const Collider& kept(std::size_t index);
  // Destroys them all; the next ones know nothing.
  void renew();

 private:
  std::array<Collider, kKept> kept_;
};

// A collider with parameters from the bytes, good or bad; id is null where it was refused.
Collider decode_collider(ByteSource& bytes);

}  // namespace ode_ext::fuzz
