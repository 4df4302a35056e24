// SPDX-License-Identifier: BSD-3-Clause
// Host and device lay out what they share alike.
#include <gtest/gtest.h>

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "abi/contacts.h"
#include "abi/deform.h"
#include "abi/paper.h"
#include "abi/types.h"
#include "opencl/program.h"
#include "paper/kernels.h"

namespace ode_ext {
namespace {

struct Member {
  std::string type, name;
  std::size_t host;
};

#define SIZE_OF(type) \
  { #type, "", sizeof(type) }
#define OFFSET_OF(type, member) \
  { #type, #member, offsetof(type, member) }

const std::vector<Member> kMembers = {
    SIZE_OF(ox_object),
    OFFSET_OF(ox_object, rotation),
    OFFSET_OF(ox_object, rotation_rest),
    OFFSET_OF(ox_object, hi),
    OFFSET_OF(ox_object, lo),
    OFFSET_OF(ox_object, mesh),
    SIZE_OF(ox_mesh),
    OFFSET_OF(ox_mesh, chunk_first),
    OFFSET_OF(ox_mesh, chunk_count),
    OFFSET_OF(ox_mesh, triangle_first),
    OFFSET_OF(ox_mesh, meshlet_first),
    OFFSET_OF(ox_mesh, meshlet_count),
    OFFSET_OF(ox_mesh, meshlet_node_first),
    OFFSET_OF(ox_mesh, meshlet_node_count),
    OFFSET_OF(ox_mesh, component_count),
    OFFSET_OF(ox_mesh, flat_edge_first),
    OFFSET_OF(ox_mesh, flags),
    OFFSET_OF(ox_mesh, box_centre),
    OFFSET_OF(ox_mesh, box_half),
    OFFSET_OF(ox_mesh, extent),
    OFFSET_OF(ox_mesh, radius),
    OFFSET_OF(ox_mesh, triangle_count),
    OFFSET_OF(ox_mesh, mean_edge),
    OFFSET_OF(ox_mesh, reach),
    OFFSET_OF(ox_mesh, moved),
    SIZE_OF(ox_vertex),
    OFFSET_OF(ox_vertex, position),
    OFFSET_OF(ox_vertex, exit),
    OFFSET_OF(ox_vertex, direction),
    OFFSET_OF(ox_vertex, moved),
    SIZE_OF(ox_chunk),
    OFFSET_OF(ox_chunk, first),
    OFFSET_OF(ox_chunk, count),
    OFFSET_OF(ox_chunk, centre),
    OFFSET_OF(ox_chunk, half_size),
    OFFSET_OF(ox_chunk, reach),
    OFFSET_OF(ox_chunk, moved),
    OFFSET_OF(ox_chunk, is_joined),
    SIZE_OF(ox_edge),
    OFFSET_OF(ox_edge, vertex),
    OFFSET_OF(ox_edge, triangle),
    SIZE_OF(ox_neighbour),
    OFFSET_OF(ox_neighbour, vertex),
    OFFSET_OF(ox_neighbour, edge),
    SIZE_OF(ox_meshlet),
    OFFSET_OF(ox_meshlet, vertex),
    OFFSET_OF(ox_meshlet, normal),
    OFFSET_OF(ox_meshlet, lo),
    OFFSET_OF(ox_meshlet, hi),
    OFFSET_OF(ox_meshlet, slab_normal),
    OFFSET_OF(ox_meshlet, slab_lo),
    OFFSET_OF(ox_meshlet, slab_hi),
    OFFSET_OF(ox_meshlet, triangle_count),
    OFFSET_OF(ox_meshlet, edge_count),
    OFFSET_OF(ox_meshlet, with_area),
    OFFSET_OF(ox_meshlet, vertex_index),
    OFFSET_OF(ox_meshlet, edge),
    OFFSET_OF(ox_meshlet, ends),
    OFFSET_OF(ox_meshlet, places),
    OFFSET_OF(ox_meshlet, triangle),
    OFFSET_OF(ox_meshlet, firsts),
    SIZE_OF(ox_meshlet_task),
    OFFSET_OF(ox_meshlet_task, pair_side),
    OFFSET_OF(ox_meshlet_task, meshlet),
    OFFSET_OF(ox_meshlet_task, subtree),
    SIZE_OF(ox_meshlet_pair),
    OFFSET_OF(ox_meshlet_pair, pair),
    OFFSET_OF(ox_meshlet_pair, meshlet),
    SIZE_OF(ox_meshlet_node),
    OFFSET_OF(ox_meshlet_node, lo),
    OFFSET_OF(ox_meshlet_node, hi),
    OFFSET_OF(ox_meshlet_node, child),
    OFFSET_OF(ox_meshlet_node, first),
    OFFSET_OF(ox_meshlet_node, count),
    SIZE_OF(ox_triangle),
    OFFSET_OF(ox_triangle, a),
    OFFSET_OF(ox_triangle, facet),
    OFFSET_OF(ox_triangle, b),
    OFFSET_OF(ox_triangle, c),
    OFFSET_OF(ox_triangle, normal),
    OFFSET_OF(ox_triangle, side_ab),
    OFFSET_OF(ox_triangle, side_bc),
    OFFSET_OF(ox_triangle, side_ca),
    SIZE_OF(ox_pair),
    OFFSET_OF(ox_pair, rotation),
    OFFSET_OF(ox_pair, offset),
    OFFSET_OF(ox_pair, base),
    OFFSET_OF(ox_pair, base_offset),
    OFFSET_OF(ox_pair, epsilon),
    OFFSET_OF(ox_pair, mesh),
    OFFSET_OF(ox_pair, displacement),
    OFFSET_OF(ox_pair, near),
    OFFSET_OF(ox_pair, margin),
    OFFSET_OF(ox_pair, snap),
    SIZE_OF(ox_found),
    OFFSET_OF(ox_found, head),
    OFFSET_OF(ox_found, features),
    OFFSET_OF(ox_found, first),
    OFFSET_OF(ox_found, placed),
    OFFSET_OF(ox_found, candidates),
    OFFSET_OF(ox_found, at_border),
    OFFSET_OF(ox_found, is_below),
    SIZE_OF(ox_list),
    OFFSET_OF(ox_list, first),
    OFFSET_OF(ox_list, capacity),
    SIZE_OF(ox_link),
    OFFSET_OF(ox_link, pose),
    OFFSET_OF(ox_link, directory),
    OFFSET_OF(ox_link, known),
    SIZE_OF(ox_relative_pose),
    OFFSET_OF(ox_relative_pose, rotation),
    OFFSET_OF(ox_relative_pose, offset),
    OFFSET_OF(ox_relative_pose, pass),
    SIZE_OF(ox_temporal),
    OFFSET_OF(ox_temporal, triangle),
    OFFSET_OF(ox_temporal, moved),
    SIZE_OF(ox_directory_entry),
    OFFSET_OF(ox_directory_entry, block),
    OFFSET_OF(ox_directory_entry, pass),
    SIZE_OF(ox_work),
    OFFSET_OF(ox_work, vertex),
    OFFSET_OF(ox_work, iterative),
    OFFSET_OF(ox_work, bvh),
    OFFSET_OF(ox_work, basic),
    SIZE_OF(ox_chunk_task),
    OFFSET_OF(ox_chunk_task, pair_side),
    OFFSET_OF(ox_chunk_task, chunk),
    OFFSET_OF(ox_chunk_task, previous),
    OFFSET_OF(ox_chunk_task, category),
    SIZE_OF(ox_ray),
    OFFSET_OF(ox_ray, pair_side),
    OFFSET_OF(ox_ray, vertex),
    OFFSET_OF(ox_ray, memory),
    OFFSET_OF(ox_ray, triangle),
    SIZE_OF(ox_hit),
    OFFSET_OF(ox_hit, pair_side),
    OFFSET_OF(ox_hit, vertex),
    OFFSET_OF(ox_hit, triangle),
    OFFSET_OF(ox_hit, kind),
    OFFSET_OF(ox_hit, depth),
    OFFSET_OF(ox_hit, t),
    OFFSET_OF(ox_hit, from),
    OFFSET_OF(ox_hit, edge),
    SIZE_OF(ox_edge_crossing),
    OFFSET_OF(ox_edge_crossing, pair_side),
    OFFSET_OF(ox_edge_crossing, edge),
    OFFSET_OF(ox_edge_crossing, triangle),
    OFFSET_OF(ox_edge_crossing, t),
    OFFSET_OF(ox_edge_crossing, blur),
    OFFSET_OF(ox_edge_crossing, leaves),
    OFFSET_OF(ox_edge_crossing, before),
    OFFSET_OF(ox_edge_crossing, of_edge),
    SIZE_OF(ox_feature),
    OFFSET_OF(ox_feature, position),
    OFFSET_OF(ox_feature, pair),
    OFFSET_OF(ox_feature, flags),
    OFFSET_OF(ox_feature, source),
    OFFSET_OF(ox_feature, triangle),
    OFFSET_OF(ox_feature, t),
    OFFSET_OF(ox_feature, face),
    OFFSET_OF(ox_feature, next),
    OFFSET_OF(ox_feature, partner),
    OFFSET_OF(ox_feature, at),
    OFFSET_OF(ox_feature, mate),
    OFFSET_OF(ox_feature, region),
    SIZE_OF(ox_region),
    OFFSET_OF(ox_region, pair),
    OFFSET_OF(ox_region, first),
    OFFSET_OF(ox_region, count),
    OFFSET_OF(ox_region, placed),
    OFFSET_OF(ox_region, planes),
    OFFSET_OF(ox_region, flags),
    SIZE_OF(ox_face),
    OFFSET_OF(ox_face, key),
    OFFSET_OF(ox_face, owner),
    OFFSET_OF(ox_face, triangle),
    OFFSET_OF(ox_face, plane),
    SIZE_OF(ox_contact),
    OFFSET_OF(ox_contact, side_kind),
    OFFSET_OF(ox_contact, vertex),
    OFFSET_OF(ox_contact, triangle),
    OFFSET_OF(ox_contact, depth),
    OFFSET_OF(ox_contact, position),
    OFFSET_OF(ox_contact, normal),
    OFFSET_OF(ox_contact, feature),
    OFFSET_OF(ox_contact, region),
    SIZE_OF(ox_move),
    OFFSET_OF(ox_move, shape),
    OFFSET_OF(ox_move, mesh),
    OFFSET_OF(ox_move, vertex_first),
    OFFSET_OF(ox_move, vertex_count),
    OFFSET_OF(ox_move, position_first),
    OFFSET_OF(ox_move, corner_first),
    OFFSET_OF(ox_move, incident_first),
    OFFSET_OF(ox_move, scale),
    OFFSET_OF(ox_move, thickness),
    OFFSET_OF(ox_move, on_surface),
    OFFSET_OF(ox_move, measure_first),
    SIZE_OF(ox_range),
    OFFSET_OF(ox_range, first),
    OFFSET_OF(ox_range, count),
    OFFSET_OF(ox_range, features),
};

// OpenCL C has no offsetof, but addresses.
std::string layout_kernel() {
  std::ostringstream source;
  source << embedded_source() << "\n__kernel void layout(__global uint* out) {\n";
  for (std::size_t i = 0; i < kMembers.size(); ++i) {
    const Member& m = kMembers[i];
    source << "  out[" << i << "] = ";
    if (m.name.empty())
      source << "(uint)sizeof(" << m.type << ");\n";
    else
      source << "(uint)((size_t)&((__global " << m.type << "*)out)->" << m.name
             << " - (size_t)out);\n";
  }
  source << "}\n";
  return source.str();
}

TEST(SharedTypes, AreLaidOutAlikeByHostAndDevice) {
  Device device("");
  Program program(device, layout_kernel(), paper::kProgramOption);
  Kernel kernel(program, "layout");
  Buffer out(device);
  out.reserve(kMembers.size() * sizeof(cl_uint));
  kernel.launch(1, 1, out);
  std::vector<cl_uint> device_layout(kMembers.size());
  out.read(device_layout.data(), device_layout.size() * sizeof(cl_uint));
  device.finish();
  for (std::size_t i = 0; i < kMembers.size(); ++i)
    EXPECT_EQ(device_layout[i], kMembers[i].host) << kMembers[i].type << "::" << kMembers[i].name;
}

}  // namespace
}  // namespace ode_ext
