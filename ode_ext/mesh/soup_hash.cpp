// SPDX-License-Identifier: BSD-3-Clause
// Detects accidents, not attacks: every round is a bijection of the state for a given word and of
// the word for a given state, so soups of equal length that differ within one 8-byte word always
// have different hashes, and others the same by chance, 1 in 2^64. Whoever wants collisions can
// make them, so that a hash only says where to look: what is found there has to be compared.
// Raw bits count: -0 and +0 are different soups here, though they weld together.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "mesh/source_triangles.h"

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

// Piece by piece; all but the last are of whole blocks.
class SoupHash {
 public:
  void add(const Vec3f* corners, std::size_t count) {
    corner_count_ += count;
    const auto* bytes = reinterpret_cast<const unsigned char*>(corners);
    std::size_t left = count * sizeof(Vec3f);
    for (; left >= kBlock; left -= kBlock, bytes += kBlock) {
      for (std::size_t i = 0; i < kLanes; ++i)
        lanes_[i] = absorb(lanes_[i], load(bytes + i * kWord));
    }
    std::memcpy(rest_.data(), bytes, left);
    rest_size_ = left;
  }

  std::uint64_t get() const {
    std::uint64_t hash = corner_count_;  // the length counts
    for (const std::uint64_t lane : lanes_) hash = absorb(hash, lane);
    const unsigned char* bytes = rest_.data();
    std::size_t left = rest_size_;
    for (; left >= kWord; left -= kWord, bytes += kWord) hash = absorb(hash, load(bytes));
    if (left > 0) hash = absorb(hash, load(bytes, left));
    return mix(hash) ^ mix(hash) >> 32;
  }

 private:
  static constexpr std::size_t kBlock = kLanes * kWord;  // [bytes]

  std::array<std::uint64_t, kLanes> lanes_{kGolden, kRoot2, ~kGolden, ~kRoot2};
  std::array<unsigned char, kBlock> rest_{};
  std::size_t rest_size_ = 0;
  std::size_t corner_count_ = 0;
};

}  // namespace

std::uint64_t hash_soup(const Vec3f* corners, std::size_t corner_count) {
  SoupHash hash;
  if (corner_count != 0) hash.add(corners, corner_count);
  return hash.get();
}

std::uint64_t hash_soup(const SourceTriangles& source) {
  SoupHash hash;
  std::array<Vec3f, 128> piece;  // 48 blocks
  for (std::size_t first = 0; first < source.size(); first += piece.size()) {
    const std::size_t count = std::min(piece.size(), source.size() - first);
    for (std::size_t i = 0; i < count; ++i) piece[i] = source[first + i];
    hash.add(piece.data(), count);
  }
  return hash.get();
}

}  // namespace ode_ext
