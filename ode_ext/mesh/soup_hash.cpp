// SPDX-License-Identifier: BSD-3-Clause
// Detects accidents, not attacks: every round is a bijection of the state for a given word and of
// the word for a given state, so soups of equal length that differ within one 8-byte word always
// have different hashes, and others the same by chance, 1 in 2^64. Whoever wants collisions can
// make them, so that a hash only says where to look: what is found there has to be compared.
// Raw bits count: -0 and +0 are different soups here, though they weld together.
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "mesh/mesh.h"

namespace ode_ext {
namespace {

// Odd, so that multiplying by them loses nothing, and without pattern: the fractions of the golden
// ratio and of sqrt(2), times 2^64, with the lowest bit set.
constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;
constexpr std::uint64_t kRoot2 = 0x6a09e667f3bcc909;

constexpr std::size_t kWord = sizeof(std::uint64_t);
constexpr std::size_t kLanes = 4;  // independent, so that multiplications overlap

// Multiplication carries upwards only; the shift brings the result down again.
std::uint64_t mix(std::uint64_t word) {
  word *= kGolden;
  word ^= word >> 32;
  return word * kRoot2;
}

std::uint64_t absorb(std::uint64_t lane, std::uint64_t word) {
  return std::rotl(lane ^ mix(word), 29) * kGolden;
}

std::uint64_t load(const unsigned char* bytes, std::size_t count = kWord) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, count);
  return word;
}

}  // namespace

std::uint64_t hash_soup(const Vec3f* corners, std::size_t corner_count) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(corners);
  std::size_t left = corner_count * sizeof(Vec3f);
  std::array<std::uint64_t, kLanes> lanes{kGolden, kRoot2, ~kGolden, ~kRoot2};
  for (; left >= kLanes * kWord; left -= kLanes * kWord, bytes += kLanes * kWord) {
    for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = absorb(lanes[i], load(bytes + i * kWord));
  }
  std::uint64_t hash = corner_count;  // the length counts
  for (const std::uint64_t lane : lanes) hash = absorb(hash, lane);
  for (; left >= kWord; left -= kWord, bytes += kWord) hash = absorb(hash, load(bytes));
  if (left > 0) hash = absorb(hash, load(bytes, left));
  return mix(hash) ^ mix(hash) >> 32;
}

int compare_soups(const TriangleSoup& a, const TriangleSoup& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.empty() ? 0 : std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3f));
}

}  // namespace ode_ext
