// SPDX-License-Identifier: BSD-3-Clause
// What is taken off a depth, since meshes are rounded to floats: enough for ODE to go on seeing
// that they touch, and no more.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/batch_collider.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

// A tile of a terrain of whole metres, which floats hold in a national grid as well.
TestMesh make_tile(bool has_hills) {
  TestMesh tile = make_sheet(640, 64);
  for (std::size_t i = 0; i < tile.vertices.size() && has_hills; i += 3)
    tile.vertices[i + 2] = std::round(12 * std::sin(0.02f * tile.vertices[i]) *
                                      std::cos(0.03f * tile.vertices[i + 1]));
  return tile;
}

// 2^-24 of where the terrain is modelled would be 27 cm. That much may be taken off slopes along
// its border, which is left out.
TEST(ApiKnownDepth, OfABodyOnATerrainDoesNotGoByWhereThatIsModelled) {
  OdeWorld world;
  const BatchCollider collider;
  const Point far{500000, 4500000, 0};
  const dGeomID body = world.geom(world.mesh(make_cube(0.2)), {});
  for (const bool has_hills : {false, true}) {
    const TestMesh tile = make_tile(has_hills);
    const dGeomID here = world.geom(world.mesh(tile), {});
    const dGeomID there = world.geom(world.mesh(moved(tile, far)), {});
    Random random(3);
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
      TestPose pose = random.pose(0);  // over a corner of the ground
      const int row = 1 + random.below(63);
      const std::size_t corner = 3 * static_cast<std::size_t>(65 * row + 1 + random.below(63));
      for (std::size_t k = 0; k < 3; ++k) pose.position[k] = tile.vertices[corner + k];
      pose.position[2] += random.uniform(0.02, 0.09);
      set_pose(body, pose);
      const Contacts expected = answer_of(collider, body, here);
      pose.position = pose.position + far;
      set_pose(body, pose);
      const Contacts found = answer_of(collider, body, there);
      ASSERT_EQ(found.size(), expected.size()) << i;
      if (found.empty()) continue;
      EXPECT_NEAR(found[0].depth, expected[0].depth, 1e-8) << i;  // of doubles out there
      ++compared;
    }
    EXPECT_GT(compared, 190);
  }
}

// A box whose corners are doubles, which ODE sees as they are.
class DoubleBox {
 public:
  DoubleBox(const Point& lo, const Point& hi) : mesh_(make_cube(1)) {
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i)
      vertices_.push_back(mesh_.vertices[i] < 0 ? lo[i % 3] : hi[i % 3]);
    dGeomTriMeshDataBuildDouble(id_, vertices_.data(), 3 * sizeof(double),
                                static_cast<int>(vertices_.size() / 3), mesh_.indices.data(),
                                static_cast<int>(mesh_.indices.size()), 3 * sizeof(dTriIndex));
    geom_ = dCreateTriMesh(nullptr, id_, nullptr, nullptr, nullptr);
  }
  ~DoubleBox() {
    dGeomDestroy(geom_);
    dGeomTriMeshDataDestroy(id_);
  }
  DoubleBox(const DoubleBox&) = delete;
  DoubleBox& operator=(const DoubleBox&) = delete;

  dGeomID geom() const { return geom_; }

 private:
  TestMesh mesh_;
  std::vector<double> vertices_;
  dTriMeshDataID id_ = dGeomTriMeshDataCreate();
  dGeomID geom_;
};

bool boxes_overlap(dGeomID a, dGeomID b) {
  dReal of_a[6], of_b[6];
  dGeomGetAABB(a, of_a);
  dGeomGetAABB(b, of_b);
  for (int k = 0; k < 6; k += 2)
    if (of_a[k] > of_b[k + 1] || of_b[k] > of_a[k + 1]) return false;
  return true;
}

// A body at rest is pushed up to the last bit, step by step; out of ODE's boxes it would have no
// contact at all, fall, and meet the floor again.
TEST(ApiKnownDepth, LeavesBodiesInOdesBoxesOfEachOther) {
  OdeWorld world;
  const BatchCollider collider;
  Random random(4);
  for (const double far : {0.0, 10.0, 1000.0}) {  // of either from its own origin
    // Twice what floats make of meshes that are so large and so far out (pair_step.cl) [m].
    const double of_floats = 2 * 0x1p-20 * (far + 10);
    for (int i = 0; i < 100; ++i) {
      const auto place = [&] {
        return Point{random.uniform(-far, far), random.uniform(-far, far),
                     random.uniform(-far, far)};
      };
      const auto size = [&](double most) {
        return Point{random.uniform(0.1, most), random.uniform(0.1, most),
                     random.uniform(0.1, most)};
      };
      const Point a = place(), b = place(), half = size(0.5), ground = size(4);
      const DoubleBox body(a - half, a + half);
      const DoubleBox floor(b - ground, b + ground);
      const std::size_t axis = static_cast<std::size_t>(random.below(3));
      const double depth = of_floats * random.uniform(2, 20);
      Point up{};
      up[axis] = random.below(2) == 0 ? 1 : -1;
      const double apart = half[axis] + ground[axis] - depth;
      TestPose pose{b - a + apart * up};
      set_pose(body.geom(), pose);
      const Contacts found = answer_of(collider, body.geom(), floor.geom());
      ASSERT_FALSE(found.empty()) << far << ", " << i;
      pose.position = pose.position + found[0].depth * normal(found[0]);
      set_pose(body.geom(), pose);
      EXPECT_TRUE(boxes_overlap(body.geom(), floor.geom())) << far << ", " << i;
      EXPECT_GE(found[0].depth, depth - of_floats) << far << ", " << i;
    }
  }
}

// What is left of a depth goes by the small body, as what is taken off does: in 60 steps it was out
// of the ground's box while that was by the larger.
TEST(ApiKnownDepth, LeavesASmallBodyInOdesBoxOfALargeGround) {
  OdeWorld world;
  const BatchCollider collider;
  const dGeomID body = world.geom(world.mesh(make_cube(0.01)), {});
  const dGeomID ground = world.geom(world.mesh(make_sheet(16384, 1)), {});
  TestPose pose = at(3, 5, 0.0049);
  for (int step = 0; step < 1000; ++step) {
    set_pose(body, pose);
    const Contacts found = answer_of(collider, body, ground);
    ASSERT_TRUE(boxes_overlap(body, ground)) << step;
    ASSERT_FALSE(found.empty()) << step;
    pose.position = pose.position + found[0].depth * normal(found[0]);
  }
}

}  // namespace
}  // namespace ode_ext::test
