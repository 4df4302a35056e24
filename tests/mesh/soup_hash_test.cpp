// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <set>

#include "shapes.h"

namespace ode_ext {
namespace {

std::uint64_t hash(const TriangleSoup& soup) { return hash_soup(soup.data(), soup.size()); }

void flip(TriangleSoup& soup, std::size_t bit) {
  float& value = soup[bit / 96][bit / 32 % 3];
  value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1u << bit % 32);
}

TEST(SoupHash, ChangesWithEveryBit) {
  for (std::size_t corners = 1; corners <= 21; ++corners) {
    TriangleSoup soup = shapes::random_soup(7, 31);
    soup.resize(corners);
    std::set<std::uint64_t> hashes{hash(soup)};
    for (std::size_t bit = 0; bit < 96 * corners; ++bit) {
      flip(soup, bit);
      EXPECT_TRUE(hashes.insert(hash(soup)).second) << corners << " corners, bit " << bit;
      flip(soup, bit);
    }
  }
}

TEST(SoupHash, ChangesWithEveryPairOfBits) {
  TriangleSoup soup = shapes::random_soup(2, 32);
  std::set<std::uint64_t> hashes{hash(soup)};
  const std::size_t bits = 96 * soup.size();
  for (std::size_t i = 0; i < bits; ++i) {
    flip(soup, i);
    for (std::size_t j = 0; j < i; ++j) {
      flip(soup, j);
      ASSERT_TRUE(hashes.insert(hash(soup)).second) << i << " " << j;
      flip(soup, j);
    }
    flip(soup, i);
  }
}

TEST(SoupHash, SpreadsEveryBitOverHalfTheHash) {
  TriangleSoup soup = shapes::random_soup(5, 33);
  const std::uint64_t before = hash(soup);
  double changed = 0;
  const std::size_t bits = 96 * soup.size();
  for (std::size_t bit = 0; bit < bits; ++bit) {
    flip(soup, bit);
    const int count = std::popcount(before ^ hash(soup));
    EXPECT_GT(count, 8) << bit;  // 64 fair coins show 8 heads or fewer once in 3e9
    changed += count;
    flip(soup, bit);
  }
  EXPECT_NEAR(changed / static_cast<double>(bits), 32, 1);
}

TEST(SoupHash, TellsLengthsApart) {
  std::set<std::uint64_t> hashes;
  for (std::size_t corners = 0; corners < 100; ++corners) {
    EXPECT_TRUE(hashes.insert(hash(TriangleSoup(corners))).second) << corners;
  }
}

TEST(SoupHash, SeesTrianglesThatSwapPlaces) {
  const TriangleSoup soup = shapes::random_soup(40, 34);
  std::set<std::uint64_t> hashes{hash(soup)};
  for (std::size_t i = 0; i < 40; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      TriangleSoup swapped = soup;
      for (std::size_t k = 0; k < 3; ++k) std::swap(swapped[3 * i + k], swapped[3 * j + k]);
      EXPECT_TRUE(hashes.insert(hash(swapped)).second);
    }
  }
}

TEST(SoupHash, IsWhatTheMeshStores) {
  for (const TriangleSoup& soup :
       {TriangleSoup{}, shapes::cube(), TriangleSoup{{NAN, 0, 0}, {1, 0, 0}, {0, 1, 0}}}) {
    EXPECT_EQ(build_mesh(soup).content_hash, hash(soup));
  }
}

RC_GTEST_PROP(SoupHashProperty, DependsOnNothingButTheCorners, (std::vector<float> values)) {
  TriangleSoup soup;
  for (const float value : values) soup.push_back({value, -value, 0.5f * value});
  const std::uint64_t expected = hash(soup);
  TriangleSoup shifted(1);  // elsewhere in memory
  shifted.insert(shifted.end(), soup.begin(), soup.end());
  RC_ASSERT(hash_soup(shifted.data() + 1, soup.size()) == expected);
}

}  // namespace
}  // namespace ode_ext
