// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/isolation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/ray_cast.h"
#include "geometry/triangle_distance.h"
#include "shapes.h"

namespace ode_ext {
namespace {

std::vector<Isolation> isolation_of(const Mesh& mesh) {
  return isolation(mesh.vertices, mesh.triangles, mesh.face_normals, mesh.bvh, mesh.neighbours);
}

Corners corners(const Mesh& mesh, std::size_t i) {
  const Triangle& t = mesh.triangles[i];
  return {Vec3d(mesh.vertices[t[0]]), Vec3d(mesh.vertices[t[1]]), Vec3d(mesh.vertices[t[2]])};
}

// As a device computes it.
Vec3d middle_in_floats(const Mesh& mesh, std::size_t i) {
  const Triangle& t = mesh.triangles[i];
  const Vec3f sum = mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]];
  return Vec3d((1.0f / 3) * sum);
}

// Those nearer to the middle than the radius, and which of them connect to triangle i.
std::vector<std::uint32_t> inside_ball(const Mesh& mesh, Vec3d middle, double radius) {
  std::vector<std::uint32_t> inside;
  for (std::uint32_t j = 0; j < mesh.triangles.size(); ++j) {
    if (squared_distance(middle, corners(mesh, j)) < radius * radius) inside.push_back(j);
  }
  return inside;
}

std::size_t connected(const Mesh& mesh, std::uint32_t from, std::vector<std::uint32_t> among) {
  std::vector<std::uint32_t> queue{from};
  std::erase(among, from);
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const std::uint32_t next : mesh.neighbours[queue[head]]) {
      if (std::erase(among, next) > 0) queue.push_back(next);
    }
  }
  return queue.size();
}

void expect_one_sheet(const Mesh& mesh, std::uint32_t i, double radius, double cosine) {
  if (radius == 0) return;
  const std::vector<std::uint32_t> inside = inside_ball(mesh, middle_in_floats(mesh, i), radius);
  EXPECT_EQ(connected(mesh, i, inside), inside.size()) << i;
  const Vec3d own(mesh.face_normals[i]);
  for (const std::uint32_t j : inside) {
    EXPECT_GE(dot(own, Vec3d(mesh.face_normals[j])), cosine) << i << " " << j;
  }
}

TriangleSoup dented_sphere(int rows) {
  TriangleSoup soup = shapes::sphere(1, rows);
  for (Vec3f& p : soup) {
    p = (1 + 0.2f * std::sin(5 * p.x) * std::cos(7 * p.y) * std::sin(4 * p.z)) * p;
  }
  return soup;
}

// Ways from one triangle to a near one may lead around several holes.
TriangleSoup perforated_sheet(unsigned seed) {
  std::mt19937 random(seed);
  const TriangleSoup whole = shapes::sheet(12);
  TriangleSoup soup;
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    if (random() % 3 != 0) shapes::append(soup, whole[i], whole[i + 1], whole[i + 2]);
  }
  return soup;
}

std::vector<TriangleSoup> test_soups() {
  return {shapes::tetrahedron(),
          shapes::box({0, 0, 0}, {1, 1, 1}, 5),
          shapes::sphere(1, 16),
          shapes::torus(1, 0.3, 24),
          dented_sphere(14),
          shapes::moved(dented_sphere(12), 0.1f, {80, -90, 100}),
          shapes::box({0, 0, 0}, {1, 1, 0.05f}, 8),
          shapes::random_soup(300, 5),
          perforated_sheet(1),
          perforated_sheet(2),
          perforated_sheet(3)};
}

TEST(Isolation, BallsHoldOneSheetThatFacesOneWay) {
  for (const TriangleSoup& soup : test_soups()) {
    const Mesh mesh = build_mesh(soup);
    const std::vector<Isolation> balls = isolation_of(mesh);
    ASSERT_EQ(balls.size(), mesh.triangles.size());
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
      expect_one_sheet(mesh, i, balls[i].within_10, 0.98480775301220806);
      expect_one_sheet(mesh, i, balls[i].within_30, std::sqrt(0.75));
      expect_one_sheet(mesh, i, balls[i].within_60, 0.5);
      EXPECT_LE(balls[i].within_10, balls[i].within_30);
      EXPECT_LE(balls[i].within_30, balls[i].within_60);
    }
  }
}

// Where the line meets the triangle; empty if it does not.
std::vector<Vec3d> met(Vec3d origin, Vec3d direction, const Corners& t) {
  const Vec3d first = t[1] - t[0], second = t[2] - t[0], from = origin - t[0];
  const Vec3d across = cross(direction, second);
  const double determinant = dot(first, across);
  const double u = dot(from, across) / determinant;
  const double v = dot(direction, cross(from, first)) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) return {};
  return {t[0] + u * first + v * second};
}

TEST(Isolation, SteepLinesMeetOneTriangleAtMostInsideABall) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> part(0, 1);
  const auto direction = [&] {
    const Vec3d d{normal(random), normal(random), normal(random)};
    return (1 / length(d)) * d;
  };
  for (const TriangleSoup& soup : {shapes::box({0, 0, 0}, {1, 1, 1}, 3), shapes::torus(1, 0.3, 14),
                                   dented_sphere(10), shapes::box({0, 0, 0}, {1, 1, 0.05f}, 4)}) {
    const Mesh mesh = build_mesh(soup);
    ASSERT_EQ(mesh.isolation.size(), mesh.triangles.size());
    std::size_t lines = 0, meetings = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Vec3d middle = middle_in_floats(mesh, i);
      for (int trial = 0; trial < 40; ++trial) {
        const bool narrow = trial % 2 == 0;
        const double radius = narrow ? mesh.isolation[i].within_30 : mesh.isolation[i].within_60;
        const double steep = narrow ? 0.5 : std::sqrt(0.75);  // sine of the angle
        const Vec3d along = direction();
        if (std::fabs(dot(along, Vec3d(mesh.face_normals[i]))) <= steep) continue;
        const Vec3d origin = middle + (radius * std::cbrt(part(random))) * direction();
        std::size_t inside = 0;
        for (std::size_t j = 0; j < mesh.triangles.size(); ++j) {
          for (const Vec3d& place : met(origin, along, corners(mesh, j))) {
            inside += length(place - middle) < radius;
          }
        }
        EXPECT_LE(inside, 1u);
        meetings += inside;
        ++lines;
      }
    }
    EXPECT_GT(lines, 5 * mesh.triangles.size());
    EXPECT_GT(2 * meetings, lines);  // most do meet one
  }
}

TEST(Isolation, OfACubeReachesTheNextSide) {
  for (const Isolation& ball : build_mesh(shapes::cube()).isolation) {
    // The middle is a third from the sides; what it can be off by is subtracted.
    EXPECT_LT(ball.within_30, 1 / 3.0 - 0x1p-22);
    EXPECT_GT(ball.within_30, 1 / 3.0 - 0x1p-20);
    EXPECT_EQ(ball.within_60, ball.within_30);
  }
}

TEST(Isolation, OfAFineSphereReachesBeyondTheTriangle) {
  const Mesh mesh = build_mesh(shapes::sphere(1, 40));
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    EXPECT_GT(mesh.isolation[i].within_30, 0);
    const Corners t = corners(mesh, i);
    const Vec3d middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
    beyond += mesh.isolation[i].within_30 >
              std::max({length(t[0] - middle), length(t[1] - middle), length(t[2] - middle)});
  }
  EXPECT_GT(beyond, mesh.triangles.size() * 9 / 10);
}

TEST(Isolation, TellsFoldsOf45DegreesApart) {
  // An octagonal column: between its sides are 45 degrees, between them and the lids 90.
  TriangleSoup soup;
  for (int i = 0; i < 8; ++i) {
    const auto corner = [](int k, float z) {
      const double angle = k % 8 * std::numbers::pi / 4;
      return Vec3f{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), z};
    };
    shapes::append(soup, corner(i, -3), corner(i + 1, -3), corner(i + 1, 3));
    shapes::append(soup, corner(i, -3), corner(i + 1, 3), corner(i, 3));
    shapes::append(soup, corner(i, 3), corner(i + 1, 3), {0, 0, 3});
    shapes::append(soup, corner(i + 1, -3), corner(i, -3), {0, 0, -3});
  }
  const Mesh mesh = build_mesh(soup);
  const double side = 2 * std::sin(std::numbers::pi / 8);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.face_normals[i].z != 0) continue;
    EXPECT_NEAR(mesh.isolation[i].within_30, side / 3, 1e-5);  // to the nearer side
    EXPECT_NEAR(mesh.isolation[i].within_60, 1 - 0.5 / 3, 0.2);
    EXPECT_GT(mesh.isolation[i].within_60, 1.5 * mesh.isolation[i].within_30);
  }
}

TEST(Isolation, EndsAtASecondSheetThatFacesTheSameWay) {
  for (const float gap : {0.01f, 0.05f}) {
    const TriangleSoup both =
        shapes::joined(shapes::sheet(10), shapes::moved(shapes::sheet(10), 1, {0, 0, gap}));
    for (const Isolation& ball : isolation_of(build_mesh(both))) {
      EXPECT_LT(ball.within_30, gap);
      EXPECT_GT(ball.within_30, 0.999f * gap);
      EXPECT_EQ(ball.within_60, ball.within_30);
    }
  }
}

TEST(Isolation, RunsAcrossTrianglesWithoutArea) {
  const Vec3f left{0, 0, 0}, middle{1, 0, 0}, right{2, 0, 0}, top{1, 1.5f, 0}, low{1, -1.5f, 0};
  const TriangleSoup around{left, right, top, left, low, middle, middle, low, right};
  TriangleSoup soup = around;
  shapes::append(soup, left, middle, right);
  const Mesh mesh = build_mesh(soup);
  const auto place = [](const Mesh& of, std::uint32_t number) {
    return static_cast<std::size_t>(
        std::find(of.source_triangle.begin(), of.source_triangle.end(), number) -
        of.source_triangle.begin());
  };
  ASSERT_EQ(mesh.face_normals[place(mesh, 3)], Vec3f{});
  const std::vector<Isolation> balls = isolation_of(mesh);
  // The middle is at a third of the height, so a lower corner is the farthest; nothing else limits.
  EXPECT_NEAR(balls[place(mesh, 0)].within_30, 4 * std::sqrt(1.25), 1e-5);
  EXPECT_EQ(balls[place(mesh, 3)].within_60, 0);

  // Without it, those below are another sheet.
  const Mesh without = build_mesh(around);
  EXPECT_NEAR(isolation_of(without)[place(without, 0)].within_30, 0.5, 1e-5);
}

TEST(Isolation, IsNotLimitedByTrianglesWithoutArea) {
  TriangleSoup soup{{0, 0, 0}, {2, 0, 0}, {1, 1.5f, 0}};
  const float alone = isolation_of(build_mesh(soup))[0].within_30;
  EXPECT_NEAR(alone, 4 * std::sqrt(1.25), 1e-5);
  shapes::append(soup, {0, 0, 0.25f}, {0.5f, 0, 0.25f}, {2, 0, 0.25f});
  EXPECT_EQ(isolation_of(build_mesh(soup))[0].within_30, alone);
}

TEST(Isolation, IsComputedOfSolidsOnlyAndIfAskedFor) {
  EXPECT_EQ(build_mesh(shapes::cube()).isolation.size(), 12u);
  EXPECT_TRUE(build_mesh(shapes::cube(), {.isolation = false}).isolation.empty());
  EXPECT_TRUE(build_mesh(shapes::sheet(3)).isolation.empty());
  EXPECT_TRUE(build_mesh(shapes::torus(0.3, 1, 24)).isolation.empty());
  EXPECT_TRUE(build_mesh({}).isolation.empty());
}

TEST(Isolation, ScalesWithTheMesh) {
  const Mesh unit = build_mesh(dented_sphere(10));
  for (const float scale : {0x1p-20f, 0x1p20f}) {  // powers of two, so that nothing is rounded
    const Mesh mesh = build_mesh(shapes::moved(dented_sphere(10), scale, {}));
    ASSERT_EQ(mesh.isolation.size(), unit.isolation.size());
    for (std::size_t i = 0; i < unit.isolation.size(); ++i) {
      EXPECT_EQ(mesh.isolation[i].within_30, scale * unit.isolation[i].within_30);
      EXPECT_EQ(mesh.isolation[i].within_60, scale * unit.isolation[i].within_60);
    }
  }
}

}  // namespace
}  // namespace ode_ext
