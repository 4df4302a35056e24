// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of ode_ext/mesh/soup_hash.cpp, backwards: a soup is taken in by blocks of 32
// bytes, a word for each of four lanes, and given what a lane is and what it shall be there is a
// word that leads from one to the other.
#include "support/forged_meshes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ode_ext::test {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;
constexpr std::uint64_t kRoot2 = 0x6a09e667f3bcc909;
constexpr std::size_t kLanes = 4;
constexpr std::size_t kFloats = 8;  // of a block
using Lanes = std::array<std::uint64_t, kLanes>;

// Of an odd number, modulo 2^64; Newton's iteration doubles the bits that are right, 3 at first.
constexpr std::uint64_t inverse(std::uint64_t odd) {
  std::uint64_t x = odd;
  for (int i = 0; i < 5; ++i) x *= 2 - odd * x;
  return x;
}
static_assert(kGolden * inverse(kGolden) == 1 && kRoot2 * inverse(kRoot2) == 1);

std::uint64_t mix(std::uint64_t word) {
  word *= kGolden;
  word ^= word >> 32;
  return word * kRoot2;
}
std::uint64_t unmix(std::uint64_t word) {
  word *= inverse(kRoot2);
  word ^= word >> 32;
  return word * inverse(kGolden);
}
std::uint64_t absorb(std::uint64_t lane, std::uint64_t word) {
  return std::rotl(lane ^ mix(word), 29) * kGolden;
}
std::uint64_t word_between(std::uint64_t lane, std::uint64_t next) {
  return unmix(std::rotr(next * inverse(kGolden), 29) ^ lane);
}

Lanes lanes_after(const std::vector<float>& soup, std::size_t blocks) {
  Lanes lanes{kGolden, kRoot2, ~kGolden, ~kRoot2};
  for (std::size_t i = 0; i < blocks * kLanes; ++i) {
    std::uint64_t word;
    std::memcpy(&word, soup.data() + 2 * i, sizeof(word));
    lanes[i % kLanes] = absorb(lanes[i % kLanes], word);
  }
  return lanes;
}

}  // namespace

std::array<TestMesh, 2> cube_and_plate_of_one_hash() {
  const TestMesh cube = unshared(make_cube(1));
  TestMesh plate = unshared(make_box({0.2, 8, 8}));
  std::vector<float>& soup = plate.vertices;
  // Of 108 floats 13 blocks are 104; what is left is taken in after the lanes, and the same.
  const std::size_t blocks = soup.size() / kFloats, forged = (blocks - 1) * kFloats;
  std::copy(cube.vertices.begin() + static_cast<std::ptrdiff_t>(blocks * kFloats),
            cube.vertices.end(), soup.begin() + static_cast<std::ptrdiff_t>(blocks * kFloats));
  const Lanes wanted = lanes_after(cube.vertices, blocks);
  // The last block is what the ones before make it: tried until it is something like a place.
  Random random(1);
  const auto is_near = [](float x) { return std::fabs(x) <= 100; };  // false for NaN
  const auto first = soup.begin() + static_cast<std::ptrdiff_t>(forged);
  do {
    for (std::size_t i = forged - 2 * kFloats; i < forged - kFloats; ++i)
      soup[i] = static_cast<float>(random.uniform(-4, 4));
    const Lanes lanes = lanes_after(soup, blocks - 1);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::uint64_t word = word_between(lanes[i], wanted[i]);
      std::memcpy(soup.data() + forged + 2 * i, &word, sizeof(word));
    }
  } while (!std::all_of(first, first + kFloats, is_near));
  return {cube, plate};
}

}  // namespace ode_ext::test
