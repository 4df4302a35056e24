// SPDX-License-Identifier: BSD-3-Clause
// dBatchColliderGetContactIds: which contacts it knows, and that ids hang on the pair alone.
#include "support/contact_ids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "ode/contact_export.h"
#include "ode/known_contacts.h"
#include "opencl/error.h"

namespace ode_ext::test {
namespace {

class ApiContactIds : public ::testing::Test {
 protected:
  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  Pile pile{world, space, 16, 3};
  BatchCollider collider;

  // The contacts of every pair, of pairs that have some.
  std::vector<Contacts> answers() const {
    std::vector<Contacts> answers;
    for (const auto& [pair, contacts] : collider.pass(space).contacts)
      if (!contacts.empty()) answers.push_back(contacts);
    return answers;
  }
  // Of the pair with most of them.
  Contacts most() const {
    const auto all = answers();
    return *std::max_element(all.begin(), all.end(),
                             [](const auto& a, const auto& b) { return a.size() < b.size(); });
  }
};

TEST_F(ApiContactIds, AreKnownOfEveryContactOfAPassAndNoTwoOfAPairAreEqual) {
  const auto all = answers();
  EXPECT_GT(all.size(), 20u);
  std::map<unsigned, int> kinds;
  for (const Contacts& contacts : all)
    for (const dBatchContactId id : ids_of(collider, contacts)) {
      ++kinds[id.feature1 >> dBatchFeatureShift];
      ++kinds[id.feature2 >> dBatchFeatureShift];
    }
  for (const unsigned kind : {dBatchFeatureVertex, dBatchFeatureEdge, dBatchFeatureFacet})
    EXPECT_GT(kinds[kind], 10);
}

// Faces on faces, edges on edges, corners in corners.
TEST_F(ApiContactIds, OfAPairAreNotEqualWhereMuchIsInOnePlaceEither) {
  const OdeMesh* meshes[] = {&world.mesh(make_cube(1, 4)), &world.mesh(make_l(1)),
                             &world.mesh(make_comb(4, 1, 1, 0.5)),
                             &world.mesh(unshared(make_cube(1, 2)))};
  std::size_t total = 0;
  for (const OdeMesh* first : meshes)
    for (const OdeMesh* second : meshes)
      for (const double x : {0.0, 0.125, 0.25})
        for (const double angle : {0.0, std::numbers::pi / 4}) {
          const dGeomID a = world.geom(*first, {});
          const dGeomID b = world.geom(*second, turned({0, 0, 1}, angle, {x, 0.25, 0.5}));
          const Contacts contacts = answer_of(collider, a, b);
          ids_of(collider, contacts);
          total += contacts.size();
        }
  EXPECT_GT(total, 400u);
}

// A ground that is flat to within 0.1 degrees, and yet each lower edge of a cube across its ridge
// goes through it twice.
TEST_F(ApiContactIds, OfAnEdgeThatCrossesOneFacetTwiceAreNotEqual) {
  TestMesh roof = make_sheet(8, 2);
  for (std::size_t i = 0; i < roof.vertices.size(); i += 3)
    roof.vertices[i + 2] = -7e-4f * std::fabs(roof.vertices[i]);
  const dGeomID above = world.geom(world.mesh(make_cube(1)), at(0, 0.2, 0.5 - 1e-4));
  const Contacts contacts = answer_of(collider, above, world.geom(world.mesh(roof), {}));
  ids_of(collider, contacts);
  EXPECT_EQ(contacts.size(), 4u);
}

TEST_F(ApiContactIds, AreExchangedWithTheArguments) {
  for (const Contacts& contacts : answers()) {
    const Contacts other_way = collide(contacts[0].g2, contacts[0].g1);
    ASSERT_EQ(difference(other_way, flipped(contacts)), "");
    Ids expected = ids_of(collider, contacts);
    std::transform(expected.begin(), expected.end(), expected.begin(), exchanged);
    EXPECT_EQ(keys(ids_of(collider, other_way)), keys(expected));
  }
}

TEST_F(ApiContactIds, AreTheSameAloneInABatchAndBesideOtherMeshes) {
  const auto all = answers();
  const BatchCollider late;  // meets the last pairs first, after a mesh that is in none
  const dGeomID aside = world.geom(world.mesh(make_icosphere(0.3, 3)), at(9, 9, 9));
  const dGeomID beside = world.geom(world.mesh(make_cube(0.3, 2)), at(9, 9, 9.1));
  EXPECT_FALSE(answer_of(late, aside, beside).empty());
  for (std::size_t i = all.size(); i-- > 0;) {
    const Contacts& contacts = all[i];
    const auto expected = keys(ids_of(collider, contacts));
    const dGeomID g1 = contacts[0].g1, g2 = contacts[0].g2;
    ASSERT_EQ(difference(answer_of(late, g1, g2), contacts), "");
    EXPECT_EQ(keys(ids_of(late, contacts)), expected);
    if (i >= 8) continue;
    const BatchCollider alone;
    ASSERT_EQ(difference(answer_of(alone, g1, g2), contacts), "");
    EXPECT_EQ(keys(ids_of(alone, contacts)), expected);
  }
}

TEST_F(ApiContactIds, OfAPrefixAreThoseOfTheFirst) {
  const Contacts contacts = most();
  Ids expected = ids_of(collider, contacts);
  ASSERT_GT(contacts.size(), 8u);
  expected.resize(3);
  EXPECT_EQ(keys(ids_of(collider, collide(contacts[0].g1, contacts[0].g2, 3))), keys(expected));
}

TEST_F(ApiContactIds, AreFoundInAnyOrderAndWhereOthersAreMissing) {
  const Contacts contacts = most();
  const Ids ids = ids_of(collider, contacts);
  ASSERT_GT(contacts.size(), 8u);
  EXPECT_EQ(keys(ids_of(collider, {contacts.rbegin(), contacts.rend()})),
            keys({ids.rbegin(), ids.rend()}));
  EXPECT_EQ(keys(ids_of(collider, {contacts[1], contacts[4], contacts[5], contacts[2]})),
            keys({ids[1], ids[4], ids[5], ids[2]}));
}

TEST(KnownContacts, OfContactsInOnePlaceGoByTheirSides) {
  Contact known{{1, 2, 3}, {0, 0, 1}, 0.25, {4, 5}, {6, 7}};
  std::vector<Contact> both{known, known};
  both[1].triangles[1] = 8;
  both[1].features = {9, 10};
  const dGeomID g1 = reinterpret_cast<dGeomID>(1), g2 = reinterpret_cast<dGeomID>(2);
  Contacts asked(2);
  export_contacts(both, g1, g1, g2, 2, asked.data(), sizeof(dContactGeom));
  EXPECT_EQ(key(KnownContacts(both, g1).id_of(asked[1])), std::pair(9u, 10u));
  EXPECT_EQ(key(KnownContacts(both, g1).id_of(asked[0])), std::pair(6u, 7u));
  asked[0].side2 = asked[1].side2 = -1;  // a callback made them: the order tells
  KnownContacts ids(both, g1);
  EXPECT_EQ(key(ids.id_of(asked[0])), std::pair(6u, 7u));
  EXPECT_EQ(key(ids.id_of(asked[1])), std::pair(9u, 10u));
}

TEST_F(ApiContactIds, AreFoundOfSeveralPairsAtOnceWithAnyStride) {
  std::vector<dContact> mixed;
  Ids expected;
  const auto all = answers();
  for (std::size_t i = 0; i < 4; ++i)  // the i-th contact of each pair: pairs alternate
    for (const Contacts& contacts : all) {
      if (i >= contacts.size()) continue;
      mixed.emplace_back().geom = contacts[i];
      expected.push_back(ids_of(collider, contacts)[i]);
    }
  Ids ids(mixed.size());
  const auto count = static_cast<int>(mixed.size());
  EXPECT_EQ(
      dBatchColliderGetContactIds(collider, &mixed[0].geom, count, sizeof(dContact), ids.data()),
      count);
  EXPECT_EQ(keys(ids), keys(expected));
}

void ask_in_callback(void* collider, dGeomID o1, dGeomID o2) {
  ids_of(static_cast<dBatchColliderID>(collider), collide(o1, o2));
}
TEST_F(ApiContactIds, AreFoundInTheNearCallback) {
  EXPECT_EQ(dBatchColliderSpaceCollide(collider, space, static_cast<dBatchColliderID>(collider),
                                       &ask_in_callback),
            1);
}

TEST_F(ApiContactIds, AreFoundAfterCollidePairsOfSeveral) {
  const auto expected = answers();
  ASSERT_GT(expected.size(), 20u);
  std::vector<dGeomID> pairs;
  for (const Contacts& contacts : expected)
    pairs.insert(pairs.end(), {contacts[0].g1, contacts[0].g2});
  const BatchCollider fresh;
  Contacts contacts(64 * expected.size());
  std::vector<int> counts(expected.size());
  dBatchColliderCollidePairs(fresh, pairs.data(), static_cast<int>(counts.size()), 64,
                             contacts.data(), sizeof(dContactGeom), counts.data());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto first = contacts.begin() + static_cast<std::ptrdiff_t>(64 * i);
    EXPECT_EQ(keys(ids_of(fresh, {first, first + counts[i]})), keys(ids_of(collider, expected[i])));
  }
}

TEST_F(ApiContactIds, AreStillFoundWhenBodiesHaveMovedOnOrAreGone) {
  const Contacts contacts = most();
  const auto expected = keys(ids_of(collider, contacts));
  pile.shake(4);
  EXPECT_EQ(keys(ids_of(collider, contacts)), expected);
  world.destroy(contacts[0].g1);
  EXPECT_EQ(keys(ids_of(collider, contacts)), expected);
}

TEST_F(ApiContactIds, AreNoneOfContactsThatThePairHadBefore) {
  const auto before = answers();
  pile.shake(4);
  const auto pairs_now = collider.pass(space).contacts;
  std::size_t met_again = 0;
  for (const Contacts& contacts : before) {
    // The others keep their answers: nothing was asked about them since.
    if (!pairs_now.contains(GeomPair(contacts[0].g1, contacts[0].g2))) continue;
    ++met_again;
    for (const dBatchContactId id : ids_as_found(collider, contacts)) EXPECT_TRUE(is_none(id));
  }
  EXPECT_GT(met_again, 5u);
}

TEST_F(ApiContactIds, AreNoneOfAnAnswerThatWasForgotten) {
  const Contacts contacts = most();
  ids_of(collider, contacts);
  dSpaceRemove(space, contacts[0].g1);
  for (int i = 0; i < 40; ++i) collider.pass(space);
  for (const dBatchContactId id : ids_as_found(collider, contacts)) EXPECT_TRUE(is_none(id));
}

TEST_F(ApiContactIds, AreNoneOfAContactThatWasChanged) {
  const Contacts contacts = most();
  const Ids ids = ids_of(collider, contacts);
  const std::function<void(dContactGeom&)> changes[] = {
      [](dContactGeom& c) { c.pos[1] = std::nextafter(c.pos[1], 9.0); },
      [](dContactGeom& c) { c.normal[2] = std::nextafter(c.normal[2], 9.0); },
      [](dContactGeom& c) { c.depth = std::nextafter(c.depth, 9.0); },
      [](dContactGeom& c) { c.depth = std::numeric_limits<double>::quiet_NaN(); },
      [](dContactGeom& c) { std::swap(c.g1, c.g2); },
      [](dContactGeom& c) { c.g2 = nullptr; },
      [](dContactGeom& c) { c.g1 = c.g2; }};
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Contacts changed = contacts;
    changes[i](changed[1]);
    const Ids found = ids_as_found(collider, changed);
    for (std::size_t k = 0; k < ids.size(); ++k)
      EXPECT_EQ(key(found[k]), k == 1 ? std::pair(0u, 0u) : key(ids[k])) << "change " << i;
  }
}

TEST_F(ApiContactIds, AreNoneWhereOneGeomIsNoMesh) {
  const dGeomID ball = world.own(dCreateSphere(nullptr, 1)),
                box = world.own(dCreateBox(nullptr, 1, 1, 1));
  const Contacts with_mesh = collide(ball, pile.geoms[0]), without = collide(ball, box);
  ASSERT_FALSE(with_mesh.empty());
  ASSERT_FALSE(without.empty());
  for (const Contacts& contacts : {with_mesh, without})
    for (const dBatchContactId id : ids_as_found(collider, contacts)) EXPECT_TRUE(is_none(id));
}

TEST_F(ApiContactIds, AreNoneWithAColliderOfZero) {
  for (const dBatchContactId id : ids_as_found(nullptr, most())) EXPECT_TRUE(is_none(id));
}

int merge_into_a_sum(dGeomID, int first, int second) { return 1000 + first + second; }

TEST_F(ApiContactIds, AreFoundWhereAMergeCallbackMadeTheSides) {
  int changed = 0;
  for (const Contacts& plain : answers()) {
    const Ids ids = ids_of(collider, plain);
    dGeomTriMeshSetTriMergeCallback(plain[0].g1, &merge_into_a_sum);
    const Contacts merged = collide(plain[0].g1, plain[0].g2);
    dGeomTriMeshSetTriMergeCallback(plain[0].g1, nullptr);
    changed += difference(merged, plain).empty() ? 0 : 1;
    EXPECT_EQ(keys(ids_of(collider, merged)), keys(ids));
  }
  EXPECT_GT(changed, 0);
}

int refuse_odd(dGeomID, dGeomID, int triangle) { return triangle % 2 == 0 ? 1 : 0; }

TEST_F(ApiContactIds, AreThoseOfTheContactsThatATriangleCallbackLeaves) {
  const BatchCollider asking([](dBatchColliderParams& p) { p.triangle_callbacks = 1; });
  std::size_t refused_count = 0;
  for (const Contacts& plain : answers()) {
    const dGeomID g1 = plain[0].g1, g2 = plain[0].g2;
    // A corner has one for each face that it is past.
    const auto place = [](const dContactGeom& c) {
      return std::pair(pos(c), Point{c.normal[0], c.normal[1], c.normal[2]});
    };
    std::map<std::pair<Point, Point>, dBatchContactId> at;
    const Ids ids = ids_of(collider, plain);
    for (std::size_t i = 0; i < plain.size(); ++i) at[place(plain[i])] = ids[i];
    dGeomTriMeshSetCallback(g1, &refuse_odd);
    const Contacts left = answer_of(asking, g1, g2);
    dGeomTriMeshSetCallback(g1, nullptr);
    refused_count += plain.size() - left.size();
    const Ids found = ids_of(asking, left);
    for (std::size_t i = 0; i < left.size(); ++i)
      EXPECT_EQ(key(found[i]), key(at.at(place(left[i]))));
  }
  EXPECT_GT(refused_count, 0u);
}

TEST_F(ApiContactIds, AreNoneWhileOdesOwnColliderAnswersForADeviceThatFails) {
  fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
  const Collected failed = collider.pass(space);
  fault_injector::disarm();
  ASSERT_NE(collider.stats().status & dBatchStatusDeviceFailed, 0u);
  ASSERT_GT(failed.total(), 0);
  for (const auto& [pair, contacts] : failed.contacts)
    for (const dBatchContactId id : ids_as_found(collider, contacts)) EXPECT_TRUE(is_none(id));
}

class ApiContactIdsRefuse : public ApiContactIds {
 protected:
  void TearDown() override {
    EXPECT_EQ(last_error().rfind("dBatchColliderGetContactIds: ", 0), 0u) << last_error();
    EXPECT_EQ(ids[0].feature1, 7u) << "nothing may be written";
  }
  int ask(const dContactGeom* from, int count, int stride, dBatchContactId* to) {
    return dBatchColliderGetContactIds(collider, from, count, stride, to);
  }
  const Contacts contacts = most();
  const int skip = sizeof(dContactGeom);
  Ids ids = Ids(64, {7, 7});
};

TEST_F(ApiContactIdsRefuse, NoContacts) { EXPECT_EQ(ask(nullptr, 1, skip, ids.data()), -1); }
TEST_F(ApiContactIdsRefuse, NoRoom) { EXPECT_EQ(ask(contacts.data(), 1, skip, nullptr), -1); }
TEST_F(ApiContactIdsRefuse, ANegativeCount) {
  EXPECT_EQ(ask(contacts.data(), -1, skip, ids.data()), -1);
}
TEST_F(ApiContactIdsRefuse, AStrideBelowTheSizeOfAContact) {
  EXPECT_EQ(ask(contacts.data(), 1, skip - 1, ids.data()), -1);
}
TEST_F(ApiContactIdsRefuse, AColliderThatIsGone) {
  const dBatchColliderID gone = collider;
  collider.destroy();
  EXPECT_EQ(dBatchColliderGetContactIds(gone, contacts.data(), 1, skip, ids.data()), -1);
}

TEST_F(ApiContactIds, OfNoContactsAreNone) {
  EXPECT_EQ(dBatchColliderGetContactIds(collider, nullptr, 0, sizeof(dContactGeom), nullptr), 0);
}

}  // namespace
}  // namespace ode_ext::test
