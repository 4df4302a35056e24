// SPDX-License-Identifier: BSD-3-Clause
// What contacts are of, and how those of the same two features are told apart.
#include "contacts/contact_features.h"

#include <gtest/gtest.h>

#include <vector>

#include "mesh/shapes.h"
#include "ode_ext/ode_ext.h"

namespace ode_ext {
namespace {

using Features = std::array<std::uint32_t, 2>;

std::vector<Features> numbered(const std::vector<Features>& given, const Mesh& a, const Mesh& b) {
  std::vector<Contact> contacts(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) contacts[i].features = given[i];
  number_repeats(contacts, a, b);
  std::vector<Features> features;
  for (const Contact& contact : contacts) features.push_back(contact.features);
  return features;
}

std::uint32_t vertex(std::uint64_t i) { return to_feature(FeatureKind::kVertex, i); }
std::uint32_t edge(std::uint64_t i) { return to_feature(FeatureKind::kEdge, i); }
std::uint32_t facet(std::uint64_t i) { return to_feature(FeatureKind::kFacet, i); }

// They reach the program as they are.
static_assert(kFeatureShift == dBatchFeatureShift);
static_assert(static_cast<int>(FeatureKind::kUnknown) == dBatchFeatureNone &&
              static_cast<int>(FeatureKind::kVertex) == dBatchFeatureVertex &&
              static_cast<int>(FeatureKind::kEdge) == dBatchFeatureEdge &&
              static_cast<int>(FeatureKind::kFacet) == dBatchFeatureFacet);

TEST(ContactFeatures, HaveTheirKindInTheTwoHighestBits) {
  EXPECT_EQ(vertex(5), 0x40000005u);
  EXPECT_EQ(edge(5), 0x80000005u);
  EXPECT_EQ(facet(5), 0xc0000005u);
  EXPECT_EQ(to_feature(FeatureKind::kUnknown, 5), 0u);
}

TEST(ContactFeatures, AreNotKnownWhereTheirNumberHasNoRoom) {
  EXPECT_EQ(facet((1u << 30) - 1), 0xffffffffu);
  EXPECT_EQ(facet(1u << 30), 0u);
  EXPECT_EQ(vertex(0xffffffffffffffffu), 0u);
}

class RepeatedFeatures : public ::testing::Test {
 protected:
  const Mesh a = build_mesh(shapes::cube()), b = build_mesh(shapes::box({0, 0, 0}, {2, 2, 2}));
};

TEST_F(RepeatedFeatures, AreLeftWhereNoTwoContactsAreOfTheSame) {
  const std::vector<Features> given{
      {edge(3), facet(1)}, {edge(3), facet(2)}, {facet(1), edge(3)}, {vertex(3), facet(1)}};
  EXPECT_EQ(numbered(given, a, b), given);
}

TEST_F(RepeatedFeatures, GetNumbersBeyondAllFeaturesInTheOrderOfTheContacts) {
  ASSERT_EQ(a.topology->edges.size(), 12u);
  ASSERT_EQ(b.topology->triangles.size(), 12u);
  const Features once{edge(3), facet(1)}, other{vertex(0), facet(1)};
  EXPECT_EQ(numbered({once, other, once, once}, a, b),
            (std::vector<Features>{once, other, {edge(15), facet(13)}, {edge(27), facet(25)}}));
}

TEST_F(RepeatedFeatures, AreExchangedWithTheMeshes) {
  const auto found = numbered({{edge(3), facet(1)}, {edge(3), facet(1)}}, a, b);
  const auto exchanged = numbered({{facet(1), edge(3)}, {facet(1), edge(3)}}, b, a);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(exchanged[i], (Features{found[i][1], found[i][0]}));
}

}  // namespace
}  // namespace ode_ext
