// SPDX-License-Identifier: BSD-3-Clause
// Meshes that come and go, against the same ones placed afresh.
#include "search/device_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "opencl/error.h"
#include "search/deform_topology.h"
#include "support/deform_rig.h"

namespace ode_ext::test {
namespace {

using Bytes = std::vector<unsigned char>;

template <class T>
Bytes bytes_of(const std::vector<T>& records) {
  const auto* first = reinterpret_cast<const unsigned char*>(records.data());
  return Bytes(first, first + records.size() * sizeof(T));
}

class Meshes : public testing::TestWithParam<bool> {
 protected:
  void set(const MeshList& meshes) { set(meshes_, meshes); }
  void set(DeviceMeshes& on_device, const MeshList& meshes) {
    on_device.set(meshes);
    device_.finish();
  }

  // The same where the list is placed in one go.
  void expect_as_placed_afresh(const MeshList& list) { expect_as_placed_afresh(meshes_, list); }
  void expect_as_placed_afresh(const DeviceMeshes& on_device, const MeshList& list) {
    DeviceMeshes fresh(program_);
    set(fresh, list);
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      ASSERT_EQ(&on_device.mesh(i), list[i].get());
      const auto expected = records_of(fresh, i), records = records_of(on_device, i);
      for (const auto& [kind, bytes] : expected) EXPECT_EQ(records.at(kind), bytes) << kind << i;
      for (std::uint32_t v = 0; v < list[i]->vertices.size(); ++v)
        ASSERT_EQ(on_device.owner_triangle(on_device.range(i).vertex_first + v),
                  fresh.owner_triangle(fresh.range(i).vertex_first + v));
    }
  }

  template <class T>
  std::vector<T> read(const Buffer& buffer, std::size_t first, std::size_t count) {
    std::vector<T> records(count);
    buffer.read(records.data(), count * sizeof(T), first * sizeof(T));
    device_.finish();
    return records;
  }

  // All that is there of a mesh, by kind, as if it were the first.
  std::map<std::string, Bytes> records_of(const DeviceMeshes& meshes, std::uint32_t i) {
    const MeshTopology& built = *meshes.mesh(i).topology;
    const MeshRange& range = meshes.range(i);
    const std::size_t edge_count = built.edges.size() + built.flat_edges.size();
    const auto less = [](ox_u32& index, ox_u32 first) {
      if (index != OX_NONE) index -= first;
    };
    std::map<std::string, Bytes> all;

    auto mesh = read<ox_mesh>(meshes.records(), i, 1);
    auto chunks = read<ox_chunk>(meshes.chunks(), mesh[0].chunk_first, built.chunks.size());
    for (ox_chunk& chunk : chunks) less(chunk.first, range.vertex_first);
    all["chunks"] = bytes_of(chunks);
    all["vertices"] =
        bytes_of(read<ox_vertex>(meshes.vertices(), range.vertex_first, built.vertex_count));

    auto triangles =
        read<ox_triangle>(meshes.triangles(), range.triangle_first, built.triangles.size());
    for (ox_triangle& triangle : triangles)
      for (ox_u32* side : {&triangle.side_ab, &triangle.side_bc, &triangle.side_ca})
        less(*side, *side != OX_NONE && (*side & OX_WITHIN_FACET) != 0 ? range.triangle_first
                                                                       : range.edge_first);
    all["triangles"] = bytes_of(triangles);

    auto edges = read<ox_edge>(meshes.edges(), range.edge_first, edge_count);
    for (ox_edge& edge : edges)
      for (std::size_t k = 0; k < 2; ++k) {
        less(edge.vertex[k], range.vertex_first);
        less(edge.triangle[k], range.triangle_first);
      }
    all["edges"] = bytes_of(edges);
    auto starts = read<ox_u32>(meshes.ring_starts(), range.vertex_first, built.vertex_count + 1);
    const ox_u32 ring_first = starts[0];
    for (ox_u32& start : starts) start -= ring_first;
    all["ring starts"] = bytes_of(starts);
    auto rings = read<ox_neighbour>(meshes.rings(), ring_first, 2 * edge_count);
    for (ox_neighbour& neighbour : rings) {
      less(neighbour.vertex, range.vertex_first);
      less(neighbour.edge, range.edge_first);
    }
    all["rings"] = bytes_of(rings);

    auto meshlets =
        read<ox_meshlet>(meshes.meshlets(), mesh[0].meshlet_first, built.meshlets.meshlets.size());
    for (ox_meshlet& meshlet : meshlets) {
      for (std::size_t k = 0; k < OX_LANES; ++k) less(meshlet.vertex_index[k], range.vertex_first);
      for (std::size_t k = 0; k < meshlet.triangle_count; ++k)
        less(meshlet.triangle[k], range.triangle_first);
      for (std::size_t k = 0; k < meshlet.edge_count; ++k) less(meshlet.edge[k], range.edge_first);
    }
    all["meshlets"] = bytes_of(meshlets);
    all["nodes"] = bytes_of(read<ox_meshlet_node>(
        meshes.meshlet_nodes(), mesh[0].meshlet_node_first, built.meshlets.tree.size()));
    if (meshes.mesh(i).deformable)
      all["topology"] = bytes_of(
          read<ox_u32>(meshes.topologies(), range.topology_first, count_topology_words(built)));

    mesh[0].chunk_first = mesh[0].triangle_first = mesh[0].meshlet_first = 0;
    mesh[0].meshlet_node_first = 0;
    less(mesh[0].flat_edge_first, range.edge_first);
    all["mesh"] = bytes_of(mesh);
    return all;
  }

  Device device_{"", 0, GetParam()};
  Program program_{device_, ""};
  DeviceMeshes meshes_{program_};
};

INSTANTIATE_TEST_SUITE_P(WhereMemoryIsSharedAndWhereNot, Meshes, testing::Bool());

std::shared_ptr<const Mesh> rigid(const TestMesh& mesh) {
  return std::make_shared<const Mesh>(build_mesh(soup_of(mesh)));
}

MeshList five_meshes() {
  return {rigid(make_cube(1)), rigid(make_icosphere(1, 2)), rigid(make_sheet(2, 9)),
          rigid(make_comb(4, 1, 1, 0.3)), rigid(make_torus(1, 0.3, 24, 12))};
}

TEST_P(Meshes, StayWhereTheyAreWhileOthersComeAndGo) {
  const MeshList all = five_meshes();
  set({all[0], all[4]});
  const std::uint32_t first = meshes_.range(0).vertex_first, last = meshes_.range(1).vertex_first;
  set({all[1], all[0], all[4]});
  EXPECT_EQ(meshes_.range(1).vertex_first, first);
  EXPECT_EQ(meshes_.range(2).vertex_first, last);
  EXPECT_EQ(meshes_.range(0).vertex_first, last + all[4]->vertices.size());
  expect_as_placed_afresh({all[1], all[0], all[4]});
  set({all[4], all[3], all[2]});
  EXPECT_EQ(meshes_.range(0).vertex_first, last);
  expect_as_placed_afresh({all[4], all[3], all[2]});
}

TEST_P(Meshes, HaveTheEndsOfTheEdgesOfTheirMeshlets) {
  const MeshList all = five_meshes();
  set(all);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const ox_mesh mesh = read<ox_mesh>(meshes_.records(), i, 1)[0];
    std::size_t count = 0;
    for (const ox_meshlet& meshlet :
         read<ox_meshlet>(meshes_.meshlets(), mesh.meshlet_first, mesh.meshlet_count))
      for (ox_u32 e = 0; e < meshlet.edge_count; ++e, ++count) {
        const ox_edge edge = read<ox_edge>(meshes_.edges(), meshlet.edge[e], 1)[0];
        for (std::size_t end = 0; end < 2; ++end)
          EXPECT_EQ(meshlet.vertex_index[OX_END(meshlet.ends, e, end)], edge.vertex[end]);
      }
    EXPECT_EQ(count, all[i]->topology->edges.size() + all[i]->topology->flat_edges.size());
  }
}

TEST_P(Meshes, AreThoseOfTheListWhicheverCameBefore) {
  Random random(7);
  MeshList pool = five_meshes();
  for (const std::size_t triangles : {30u, 100u, 150u})
    pool.push_back(deformable(strip(triangles)));
  for (int step = 0; step < 40; ++step) {
    MeshList list;
    for (auto& mesh : pool) {
      if (mesh->deformable && random.uniform(0, 1) < 0.3)
        mesh =
            deformed(mesh, bent(strip(mesh->source.size() / 3), 0.3f * static_cast<float>(step)));
      if (random.uniform(0, 1) < 0.8)
        list.insert(list.begin() + random.below(static_cast<int>(list.size()) + 1), mesh);
    }
    set(list);
    set(list);  // what moved rests
    expect_as_placed_afresh(list);
    if (testing::Test::HasFailure()) FAIL() << "in step " << step;
  }
}

TEST_P(Meshes, GoUpAnewOnceMoreWouldBeOutOfUseThanInUse) {
  const auto large = rigid(make_icosphere(1, 4)), small = rigid(make_icosphere(1, 2));
  const auto cube = rigid(make_cube(1));
  set({large, small});
  set({large, cube});
  EXPECT_GT(meshes_.range(1).vertex_first, large->vertices.size());
  set({cube});
  EXPECT_EQ(meshes_.range(0).vertex_first, 0u);
  expect_as_placed_afresh({cube});
}

TEST_P(Meshes, OfWhichOneComesAndGoesForEverTakeNoMoreRoomThanTwice) {
  const auto triangles_of = [](const auto& mesh) { return mesh->topology->triangles.size(); };
  const auto stays = rigid(make_icosphere(1, 3));
  int appended = 0;
  for (int i = 0; i < 100; ++i) {
    const auto comes = rigid(make_cube(1, 1 + i % 12));
    set({stays, comes});
    const std::size_t first = meshes_.range(1).triangle_first;
    EXPECT_LE(first + triangles_of(comes), 2 * (triangles_of(stays) + triangles_of(comes)));
    appended += first > triangles_of(stays) ? 1 : 0;
  }
  EXPECT_GT(appended, 50);  // the others where all went up anew
}

TEST_P(Meshes, KnowHowFarTheyMovedWhereTheyGoUpAnew) {
  const auto base = deformable(strip(40)), larger = deformable(strip(200));
  const auto shape = deformed(base, bent(strip(40)));
  set({larger, base});
  set({shape});
  EXPECT_EQ(meshes_.range(0).vertex_first, 0u);
  DeviceMeshes others(program_);
  set(others, {base});
  set(others, {shape});
  EXPECT_GT(read<ox_mesh>(meshes_.records(), 0, 1)[0].moved, 0.05f);
  EXPECT_EQ(records_of(meshes_, 0), records_of(others, 0));
  set({shape});
  expect_as_placed_afresh({shape});
}

// Growing takes room for old and new at once; there may be none.
TEST_P(Meshes, GoUpAnewWhereTheyCannotBeAppended) {
  MeshList all = five_meshes();
  all.push_back(deformable(strip(30)));
  all.push_back(deformable(strip(60)));
  int mended = 0;
  for (int nth = 1;; ++nth) {
    DeviceMeshes on_device(program_);
    set(on_device, {all[1], all[5]});
    fault_injector::arm(nth, CL_MEM_OBJECT_ALLOCATION_FAILURE);
    bool thrown = false;
    try {
      on_device.set(all);
    } catch (const DeviceError&) {  // of a call that both ways make
      thrown = true;
    }
    const bool failed = fault_injector::calls_checked() >= nth;
    fault_injector::disarm();
    device_.settle();
    if (thrown) {
      on_device.forget();
      set(on_device, all);
    }
    mended += failed && !thrown ? 1 : 0;
    set(on_device, all);  // what moved rests
    expect_as_placed_afresh(on_device, all);
    if (!failed) break;
  }
  EXPECT_GT(mended, 10);  // a buffer of each kind, and some more
}

}  // namespace
}  // namespace ode_ext::test
