// SPDX-License-Identifier: BSD-3-Clause
// The deform step against the host's geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>

#include "mesh/exit_distance.h"
#include "mesh/normals.h"
#include "support/deform_rig.h"

namespace ode_ext::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A face's normal carries two divisions and a root, each right to 3 units of 2^-23, and a few
// roundings: 2^-19. A vertex's is a sum of such with angles as good; it is no shorter than half of
// its terms where no two faces meet at more than 120 degrees: 2^-18 with its own division.
constexpr double kFaceNormal = 0x1p-19;
constexpr double kVertexNormal = 0x1p-18;

double apart(Vec3f a, Vec3f b) { return length(Vec3d(a) - Vec3d(b)); }

std::vector<Vec3f> normals_of(const RecordsOfMesh& records) {
  std::vector<Vec3f> normals;
  for (const ox_vertex& vertex : records.vertices) normals.push_back(-vec(vertex.direction));
  return normals;
}

void expect_triangles(const Mesh& mesh, const RecordsOfMesh& records) {
  const MeshTopology& built = *mesh.topology;
  for (std::size_t k = 0; k < records.triangles.size(); ++k) {
    const ox_triangle& triangle = records.triangles[k];
    const Triangle& corners = built.triangles[k];
    EXPECT_EQ(vec(triangle.a), mesh.vertices[corners[0]]);
    EXPECT_EQ(vec(triangle.b), mesh.vertices[corners[1]]);
    EXPECT_EQ(vec(triangle.c), mesh.vertices[corners[2]]);
    EXPECT_LT(apart(vec(triangle.normal), Vec3f(face_normal(mesh, static_cast<std::uint32_t>(k)))),
              kFaceNormal);
  }
}

void expect_vertices(const Mesh& mesh, const RecordsOfMesh& records) {
  const Normals normals = compute_normals(mesh.vertices, mesh.topology->triangles);
  for (std::size_t v = 0; v < records.vertices.size(); ++v) {
    EXPECT_EQ(vec(records.vertices[v].position), mesh.vertices[v]);
    EXPECT_LT(apart(-vec(records.vertices[v].direction), normals.vertices[v]), kVertexNormal);
  }
}

// The boxes over meshlets: tight but for the margin, which is that of a rigid mesh.
void expect_nodes(const Mesh& mesh, const RecordsOfMesh& records) {
  const MeshTopology& built = *mesh.topology;
  const float margin = 0x1p-20f * records.mesh.extent;
  const Vec3f margins{margin, margin, margin};
  ASSERT_EQ(records.mesh.meshlet_node_count, built.meshlets.tree.size());
  for (std::size_t n = 0; n < records.meshlet_nodes.size(); ++n) {
    const ox_meshlet_node& node = records.meshlet_nodes[n];
    for (std::size_t k = 0; k < node.count; ++k) {
      Box box = empty_box();
      for (std::uint32_t m = node.first[k]; m < node.first[k + 1]; ++m) {
        const Meshlet& meshlet = built.meshlets.meshlets[m];
        for (std::uint32_t i = 0; i < meshlet.triangle_count; ++i)
          for (const std::uint32_t corner :
               built.triangles[built.meshlets.triangles[meshlet.triangle_first + i]])
            box = grown(box, mesh.vertices[corner]);
      }
      EXPECT_EQ((Vec3f{node.lo[0][k], node.lo[1][k], node.lo[2][k]}), box.lo - margins);
      EXPECT_EQ((Vec3f{node.hi[0][k], node.hi[1][k], node.hi[2][k]}), box.hi + margins);
    }
    for (std::size_t k = node.count; k < OX_LANES; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_GT(node.lo[axis][k], node.hi[axis][k]);
  }
}

// Tight but for rounding.
void expect_box(const Box& box, const ox_chunk& chunk) {
  EXPECT_EQ(vec(chunk.centre), centre(box));
  const Vec3d half(vec(chunk.half_size));
  const Vec3d needed = max(Vec3d(box.hi) - Vec3d(centre(box)), Vec3d(centre(box)) - Vec3d(box.lo));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GE(half[k], needed[k]);
    EXPECT_LE(half[k], needed[k] * (1 + 0x1p-21));  // three roundings
  }
}

void expect_chunks(const Mesh& mesh, const RecordsOfMesh& records) {
  const MeshTopology& built = *mesh.topology;
  float moved = 0;
  for (std::size_t i = 0; i < records.chunks.size(); ++i) {
    const ox_chunk& chunk = records.chunks[i];
    EXPECT_EQ(chunk.first, built.chunks[i].first);
    EXPECT_EQ(chunk.count, built.chunks[i].count);
    Box box = empty_box();
    float reach = 0, moved_of_chunk = 0;
    for (std::uint32_t v = chunk.first; v < chunk.first + chunk.count; ++v) {
      box = grown(box, mesh.vertices[v]);
      if (records.vertices[v].exit != kInfinity) reach = std::max(reach, records.vertices[v].exit);
      moved_of_chunk = std::max(moved_of_chunk, records.vertices[v].moved);
    }
    expect_box(box, chunk);
    EXPECT_EQ(chunk.reach, reach);
    EXPECT_EQ(chunk.moved, moved_of_chunk);
    moved = std::max(moved, chunk.moved);
  }
  EXPECT_EQ(records.mesh.moved, moved);
}

void expect_meshlets(const Mesh& mesh, const RecordsOfMesh& records) {
  const MeshTopology& built = *mesh.topology;
  ASSERT_EQ(records.mesh.meshlet_count, built.meshlets.meshlets.size());
  for (std::size_t i = 0; i < records.meshlets.size(); ++i) {
    const Meshlet& meshlet = built.meshlets.meshlets[i];
    const ox_meshlet& record = records.meshlets[i];
    const auto vertex = [&](std::uint32_t k) {
      const std::uint32_t used = k < meshlet.vertex_count ? k : 0;
      return mesh.vertices[built.meshlets.vertices[meshlet.vertex_first + used]];
    };
    Box box = empty_box();
    float low = kInfinity, high = -kInfinity;
    for (std::uint32_t k = 0; k < OX_LANES; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(record.vertex[axis][k], vertex(k)[axis]);
      box = grown(box, vertex(k));
      const float height = dot(vec(record.slab_normal), vertex(k));
      EXPECT_NEAR(std::clamp(height, record.slab_lo, record.slab_hi), height,
                  1e-6f * records.mesh.extent);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    for (std::uint32_t k = 0; k < meshlet.triangle_count; ++k) {
      const ox_triangle& triangle =
          records.triangles[record.triangle[k] - records.mesh.triangle_first];  // expect_triangles
      const bool has_area = vec(triangle.normal) != Vec3f{};
      EXPECT_EQ(record.with_area >> k & 1, has_area ? 1 : 0);
      const auto corner = [&](std::uint32_t c) {
        return vertex(record.places[k] >> OX_CORNER_SHIFT(c) & 255u);
      };
      EXPECT_EQ(vec(triangle.a), corner(0));
      if (!has_area) continue;
      EXPECT_EQ(vec(triangle.b), corner(1));
      EXPECT_EQ(vec(triangle.c), corner(2));
    }
    EXPECT_NEAR(low, record.slab_lo, 1e-6f * records.mesh.extent);
    EXPECT_NEAR(high, record.slab_hi, 1e-6f * records.mesh.extent);
    EXPECT_EQ(vec(record.lo), box.lo);
    EXPECT_EQ(vec(record.hi), box.hi);
  }
}

void expect_mesh(const Mesh& mesh, const RecordsOfMesh& records) {
  EXPECT_EQ(vec(records.mesh.box_centre), centre(mesh.box));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GE(records.mesh.box_centre[k] + records.mesh.box_half[k], mesh.box.hi[k]);
    EXPECT_LE(records.mesh.box_centre[k] - records.mesh.box_half[k], mesh.box.lo[k]);
  }
  EXPECT_EQ(records.mesh.radius, mesh.radius);
  EXPECT_EQ(records.mesh.mean_edge, mesh.mean_edge);
  EXPECT_EQ(records.mesh.flags,
            OX_MESH_DEFORMABLE | (mesh.closed() ? OX_MESH_CLOSED : OX_MESH_TWO_SIDED));
}

void expect_all(const Mesh& mesh, const RecordsOfMesh& records) {
  expect_triangles(mesh, records);
  expect_vertices(mesh, records);
  expect_nodes(mesh, records);
  expect_chunks(mesh, records);
  expect_meshlets(mesh, records);
  expect_mesh(mesh, records);
}

void expect_moved(const Mesh& before, const Mesh& after, const RecordsOfMesh& records) {
  for (std::size_t v = 0; v < records.vertices.size(); ++v) {
    const double moved = apart(before.vertices[v], after.vertices[v]);
    EXPECT_GE(static_cast<double>(records.vertices[v].moved), moved);
    EXPECT_LE(static_cast<double>(records.vertices[v].moved), moved * (1 + 0x1p-18));
  }
}

// Around the sizes of groups, and one mesh without triangles.
const std::array<std::size_t, 8> kCounts = {1, 2, 63, 64, 65, 0, 127, 1234};

MeshList strips() {
  MeshList list;
  for (const std::size_t count : kCounts) list.push_back(deformable(strip(count)));
  return list;
}

TEST(DeformStep, MakesSheetsAsTheyWereBuilt) {
  DeformRig rig;
  const MeshList list = strips();
  rig.set(list);
  for (std::uint32_t i = 0; i < list.size(); ++i) {
    SCOPED_TRACE(kCounts[i]);
    const RecordsOfMesh records = rig.read(i);
    expect_all(*list[i], records);
    EXPECT_EQ(records.mesh.moved, 0);
    for (const ox_vertex& vertex : records.vertices) EXPECT_EQ(vertex.exit, list[i]->mean_edge);
  }
}

TEST(DeformStep, FollowsSheetsOfAllSizesAtOnce) {
  DeformRig rig;
  const MeshList list = strips();
  rig.set(list);
  MeshList before = list;
  for (const float phase : {0.0f, 1.0f}) {
    MeshList shapes;
    for (std::size_t i = 0; i < list.size(); ++i)
      shapes.push_back(deformed(list[i], bent(strip(kCounts[i]), phase)));
    rig.set(shapes);
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      SCOPED_TRACE(kCounts[i]);
      const RecordsOfMesh records = rig.read(i);
      expect_all(*shapes[i], records);
      expect_moved(*before[i], *shapes[i], records);
      for (const ox_vertex& vertex : records.vertices) EXPECT_EQ(vertex.exit, shapes[i]->mean_edge);
    }
    before = shapes;
  }
}

TEST(DeformStep, LeavesWhatDoesNotMoveAlone) {
  DeformRig rig;
  const auto rigid = std::make_shared<const Mesh>(build_mesh(soup_of(make_cube(1, 3))));
  const auto one = deformable(strip(100)), two = deformable(strip(200));
  rig.set({one, rigid, two});
  const RecordsOfMesh one_before = rig.read(0), rigid_before = rig.read(1);
  const auto shape = deformed(two, bent(strip(200)));
  rig.set({one, rigid, shape});
  expect_all(*shape, rig.read(2));
  const auto bytes = [](const auto& records) {
    const auto* first = reinterpret_cast<const unsigned char*>(records.data());
    return std::vector<unsigned char>(first, first + records.size() * sizeof(records[0]));
  };
  for (const std::uint32_t i : {0u, 1u}) {
    const RecordsOfMesh& before = i == 0 ? one_before : rigid_before;
    const RecordsOfMesh after = rig.read(i);
    EXPECT_EQ(bytes(after.vertices), bytes(before.vertices));
    EXPECT_EQ(bytes(after.triangles), bytes(before.triangles));
    EXPECT_EQ(bytes(after.meshlet_nodes), bytes(before.meshlet_nodes));
    EXPECT_EQ(bytes(after.chunks), bytes(before.chunks));
  }
}

TEST(DeformStep, ForgetsHowFarAMeshMovedOnceItRests) {
  DeformRig rig;
  const auto base = deformable(strip(200)), other = deformable(strip(70));
  const auto shape = deformed(base, bent(strip(200)));
  const auto other_shape = deformed(other, bent(strip(70)));
  rig.set({base, other});
  rig.set({shape, other});
  const RecordsOfMesh moving = rig.read(0);
  EXPECT_GT(moving.mesh.moved, 0.05f);
  EXPECT_EQ(rig.read(1).mesh.moved, 0);
  rig.set({shape, other_shape});  // one rests as the other starts
  const RecordsOfMesh resting = rig.read(0);
  expect_all(*shape, resting);
  EXPECT_EQ(resting.mesh.moved, 0);
  for (const ox_vertex& vertex : resting.vertices) EXPECT_EQ(vertex.moved, 0);
  expect_moved(*other, *other_shape, rig.read(1));
  rig.set({shape, other_shape});
  EXPECT_EQ(rig.read(1).mesh.moved, 0);
}

TEST(DeformStep, KnowsHowFarAMeshMovedWhereOthersComeAndGo) {
  DeformRig rig;
  const auto base = deformable(strip(100)), other = deformable(strip(40));
  const auto shape = deformed(base, bent(strip(100)));
  rig.set({base, other});
  rig.set({shape});
  const RecordsOfMesh records = rig.read(0);
  expect_all(*shape, records);
  expect_moved(*base, *shape, records);
  rig.set({other, shape});
  expect_all(*shape, rig.read(1));
  EXPECT_EQ(rig.read(1).mesh.moved, 0);
}

TEST(DeformStep, TakesTheThicknessAskedForOfASheet) {
  DeformRig rig;
  const auto base = deformable(strip(70), 0.375f);
  rig.set({base});
  rig.set({deformed(base, bent(strip(70)))});
  for (const ox_vertex& vertex : rig.read(0).vertices) EXPECT_EQ(vertex.exit, 0.375f);
}

// With the device's own normals, so that only the rays differ: they are right to 16 roundings of
// the size (2^-20) across the face that they meet, along it at up to 16 times that.
TEST(DeformStep, CastsTheExitsOfClosedMeshes) {
  DeformRig rig;
  for (const TestMesh& mesh : {make_icosphere(0.6, 3), make_torus(0.5, 0.2, 24, 16),
                               make_plate(1.4, 0.1, 6), make_cube(1, 4)}) {
    const TriangleSoup soup = soup_of(mesh);
    const auto base = deformable(soup), shape = deformed(base, bent(soup));
    ASSERT_TRUE(shape->closed());
    rig.set({base});
    rig.set({shape});
    const RecordsOfMesh records = rig.read(0);
    expect_all(*shape, records);
    const std::vector<float> exits =
        exit_distances(shape->vertices, normals_of(records), base->topology->triangles,
                       build_bvh(shape->vertices, base->topology->triangles));
    std::size_t finite = 0;
    for (std::size_t v = 0; v < exits.size(); ++v) {
      if (exits[v] == kInfinity) {
        EXPECT_EQ(records.vertices[v].exit, kInfinity);
        continue;
      }
      EXPECT_NEAR(records.vertices[v].exit, exits[v], 0x1p-16f * 2 * shape->radius);
      ++finite;
    }
    EXPECT_GT(finite, exits.size() / 2);
  }
}

TEST(DeformStep, CastsNoExitAtAFaceTheVertexLiesOn) {
  // As Exits.PassOverAFaceTheVertexLiesOn: a small box glued onto a large one.
  const TriangleSoup soup = soup_of(
      merged(moved(make_box({8, 8, 1}), {0, 0, -0.5}), moved(make_box({2, 2, 2}), {0, -0.5, 1})));
  DeformRig rig;
  rig.set({deformable(soup)});
  int checked = 0;
  for (const ox_vertex& vertex : rig.read(0).vertices) {
    if (vertex.position[2] != 0 || std::fabs(vertex.position[0]) != 1) continue;
    EXPECT_NEAR(vertex.exit, 2 * std::sqrt(3.0f), 1e-5f);
    ++checked;
  }
  EXPECT_EQ(checked, 4);
}

TEST(DeformStep, TakesTheAreaOutOfFlatTriangles) {
  // Three corners on a line, exactly, and a triangle beside them.
  const Vec3f start{0.125f, 0, 0}, step{0.015625f, 0.03125f, 0.0625f};
  const TriangleSoup round{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}, {4, 0, 0}, {3, 1, 0}};
  TriangleSoup flat = round;
  for (std::size_t i = 0; i < 3; ++i) flat[i] = start + static_cast<float>(i) * step;
  DeformRig rig;
  const auto base = deformable(round), shape = deformed(base, flat);
  rig.set({base});
  expect_all(*base, rig.read(0));
  rig.set({shape});
  const RecordsOfMesh records = rig.read(0);
  int flats = 0;
  for (std::size_t t = 0; t < records.triangles.size(); ++t) {
    const ox_triangle& triangle = records.triangles[t];
    if (t != 0) {
      EXPECT_EQ(vec(triangle.normal), (Vec3f{0, 0, 1}));
      continue;
    }
    ++flats;
    EXPECT_EQ(vec(triangle.a), flat[0]);
    EXPECT_EQ(vec(triangle.b), flat[0]);
    EXPECT_EQ(vec(triangle.c), flat[0]);
    EXPECT_EQ(vec(triangle.normal), Vec3f{});
  }
  EXPECT_EQ(flats, 1);
  expect_nodes(*shape, records);  // boxes hold all three corners still
  for (const ox_vertex& vertex : records.vertices) {
    const bool lonely = vertex.position[0] < 2;
    EXPECT_EQ(vec(vertex.direction), lonely ? Vec3f{} : (Vec3f{0, 0, -1}));
    EXPECT_EQ(vertex.exit, lonely ? 0 : shape->mean_edge);
  }
}

TEST(DeformStep, KeepsTheNormalsOfThinTriangles) {
  Random random(7);
  TriangleSoup soup;
  for (int i = 0; i < 200; ++i) {
    const Vec3f origin{static_cast<float>(i), 0, 0};
    const Point d = random.direction(), e = random.direction();
    const double thin = std::pow(10.0, -random.uniform(0, 6));
    soup.push_back(origin);
    soup.push_back(origin + Vec3f(Vec3d{d[0], d[1], d[2]}));
    soup.push_back(origin +
                   Vec3f(Vec3d{d[0] + thin * e[0], d[1] + thin * e[1], d[2] + thin * e[2]}));
  }
  DeformRig rig;
  const auto mesh = deformable(soup);
  ASSERT_EQ(mesh->topology->triangles.size(), 200u);
  rig.set({mesh});
  const RecordsOfMesh records = rig.read(0);
  expect_triangles(*mesh, records);
  // One face a vertex. (The host's sums, in fixed point, tell small angles less well.)
  for (std::size_t k = 0; k < records.triangles.size(); ++k)
    for (const std::uint32_t corner : mesh->topology->triangles[k])
      EXPECT_LT(apart(-vec(records.vertices[corner].direction), vec(records.triangles[k].normal)),
                0x1p-21);  // a product, a root, a division
}

TEST(DeformStep, TakesTheLargestFaceWhereNormalsCancel) {
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, far{2, 0, 0};
  DeformRig rig;
  const auto mesh = deformable({a, b, c, a, c, far});
  rig.set({mesh});
  const RecordsOfMesh records = rig.read(0);
  const Vec3f up{0, 0, 1}, down{0, 0, -1};
  for (const ox_vertex& vertex : records.vertices)
    EXPECT_EQ(-vec(vertex.direction), vec(vertex.position) == b ? up : down);
}

// A fan of 1234 triangles about one vertex.
TEST(DeformStep, SumsManyFacesAtAVertex) {
  TriangleSoup soup;
  const auto rim = [](int i) {
    const double angle = 2 * 3.14159265358979 * (i % 1234) / 1234;
    return Vec3f(Vec3d{std::cos(angle), std::sin(angle), 0.1 * std::sin(3 * angle)});
  };
  for (int i = 0; i < 1234; ++i) soup.insert(soup.end(), {{0, 0, 0.25f}, rim(i), rim(i + 1)});
  DeformRig rig;
  const auto mesh = deformable(soup);
  rig.set({mesh});
  expect_all(*mesh, rig.read(0));
}

TEST(DeformStep, WorksAtEveryScale) {
  for (const float scale : {1e-12f, 1e-3f, 1e6f, 1e15f}) {
    SCOPED_TRACE(scale);
    TriangleSoup soup = soup_of(make_torus(0.5, 0.2, 12, 8)), target = bent(soup);
    for (Vec3f& p : soup) p = scale * p;
    for (Vec3f& p : target) p = scale * p;
    const auto base = deformable(soup), shape = deformed(base, target);
    DeformRig rig;
    rig.set({base});
    rig.set({shape});
    const RecordsOfMesh records = rig.read(0);
    expect_all(*shape, records);
    expect_moved(*base, *shape, records);
  }
}

// The records of a vertex by its place.
using VertexBits = std::map<std::array<float, 3>, std::array<float, 4>>;
VertexBits vertices_by_place(const RecordsOfMesh& records) {
  VertexBits bits;
  for (const ox_vertex& v : records.vertices)
    bits[{v.position[0], v.position[1], v.position[2]}] = {v.direction[0], v.direction[1],
                                                           v.direction[2], v.exit};
  return bits;
}

TEST(DeformStep, GivesTheSameBitsHoweverAMeshCameToItsShape) {
  for (const TriangleSoup& soup :
       {soup_of(make_sheet(1, 20)), soup_of(make_torus(0.5, 0.2, 24, 16)),
        soup_of(inverted(make_icosphere(0.6, 2)))}) {
    const TriangleSoup target = bent(soup, 2);
    const auto base = deformable(soup), fresh = deformable(target);
    DeformRig rig;
    rig.set({base});
    rig.set({deformed(base, bent(soup, 1))});
    rig.set({deformed(base, target)});
    const RecordsOfMesh followed = rig.read(0);
    rig.set({fresh});
    const RecordsOfMesh built = rig.read(0);
    EXPECT_EQ(vertices_by_place(followed), vertices_by_place(built));
    EXPECT_EQ(vertices_by_place(followed).size(), followed.vertices.size());
    ASSERT_EQ(followed.triangles.size(), built.triangles.size());
    EXPECT_EQ(std::memcmp(followed.triangles.data(), built.triangles.data(),
                          built.triangles.size() * sizeof(ox_triangle)),
              0);
    EXPECT_EQ(vec(followed.mesh.box_centre), vec(built.mesh.box_centre));
    EXPECT_EQ(vec(followed.mesh.box_half), vec(built.mesh.box_half));
    EXPECT_EQ(followed.mesh.extent, built.mesh.extent);
    EXPECT_EQ(followed.mesh.radius, built.mesh.radius);
    EXPECT_EQ(followed.mesh.mean_edge, built.mesh.mean_edge);
  }
}

}  // namespace
}  // namespace ode_ext::test
