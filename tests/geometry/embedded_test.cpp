// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/embedded.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "falling_objects/shapes.h"
#include "geometry/triangle_distance.h"
#include "shapes.h"

namespace ode_ext {
namespace {

using shapes::joined;
using shapes::moved;
using shapes::turned;

bool embedded(const Mesh& mesh) {
  return is_embedded(mesh.vertices, mesh.triangles, mesh.neighbours, mesh.bvh, mesh.face_normals);
}

Mesh built(const TriangleSoup& soup) {
  return build_mesh(soup, {.grids = false, .isolation = false});
}

// Of a closed mesh whose winding is taken as it is.
bool embedded(const TriangleSoup& soup) {
  const Mesh mesh = built(soup);
  EXPECT_TRUE(mesh.closed);
  EXPECT_FALSE(mesh.inverted);
  EXPECT_FALSE(mesh.reoriented);
  return embedded(mesh);
}

TriangleSoup placed(const TriangleSoup& soup, Vec3f offset) { return moved(soup, 1, offset); }

// About an axis that is none of the mesh's.
TriangleSoup tilted(TriangleSoup soup) {
  const Vec3d axis{2 / 7.0, 3 / 7.0, 6 / 7.0};
  for (Vec3f& corner : soup) {
    const Vec3d p(corner);
    corner = Vec3f(std::cos(1.0) * p + std::sin(1.0) * cross(axis, p) +
                   ((1 - std::cos(1.0)) * dot(axis, p)) * axis);
  }
  return soup;
}

TriangleSoup letter_l() {
  const std::array<Vec3f, 6> rim{
      {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}};
  const Vec3f up{0, 0, 1};
  TriangleSoup soup;
  for (std::size_t i = 1; i + 1 < rim.size(); ++i) {
    shapes::append(soup, rim[0], rim[i + 1], rim[i]);
    shapes::append(soup, rim[0] + up, rim[i] + up, rim[i + 1] + up);
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vec3f a = rim[i], b = rim[(i + 1) % rim.size()];
    shapes::append(soup, a, b, b + up);
    shapes::append(soup, a, b + up, a + up);
  }
  return soup;
}

TriangleSoup outward_tetrahedron(Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
  const TriangleSoup soup{a, c, b, a, b, d, b, c, d, c, a, d};
  return built(soup).inverted ? turned(soup) : soup;
}

// Two cones base to base.
TriangleSoup double_cone(int sides) {
  TriangleSoup soup;
  const auto corner = [&](int i) {
    const auto [c, s] = shapes::on_circle(i == sides ? 0 : static_cast<double>(i) / sides);
    return Vec3f(Vec3d{c, s, 0});
  };
  for (int i = 0; i < sides; ++i) {
    shapes::append(soup, corner(i), corner(i + 1), {0, 0, 1});
    shapes::append(soup, corner(i + 1), corner(i), {0, 0, -1});
  }
  return soup;
}

TEST(Embedded, AreSolidsOfManyShapes) {
  for (const TriangleSoup& soup :
       {shapes::tetrahedron(), shapes::cube(), shapes::box({0, 0, 0}, {1, 2, 3}, 6, 0x2a),
        shapes::sphere(1, 20), shapes::torus(1, 0.3, 24), letter_l(), double_cone(100)}) {
    EXPECT_TRUE(embedded(soup));
    EXPECT_TRUE(embedded(tilted(soup)));
    EXPECT_TRUE(embedded(joined(soup, placed(soup, {5, 0, 0}))));
  }
}

TEST(Embedded, AreTheShapesOfTheDemo) {
  for (const auto& [name, mesh] : falling_objects::make_shapes()) {
    TriangleSoup soup;
    for (const unsigned i : mesh.indices) {
      soup.push_back({mesh.vertices[3 * i], mesh.vertices[3 * i + 1], mesh.vertices[3 * i + 2]});
    }
    EXPECT_TRUE(embedded(soup)) << name;
  }
}

TEST(Embedded, IsASolidWithCavities) {
  const TriangleSoup box = shapes::box({-2, -2, -2}, {2, 2, 2}, 2);
  const TriangleSoup hollow = joined(box, turned(shapes::sphere(0.8, 10)));
  EXPECT_TRUE(embedded(hollow));
  EXPECT_TRUE(embedded(joined(hollow, shapes::sphere(0.5, 8))));  // a solid in the cavity
  EXPECT_TRUE(embedded(joined(hollow, placed(turned(shapes::tetrahedron()), {0.9f, 0.9f, 0.9f}))));
  EXPECT_FALSE(embedded(joined(hollow, turned(shapes::sphere(0.5, 8)))));
}

TEST(Embedded, AreNotPartsInsideASolidThatFaceOutward) {
  const TriangleSoup ball = shapes::sphere(1, 16);
  EXPECT_FALSE(embedded(joined(ball, shapes::sphere(0.5, 16))));
  EXPECT_FALSE(embedded(joined(shapes::sphere(0.5, 16), ball)));
  // Two inside face one another, as parts outside would.
  const TriangleSoup cube = shapes::box({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f});
  const TriangleSoup two = joined(placed(cube, {0.3f, 0, 0}), placed(cube, {-0.3f, 0, 0}));
  EXPECT_TRUE(embedded(two));
  EXPECT_FALSE(embedded(joined(ball, two)));
  EXPECT_TRUE(embedded(joined(ball, turned(two))));
}

TEST(Embedded, AreNotPartsInsideOut) {
  EXPECT_FALSE(embedded(
      joined(shapes::box({0, 0, 0}, {2, 2, 2}), turned(placed(shapes::cube(), {4, 0, 0})))));
  EXPECT_FALSE(embedded(joined(turned(placed(shapes::sphere(0.5, 8), {0, 0, 4})),
                               shapes::box({0, 0, 0}, {2, 2, 2}))));
}

TEST(Embedded, AreNotPartsThatOverlap) {
  const TriangleSoup cube = shapes::cube();
  EXPECT_FALSE(embedded(joined(cube, placed(cube, {0.5f, 0.4f, 0.3f}))));
  EXPECT_FALSE(embedded(joined(cube, tilted(cube))));
  EXPECT_FALSE(embedded(joined(cube, turned(shapes::box({0.3f, 0.3f, 0.3f}, {0.6f, 0.6f, 1.2f})))));
}

TEST(Embedded, IsNotASurfaceThatCrossesItself) {
  EXPECT_FALSE(embedded(shapes::torus(0.3, 1, 24)));
  // A corner of a box pushed out through the opposite side.
  TriangleSoup pushed = shapes::box({0, 0, 0}, {1, 1, 1}, 3);
  for (Vec3f& corner : pushed) {
    if (corner == Vec3f{1, 1, 1}) corner = {0.4f, 0.45f, -0.2f};
  }
  EXPECT_FALSE(embedded(pushed));
}

TEST(Embedded, AreNotPartsThatTouchOrNearlyDo) {
  const TriangleSoup cube = shapes::cube();
  const TriangleSoup peg = shapes::box({0, 0.25f, 0.25f}, {1, 0.75f, 0.75f});
  const float diagonal = std::sqrt(6.0f);
  for (const float gap : {0.0f, 0x1p-20f, 0x1p-19f}) {
    EXPECT_FALSE(embedded(joined(cube, placed(peg, {1 + gap * diagonal, 0, 0}))));
    EXPECT_FALSE(embedded(joined(cube, placed(cube, {1 + gap * diagonal, 0.5f, 0.5f}))));
  }
  EXPECT_TRUE(embedded(joined(cube, placed(peg, {1 + 0x1p-16f * diagonal, 0, 0}))));
  // Far from the origin, roundings are of the distance from it.
  EXPECT_FALSE(embedded(placed(joined(cube, placed(peg, {1 + 0x1p-10f, 0, 0})), {1024, 0, 0})));
}

TEST(Embedded, AreNotPartsOfWhichATipNearlyTouchesASideOrAnEdgeAnother) {
  const auto tip = [](float height) {
    return outward_tetrahedron({0.3f, 0.6f, height}, {0.2f, 0.5f, 3}, {0.6f, 0.5f, 3},
                               {0.4f, 0.9f, 3});
  };
  const auto lower = outward_tetrahedron({-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1});
  const auto upper = [](float height) {
    return outward_tetrahedron({0, -1, height}, {0, 1, height}, {1, 0, 2}, {-1, 0, 2});
  };
  const TriangleSoup cube = shapes::cube();
  for (const auto& [gap, expected] : {std::pair{0x1p-19f, false}, std::pair{0x1p-14f, true}}) {
    EXPECT_EQ(embedded(joined(cube, tip(1 + gap))), expected);
    EXPECT_EQ(embedded(joined(tip(1 + gap), cube)), expected);
    EXPECT_EQ(embedded(joined(lower, upper(gap))), expected);
    EXPECT_EQ(embedded(joined(upper(gap), lower)), expected);
  }
}

TEST(Embedded, IsNotAPlateThinnerThanRounding) {
  EXPECT_FALSE(embedded(shapes::box({0, 0, 0}, {1, 1, 0x1p-20f}, 2)));
  EXPECT_TRUE(embedded(shapes::box({0, 0, 0}, {1, 1, 0x1p-14f}, 2)));
}

TEST(Embedded, IsNotASurfaceFoldedOntoItself) {
  // A tetrahedron pressed flat, from the side and so that two of its sides lie inside a third.
  const Vec3f a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  for (const Vec3f& d : {Vec3f{3, 3, 0}, Vec3f{1, 1, 0}, Vec3f{1, 1, 0x1p-18f}}) {
    const Mesh mesh = built({a, c, b, a, b, d, b, c, d, c, a, d});
    EXPECT_TRUE(mesh.closed);
    EXPECT_FALSE(embedded(mesh));
  }
  EXPECT_TRUE(embedded({a, c, b, a, b, {1, 1, 1}, b, c, {1, 1, 1}, c, a, {1, 1, 1}}));
}

TEST(Embedded, MayMeetAtACornerThatIsWelded) {
  const TriangleSoup cube = shapes::cube();
  const Vec3f corner{0, 0, 0};
  EXPECT_TRUE(embedded(joined(cube, placed(cube, {1, 1, 1}))));
  EXPECT_TRUE(
      embedded(joined(cube, outward_tetrahedron(corner, {-1, 0, -1}, {0, -1, -1}, {-1, -1, -1}))));
  // Inside it a cavity may, a solid not; nor what comes out elsewhere or lies on a side.
  const TriangleSoup inside =
      outward_tetrahedron(corner, {0.5f, 0.2f, 0.3f}, {0.2f, 0.5f, 0.3f}, {0.3f, 0.3f, 0.6f});
  EXPECT_TRUE(embedded(joined(cube, turned(inside))));
  EXPECT_FALSE(embedded(joined(cube, inside)));
  EXPECT_FALSE(embedded(joined(
      cube, outward_tetrahedron(corner, {0.5f, 0.4f, 2}, {0.4f, 0.5f, 2}, {0.6f, 0.6f, 2}))));
  EXPECT_FALSE(embedded(joined(
      cube, outward_tetrahedron(corner, {0.5f, 0.3f, 0}, {0.3f, 0.5f, 0}, {0.4f, 0.4f, -1}))));
}

TEST(Embedded, IsNoOpenMesh) {
  EXPECT_FALSE(embedded(built(shapes::sheet(4))));
  EXPECT_FALSE(embedded(built({})));
  const TriangleSoup two = joined(shapes::cube(), shapes::box({1, 1, 0}, {2, 2, 1}));
  EXPECT_FALSE(embedded(built(two)));
}

TEST(Embedded, IsNotToldOfMeshesThatTakeTooLong) {
  EXPECT_FALSE(embedded(double_cone(3000)));  // 9 million pairs meet at the tips
}

// The slow way, without tolerance: for two closed parts.
bool parts_meet(const Mesh& mesh, std::size_t first_of_second) {
  std::vector<std::size_t> places(mesh.triangles.size());  // by the program's numbers
  for (std::size_t i = 0; i < places.size(); ++i) places[mesh.source_triangle[i]] = i;
  const auto corners = [&](std::size_t i) {
    const Triangle& t = mesh.triangles[places[i]];
    return Corners{Vec3d(mesh.vertices[t[0]]), Vec3d(mesh.vertices[t[1]]),
                   Vec3d(mesh.vertices[t[2]])};
  };
  const auto is_inside = [&](Vec3d p, std::size_t from, std::size_t to) {
    std::size_t crossed = 0;
    for (std::size_t i = from; i < to; ++i) {
      crossed += crosses({p, p + Vec3d{10.1, 11.3, 12.7}}, corners(i));
    }
    return crossed % 2 == 1;
  };
  const std::size_t count = mesh.triangles.size();
  if (is_inside(corners(0)[0], first_of_second, count)) return true;
  if (is_inside(corners(first_of_second)[0], 0, first_of_second)) return true;
  for (std::size_t i = 0; i < first_of_second; ++i) {
    for (std::size_t j = first_of_second; j < count; ++j) {
      const Corners a = corners(i), b = corners(j);
      for (std::size_t k = 0; k < 3; ++k) {
        if (crosses({a[k], a[(k + 1) % 3]}, b) || crosses({b[k], b[(k + 1) % 3]}, a)) return true;
      }
    }
  }
  return false;
}

TEST(Embedded, AreTwoPartsExactlyIfTheyDoNotMeet) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-1, 1);
  const auto random_tetrahedron = [&] {
    std::array<Vec3f, 4> p;
    for (Vec3f& corner : p) corner = {place(random), place(random), place(random)};
    return outward_tetrahedron(p[0], p[1], p[2], p[3]);
  };
  int meeting = 0, apart = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Mesh mesh = built(joined(random_tetrahedron(), random_tetrahedron()));
    ASSERT_FALSE(mesh.inverted);
    const bool meet = parts_meet(mesh, 4);
    EXPECT_EQ(embedded(mesh), !meet) << trial;
    ++(meet ? meeting : apart);
  }
  EXPECT_GT(meeting, 200);
  EXPECT_GT(apart, 200);
}

}  // namespace
}  // namespace ode_ext
