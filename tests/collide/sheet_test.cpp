// SPDX-License-Identifier: BSD-3-Clause
// Contacts of sheets (open deformable meshes), and of deformable meshes in every mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collide/collider.h"
#include "support/deform_rig.h"

namespace ode_ext::test {
namespace {

using Bits = std::vector<std::vector<ContactBits>>;

std::shared_ptr<const Mesh> rigid(const TestMesh& mesh) {
  return std::make_shared<const Mesh>(build_mesh(soup_of(mesh)));
}

// A pair of two meshes, the first at `pose_a`, the second at the origin.
Scene pair_of(std::shared_ptr<const Mesh> a, const TestPose& pose_a,
              std::shared_ptr<const Mesh> b) {
  Scene scene;
  scene.meshes = {std::move(a), std::move(b)};
  scene.objects = {{collider_pose(pose_a), 0, 1}, {Pose{}, 1, 2}};
  scene.pairs = {{0, 1}};
  return scene;
}

Scene turned_round(Scene scene) {
  for (auto& pair : scene.pairs) std::swap(pair[0], pair[1]);
  return scene;
}

class Sheet : public testing::Test {
 protected:
  static Collider& collider() {
    static Collider* const collider = new Collider({});  // never destroyed, as in Rig
    return *collider;
  }
  std::vector<Contact> contacts(const Scene& scene) {
    return collider().collide(scene, nullptr).contacts;
  }

  std::shared_ptr<const Mesh> sheet = deformable(soup_of(make_sheet(2, 32)), 0.02f);
  std::shared_ptr<const Mesh> cube = rigid(make_cube(1, 4));  // half of it above z = 0
};

// The sheet is one third of the way down from the top, or up from the bottom, of the cube.
TEST_F(Sheet, VerticesInASolidTakeTheShorterWayOut) {
  for (const double up : {1.0, -1.0}) {
    for (const bool face_down : {false, true}) {
      const TestPose pose = face_down ? turned({1, 0, 0}, std::acos(-1.0), {0.01, 0.02, up / 6})
                                      : at(0.01, 0.02, up / 6);
      const auto found = contacts(pair_of(sheet, pose, cube));
      // All within the cube, at 2/32 m from one another, but for the rigid vertices on it.
      EXPECT_GT(found.size(), 200u);
      for (const Contact& contact : found) {
        EXPECT_NEAR(contact.normal.z, up, 1e-6);
        EXPECT_NEAR(contact.depth, 0.5 - 1.0 / 6, 1e-5);
      }
    }
  }
}

// The sheet is a little above the bottom of a prism, which is leaned by next to nothing, and one of
// its vertices is at a side, outside by no more than the prism is made larger by. Its way up went
// in by the side and out by the top, and the prism was sent off by all of its height.
TEST_F(Sheet, VerticesBesideAWallDoNotLeaveByTheFarEnd) {
  Random random(31);
  for (const int sides : {4, 32})
    for (int i = 0; i < 200; ++i) {
      const TestMesh mesh = make_cylinder(0.4, 0.8, sides);
      const double apothem = 0.4 * std::cos(std::acos(-1.0) / sides);
      const double angle = 2 * std::acos(-1.0) * (random.below(sides) + 0.5) / sides;
      const double in = std::pow(10, random.uniform(-4, -2)), beside = random.uniform(-2e-6, 4e-6);
      const double lean = std::pow(10, random.uniform(-6, -2));
      TestPose pose = turned({random.uniform(-1, 1), random.uniform(-1, 1), 0}, lean);
      const Point foot = rotate(pose, {apothem * std::cos(angle), apothem * std::sin(angle), -0.4});
      pose.position = {-foot[0] - beside * std::cos(angle), -foot[1] - beside * std::sin(angle),
                       -foot[2] - in};
      const auto found = contacts(pair_of(rigid(mesh), pose, sheet));
      ASSERT_FALSE(found.empty());
      // The lowest of its rim is lower by as much as it leans.
      for (const Contact& contact : found) EXPECT_LT(contact.depth, in + 0.8 * lean + 1e-4) << i;
    }
}

// It has two sides, so it does not matter which is wound to be the front.
TEST_F(Sheet, ThatIsWoundTheOtherWayGivesTheSameContacts) {
  Random random(32);
  const auto coarse = deformable(soup_of(make_sheet(4, 8)), 0.02f);
  const auto other = deformable(soup_of(inverted(make_sheet(4, 8))), 0.02f);
  const TestMesh box = make_cube(0.8);
  for (int i = 0; i < 100; ++i) {
    TestPose pose = random.pose(0);
    double lowest = 0;
    for (std::size_t k = 0; k < 8; ++k) lowest = std::min(lowest, rotate(pose, box.vertex(k))[2]);
    const double in = random.uniform(0.01, 0.1), side = i % 2 == 0 ? 1 : -1;
    pose.position = {random.uniform(-1, 1), random.uniform(-1, 1), side * (-lowest - in)};
    const auto one = contacts(pair_of(rigid(box), pose, coarse));
    const auto two = contacts(pair_of(rigid(box), pose, other));
    ASSERT_FALSE(one.empty());
    ASSERT_EQ(one.size(), two.size()) << i;
    for (const Contact& a : one) {
      EXPECT_GT(side * a.normal.z, 0.3) << i;
      EXPECT_TRUE(std::any_of(two.begin(), two.end(), [&](const Contact& b) {
        return std::abs(a.depth - b.depth) < 1e-5 && a.normal.z * b.normal.z > 0 &&
               length(point_of(a.position) - point_of(b.position)) < 1e-5;
      })) << i;
    }
  }
}

// A floor of many triangles, each of which may come to be turned against the next: no vertex of it
// goes farther than the body on it.
TEST_F(Sheet, FloorsThatAreFlatPushBackAsRigidOnesDo) {
  Random random(33);
  for (const TestMesh& tool : {make_torus(0.7, 0.25, 24, 12), make_icosphere(1, 2)})
    for (const int cuts : {4, 12})
      for (const bool floor_deforms : {false, true})
        for (int i = 0; i < 40; ++i) {
          const TestMesh block = make_box({6, 6, 2}, cuts, cuts, cuts);
          TestPose pose = random.pose(0);
          double lowest = 0;
          for (std::size_t k = 0; k < static_cast<std::size_t>(tool.vertex_count()); ++k)
            lowest = std::min(lowest, rotate(pose, tool.vertex(k))[2]);
          const double in = random.uniform(0.01, 0.3);
          pose.position = {random.uniform(-1, 1), random.uniform(-1, 1), 1 - lowest - in};
          const auto body = floor_deforms ? rigid(tool) : deformable(soup_of(tool), 0.02f);
          const auto floor = floor_deforms ? deformable(soup_of(block), 0.02f) : rigid(block);
          const auto found = contacts(pair_of(body, pose, floor));
          double deepest = 0;
          for (const Contact& contact : found)
            deepest = std::max(deepest, static_cast<double>(contact.depth));
          EXPECT_NEAR(deepest, in, 0.01 * in) << cuts << ", " << floor_deforms << ", " << i;
        }
}

// Most of the way: a centimetre of each edge that goes through the ground is above it.
TEST_F(Sheet, EdgesThroughOpenGroundArePushedOutThroughItsFront) {
  const auto ground = rigid(make_sheet(4, 1));
  const TestPose pose = turned({1, 0, 0}, 0.5 * std::acos(-1.0), {0.01, 0.1, 0.95});
  const auto found = contacts(pair_of(sheet, pose, ground));
  ASSERT_FALSE(found.empty());
  for (const Contact& contact : found) {
    EXPECT_GT(contact.normal.z, 0.999);
    EXPECT_NEAR(contact.depth, 0.05, 1e-5);  // of the lower ends
  }
}

TEST_F(Sheet, OfASolidsVerticesThoseBeyondItComeBack) {
  // The cube stands on the sheet, a hundredth too deep: its lower corners are beyond, its upper
  // ones are not, although their rays, down through the cube, meet the sheet too.
  const auto found = contacts(turned_round(pair_of(sheet, at(0.01, 0.02, -0.49), cube)));
  int of_cube = 0;
  for (const Contact& contact : found) {
    if (std::fabs(contact.position.z + 0.5) > 1e-6) continue;
    ++of_cube;
    EXPECT_GT(contact.normal.z, 0.9);  // into the cube, which is the first
    EXPECT_NEAR(contact.depth, 0.01, 0.005);
  }
  EXPECT_GE(of_cube, 25);
  for (const Contact& contact : found) EXPECT_LT(contact.depth, 0.02);
}

TEST_F(Sheet, PushBackFromEitherSide) {
  for (const double side : {1.0, -1.0}) {
    const auto found = contacts(turned_round(pair_of(sheet, at(0, 0, -side * 0.49), cube)));
    ASSERT_FALSE(found.empty());
    for (const Contact& contact : found) EXPECT_GT(side * contact.normal.z, 0.5);
  }
}

TEST_F(Sheet, MeetOtherSheetsWithinTheirThickness) {
  const auto other = deformable(soup_of(make_sheet(1, 8)), 0.02f);
  EXPECT_FALSE(contacts(pair_of(sheet, at(0.01, 0.02, 0.015), other)).empty());
  EXPECT_FALSE(contacts(pair_of(sheet, at(0.01, 0.02, -0.015), other)).empty());
  EXPECT_TRUE(contacts(pair_of(sheet, at(0.01, 0.02, 0.025), other)).empty());
  EXPECT_TRUE(contacts(pair_of(sheet, at(0.01, 0.02, -0.025), other)).empty());
}

// No vertex is in the plate, and none of the plate's edges goes through the sheet.
TEST_F(Sheet, WhoseEdgesAloneGoThroughAPlateAreDrawnBack) {
  const auto plate = rigid(make_box({6, 6, 0.01}));
  for (const double up : {0.02, -0.02}) {  // edges are 0.0625 m long
    const auto found = contacts(pair_of(sheet, turned({1, 0, 0}, 1.5, {0, 0, up}), plate));
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(std::fabs(found[0].normal.z), 1, 1e-6);
    EXPECT_NEAR(found[0].depth, 0.01, 1e-4);
  }
}

// None of its vertices is beyond the sheet: the lowest is beyond the border. An edge that went
// through the sheet was drawn back by either end, whether that was behind the sheet or beside it.
TEST_F(Sheet, SolidsOverItsBorderComeBackByNoMoreThanTheyAreIn) {
  Random random(34);
  int met = 0;
  for (const TestMesh& body : {make_cube(0.2), make_tetrahedron(0.4), make_rod(0.8, 0.05),
                               make_box({0.5, 0.1, 0.02}), make_cylinder(0.1, 0.2, 16)})
    for (int i = 0; i < 60; ++i) {
      const TestPose tilted = random.pose(0);
      Point low{0, 0, 1};
      for (int k = 0; k < body.vertex_count(); ++k) {
        const Point p = rotate(tilted, body.vertex(static_cast<std::size_t>(k)));
        if (p[2] < low[2]) low = p;
      }
      const double in = i % 2 == 0 ? 0.001 : 0.004;
      TestPose pose = tilted;
      pose.position = {1 - low[0] + random.uniform(0, 0.02), random.uniform(-0.5, 0.5),
                       -low[2] - in};
      for (const Contact& contact : contacts(pair_of(rigid(body), pose, sheet))) {
        EXPECT_GT(contact.normal.z, 0) << i;
        EXPECT_LE(contact.depth, 1.001 * in) << i;
        ++met;
      }
    }
  EXPECT_GT(met, 100);
}

// The bar is in it on both sides of a fold, with both of its ends above.
TEST_F(Sheet, BarsAcrossAFoldAreHeldUp) {
  for (const double slope : {0.1, 0.3})
    for (const double in : {5e-4, 1e-3, 3e-3, 1e-2}) {
      TestMesh tent = make_sheet(0.6, 2);
      for (std::size_t i = 0; i < tent.vertices.size(); i += 3)
        tent.vertices[i + 2] = static_cast<float>(-slope * std::abs(tent.vertices[i]));
      const auto found = contacts(pair_of(
          rigid(make_rod(0.8, 0.05)),
          turned({1, 0, 0}, std::acos(-1.0) / 4, {0.02, 0.013, 0.025 * std::sqrt(2.0) - in}),
          deformable(soup_of(tent), 0.02f)));
      ASSERT_FALSE(found.empty());
      EXPECT_GT(found[0].depth, 0.7 * in);  // by a face of the bar, which slopes by 45 degrees
      for (const Contact& contact : found) {
        EXPECT_GT(contact.normal.z, 0.5) << slope << ", " << in;
        EXPECT_LE(contact.depth, 1.001 * in) << slope << ", " << in;
      }
    }
}

// Of a sheet that lies on many posts there is a region of each, and more contacts in a region than
// planes a rigid one may have.
TEST_F(Sheet, KeepTheSameFewContactsInWhateverCompany) {
  TestMesh posts;
  for (int i = 0; i < 6; ++i)
    posts = merged(posts, moved(make_box({0.2, 0.5, 1}), {0.3 * i - 0.75, 0, -0.5 + 0.002 * i}));
  const auto ground = rigid(posts);
  const Scene alone = pair_of(sheet, turned({1, 2, 0}, 0.002, {0.01, 0.02, 0}), ground);
  Scene in_company = alone;
  in_company.objects.push_back({collider_pose(turned({1, 0, 0}, 0.003)), 0, 3});
  in_company.pairs = {{2, 1}, {0, 1}};
  ColliderOptions options;
  options.max_contacts_deformable = 24;
  Collider whole(options);
  options.whole_steps = false;
  Collider by_kernels(options);
  options.work_group_size = 1;
  Collider one_by_one(options);
  const auto expected = bits_of(whole.collide(alone, nullptr))[0];
  ASSERT_EQ(expected.size(), 24u);
  for (Collider* const any : {&whole, &by_kernels, &one_by_one}) {
    EXPECT_EQ(bits_of(any->collide(alone, nullptr))[0], expected);
    EXPECT_EQ(bits_of(any->collide(in_company, nullptr))[1], expected);
  }
}

TEST_F(Sheet, GiveTheSameContactsTheOtherWayRound) {
  const Scene scene = pair_of(sheet, turned({1, 2, 0}, 0.3, {0.1, 0.05, 0.3}), cube);
  const auto one = contacts(scene);
  auto other = contacts(turned_round(scene));
  ASSERT_EQ(one.size(), other.size());
  ASSERT_GT(one.size(), 100u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].position, other[i].position);
    EXPECT_EQ(one[i].normal, -other[i].normal);
    EXPECT_EQ(one[i].depth, other[i].depth);
    EXPECT_EQ(one[i].triangles[0], other[i].triangles[1]);
  }
}

TEST_F(Sheet, KeepAllContactsTheDeepestFirstUnlessAsked) {
  const Scene scene = pair_of(sheet, turned({1, 2, 0}, 0.3, {0.1, 0.05, 0.3}), cube);
  const auto all = contacts(scene);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GE(all[i - 1].depth, all[i].depth);
  ColliderOptions options;
  options.max_contacts_deformable = 5;
  Collider few(options);
  const auto five = few.collide(scene, nullptr).contacts;
  ASSERT_EQ(five.size(), 5u);
  EXPECT_EQ(five[0].depth, all[0].depth);
}

// Sheets and a soft ball that move over rigid meshes, all in one scene.
class MovingDeformables {
 public:
  MovingDeformables() {
    scene_.meshes = {rigid(make_icosphere(0.6, 3)), rigid(make_cube(1, 4)), nullptr, nullptr,
                     nullptr};
    bases_ = {deformable(soup_of(make_sheet(2, 24)), 0.05f),
              deformable(soup_of(make_sheet(1.5, 16)), 0.05f),
              deformable(soup_of(make_icosphere(0.5, 2)))};
    const double z[] = {0, 0.1, 0.45, 0.47, 0.7};
    for (std::uint32_t i = 0; i < 5; ++i)
      scene_.objects.push_back(
          {collider_pose(turned({1, 2, 3}, i < 2 ? 0.3 * i : 0.0, {0.1 * i, -0.05 * i, z[i]})), i,
           i + 1});
    for (std::uint32_t a = 0; a < 5; ++a)
      for (std::uint32_t b = 0; b < a; ++b) scene_.pairs.push_back({a, b});
    advance();
  }

  const Scene& scene() const { return scene_; }

  void advance() {
    ++steps_;
    for (std::size_t i = 0; i < bases_.size(); ++i) {
      TriangleSoup soup;
      for (const std::uint32_t vertex : bases_[i]->topology->corner_vertex) {
        Vec3f p = bases_[i]->vertices[vertex];
        p.z += 0.05f * std::sin(4 * p.x + 0.1f * static_cast<float>(steps_)) * std::cos(3 * p.y);
        soup.push_back(p);
      }
      scene_.meshes[2 + i] = deformed(bases_[i], soup);
    }
    for (Scene::Object& object : scene_.objects) object.pose.position.z -= 0.0005;
  }

 private:
  Scene scene_;
  std::vector<std::shared_ptr<const Mesh>> bases_;
  int steps_ = 0;
};

struct NamedOptions {
  const char* name;
  ColliderOptions options;
};

ColliderOptions options_of(Rays rays, DeformableTarget target, Organization organization) {
  ColliderOptions options;
  options.rays = rays;
  options.deformable_target = target;
  options.organization = organization;
  return options;
}

TEST(Deformables, GiveTheSameBytesInEveryMode) {
  const NamedOptions modes[] = {
      {"iterative",
       options_of(Rays::kIterative, DeformableTarget::kRefit, Organization::kPipelined)},
      {"basic", options_of(Rays::kFull, DeformableTarget::kBasic, Organization::kPipelined)},
      {"iterative basic",
       options_of(Rays::kIterative, DeformableTarget::kBasic, Organization::kPipelined)},
      {"monolithic",
       options_of(Rays::kIterative, DeformableTarget::kRefit, Organization::kMonolithic)},
      {"monolithic basic",
       options_of(Rays::kFull, DeformableTarget::kBasic, Organization::kMonolithic)},
  };
  // The paper's modes among themselves: their contacts are of the vertices that rays find.
  ColliderOptions in_full =
      options_of(Rays::kFull, DeformableTarget::kRefit, Organization::kPipelined);
  in_full.count_work = true;
  Collider full(in_full);
  for (const NamedOptions& mode : modes) {
    Collider collider(mode.options);
    MovingDeformables moving;
    PassMemory memory;
    std::uint64_t iterative = 0, basic = 0, small = 0;
    std::size_t contacts = 0;
    for (int i = 0; i < 8; ++i, moving.advance()) {
      const Bits expected = bits_of(full.collide(moving.scene(), nullptr));
      ASSERT_EQ(bits_of(collider.collide(moving.scene(), &memory)), expected) << mode.name << i;
      const ListCounts& actual = collider.report().actual;
      iterative += actual[static_cast<std::size_t>(List::kRaysIterative)];
      basic += actual[static_cast<std::size_t>(List::kRaysBasic)];
      small += actual[static_cast<std::size_t>(List::kChunksDeformable)];
      for (const auto& pair : expected) contacts += pair.size();
    }
    EXPECT_GT(contacts, 1000u);
    EXPECT_EQ(iterative > 100, mode.options.rays == Rays::kIterative) << mode.name;
    EXPECT_EQ(basic > 100, mode.options.deformable_target == DeformableTarget::kBasic) << mode.name;
    EXPECT_EQ(small > 0, mode.options.organization == Organization::kPipelined) << mode.name;
  }
}

TEST(Deformables, AreDroppedWithoutTemporalDataInThePapersMode) {
  Collider paper(
      options_of(Rays::kIterativePaper, DeformableTarget::kBasic, Organization::kPipelined));
  MovingDeformables moving;
  PassMemory memory;
  std::uint64_t dropped = 0, iterative = 0, in_full = 0;
  for (int i = 0; i < 20; ++i, moving.advance()) {
    paper.collide(moving.scene(), &memory);
    dropped += paper.report().dropped;
    iterative += paper.report().actual[static_cast<std::size_t>(List::kRaysIterative)];
    if (i > 0) in_full += paper.report().actual[static_cast<std::size_t>(List::kRaysBasic)];
  }
  EXPECT_GT(dropped, 100u);
  EXPECT_GT(iterative, 100u);
  EXPECT_GT(in_full, 100u);  // vertices that have moved far since they were last cast in full
}

}  // namespace
}  // namespace ode_ext::test
