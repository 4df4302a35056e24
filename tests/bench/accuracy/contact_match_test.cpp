// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/contact_match.h"

#include <gtest/gtest.h>

namespace ode_ext::accuracy {
namespace {

dContactGeom contact(double x, double depth, const test::Point& normal = {0, 0, 1}) {
  dContactGeom c{};
  c.pos[0] = x;
  c.depth = depth;
  for (std::size_t k = 0; k < 3; ++k) c.normal[k] = normal[k];
  return c;
}

TEST(ContactMatch, TakesAnotherOrderAndRoundingForTheSame) {
  EXPECT_TRUE(same_contacts({contact(0, 1), contact(1, 2)},
                            {contact(1 + 1e-7, 2), contact(0, 1 - 1e-7)}, 1e-6));
  EXPECT_TRUE(same_contacts({}, {}, 1e-6));
}

TEST(ContactMatch, SeesWhereAPlaceADepthANormalOrTheNumberDiffers) {
  const test::Contacts truth{contact(0, 1), contact(1, 2)};
  EXPECT_FALSE(same_contacts(truth, {contact(0, 1), contact(1.001, 2)}, 1e-6));
  EXPECT_FALSE(same_contacts(truth, {contact(0, 1), contact(1, 2.001)}, 1e-6));
  EXPECT_FALSE(same_contacts(truth, {contact(0, 1), contact(1, 2, {0, 0, -1})}, 1e-6));
  EXPECT_FALSE(same_contacts(truth, {contact(0, 1)}, 1e-6));
}

TEST(ContactMatch, UsesNoContactTwice) {
  EXPECT_FALSE(same_contacts({contact(0, 1), contact(0, 1)}, {contact(0, 1), contact(1, 1)}, 1e-6));
}

}  // namespace
}  // namespace ode_ext::accuracy
