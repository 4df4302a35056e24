// SPDX-License-Identifier: BSD-3-Clause
// Any K contacts asked for are the best K: the first of the most that there are.
#include <algorithm>
#include <cstring>

#include "reference/reference_hits.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr int kUnimportant = static_cast<int>(CONTACTS_UNIMPORTANT);

// dCollide into elements of `skip` bytes, all of them painted before.
class PaintedAnswer {
 public:
  PaintedAnswer(dGeomID g1, dGeomID g2, int flags, int skip)
      : skip_(static_cast<std::size_t>(skip)), bytes_(66 * skip_, kPaint) {
    count_ = dCollide(g1, g2, flags, reinterpret_cast<dContactGeom*>(bytes_.data()), skip);
  }

  Contacts contacts() const {
    Contacts contacts(static_cast<std::size_t>(count_));
    for (std::size_t i = 0; i < contacts.size(); ++i)
      std::memcpy(&contacts[i], bytes_.data() + i * skip_, sizeof(dContactGeom));
    return contacts;
  }

  // Whether all but the contacts returned is as it was.
  bool is_clean() const {
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      const bool written =
          i / skip_ < static_cast<std::size_t>(count_) && i % skip_ < sizeof(dContactGeom);
      if (!written && bytes_[i] != kPaint) return false;
    }
    return true;
  }

 private:
  static constexpr unsigned char kPaint = 0xAB;
  std::size_t skip_;
  std::vector<unsigned char> bytes_;
  int count_;
};

class ApiLimits : public ::testing::Test {
 protected:
  static void keep_all(dBatchColliderParams& params) { params.max_contacts = 64; }
  static Contacts first(const Contacts& all, int limit) {
    return {all.begin(), all.begin() + std::min<long>(limit, static_cast<long>(all.size()))};
  }

  OdeWorld world;
  const dGeomID upper =
      world.geom(world.mesh(make_torus(1, 0.4, 24, 16)), turned({1, 2, 3}, 1, {0.3, 0.2, 0.4}));
  const dGeomID lower = world.geom(world.mesh(make_cube(2, 6)), {});
};

TEST_F(ApiLimits, UnimportantContactsAreTheSameOnes) {
  const BatchCollider collider(&keep_all);
  const Contacts all = collide(upper, lower);
  ASSERT_GE(all.size(), 40u);
  for (const int skip : {static_cast<int>(sizeof(dContactGeom)), 248}) {
    for (int limit = 1; limit <= 64; ++limit) {
      const PaintedAnswer there(upper, lower, limit | kUnimportant, skip);
      const PaintedAnswer back(lower, upper, limit | kUnimportant, skip);
      EXPECT_EQ(difference_with_geoms(there.contacts(), first(all, limit)), "") << limit;
      EXPECT_EQ(difference_with_geoms(back.contacts(), flipped(first(all, limit))), "") << limit;
      EXPECT_TRUE(there.is_clean() && back.is_clean()) << limit;
    }
  }
}

TEST_F(ApiLimits, UnimportantContactsOfGivenPairsAreTheSameOnes) {
  const BatchCollider collider(&keep_all);
  const Contacts all = collide(upper, lower);
  const dGeomID pairs[] = {upper, lower, lower, upper};
  for (const int limit : {1, 7, 40}) {
    Contacts contacts(2 * static_cast<std::size_t>(limit));
    int counts[2] = {};
    EXPECT_EQ(dBatchColliderCollidePairs(collider, pairs, 2, limit | kUnimportant, contacts.data(),
                                         sizeof(dContactGeom), counts),
              2 * limit);
    EXPECT_EQ(counts[0], limit);
    EXPECT_EQ(difference_with_geoms(first(contacts, limit), first(all, limit)), "");
    EXPECT_EQ(difference_with_geoms({contacts.begin() + limit, contacts.end()},
                                    flipped(first(all, limit))),
              "");
  }
}

// Stock ODE keeps to the limit as well; which contacts they are is its own affair.
TEST_F(ApiLimits, UnimportantContactsOfOdeItselfKeepToTheLimit) {
  for (const int limit : {1, 7, 64}) {
    const PaintedAnswer answer(upper, lower, limit | kUnimportant, 248);
    EXPECT_EQ(answer.contacts().size(), static_cast<std::size_t>(limit));
    EXPECT_TRUE(answer.is_clean());
  }
}

TEST_F(ApiLimits, OfRandomPairsGiveAPrefixThatBeginsWithTheDeepest) {
  const BatchCollider collider(&keep_all);
  const TestMesh meshes[] = {
      make_tetrahedron(1.2),       make_cube(1, 2),    make_icosphere(0.6, 2),
      make_torus(0.5, 0.2, 16, 8), make_rod(2, 0.2),   make_l(1),
      make_comb(4, 1.4, 0.6, 0.5), make_sheet(1.5, 4), make_cylinder(0.4, 1, 12)};
  Random random(51);
  int colliding = 0, rich = 0;
  for (int i = 0; i < 150; ++i) {
    const TestPose pose_a = random.pose(0.35), pose_b = random.pose(0.35);
    const dGeomID a = world.geom(world.mesh(meshes[random.below(9)]), pose_a);
    const dGeomID b = world.geom(world.mesh(meshes[random.below(9)]), pose_b);
    const Contacts all = collide(a, b);
    if (!all.empty()) ++colliding;
    if (all.size() > 8) ++rich;
    for (const dContactGeom& c : all) EXPECT_LE(c.depth, all[0].depth) << "pair " << i;
    for (int limit = 1; limit <= static_cast<int>(all.size()) + 1; ++limit) {
      ASSERT_EQ(difference_with_geoms(collide(a, b, limit), first(all, limit)), "") << "pair " << i;
      ASSERT_EQ(difference_with_geoms(collide(b, a, limit), flipped(first(all, limit))), "")
          << "pair " << i;
    }
    world.destroy(a);
    world.destroy(b);
  }
  EXPECT_GT(colliding, 100);
  EXPECT_GT(rich, 50);
}

// Whether others are as deep as the first to within the device's floats: which of them it takes for
// the deepest is then its own affair, and the host can only put first what it was given.
bool is_first_among_equals(const Contacts& contacts) {
  return std::any_of(
      contacts.begin() + (contacts.empty() ? 0 : 1), contacts.end(),
      [&](const dContactGeom& c) { return contacts[0].depth - c.depth <= rounding_bound(2); });
}

// Not only of what is kept: a collider that keeps K takes the K best itself. Combs on combs touch
// in several places, each of which has a claim.
TEST_F(ApiLimits, OfACollidersOwnAreThoseOfALargerOne) {
  const TestMesh meshes[] = {make_comb(6, 1.4, 0.6, 0.5), make_torus(0.5, 0.2, 16, 8), make_l(1),
                             make_cube(1, 2)};
  Random random(52);
  std::vector<dGeomID> pairs;
  for (int i = 0; i < 2 * 100; ++i) {
    const TestPose pose = random.pose(0.35);
    pairs.push_back(world.geom(world.mesh(meshes[random.below(4)]), pose));
  }
  const auto answers = [&](int kept) {
    const BatchCollider collider([&](dBatchColliderParams& params) { params.max_contacts = kept; });
    std::vector<Contacts> found;
    for (std::size_t i = 0; i < pairs.size(); i += 2)
      found.push_back(collide(pairs[i], pairs[i + 1]));
    return found;
  };
  const std::vector<Contacts> all = answers(64);
  for (const int kept : {1, 2, 5, 16, 33}) {
    const std::vector<Contacts> few = answers(kept);
    int cut = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (is_first_among_equals(all[i])) continue;
      EXPECT_EQ(difference_with_geoms(few[i], first(all[i], kept)), "")
          << kept << " contacts, pair " << i;
      if (static_cast<int>(all[i].size()) > kept) ++cut;
    }
    EXPECT_GT(cut, kept < 16 ? 50 : kept < 33 ? 5 : 0) << kept;
  }
}

}  // namespace
}  // namespace ode_ext::test
