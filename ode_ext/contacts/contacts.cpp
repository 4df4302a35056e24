// SPDX-License-Identifier: BSD-3-Clause
#include "contacts/contacts.h"

#include <algorithm>
#include <tuple>

#include "contacts/contact_features.h"
#include "contacts/known_depth.h"

namespace ode_ext {
namespace {

// The program's index of a triangle of the device's.
std::uint32_t source_triangle(const DeviceMeshes& meshes, std::uint32_t mesh,
                              std::uint32_t triangle) {
  return meshes.mesh(mesh).topology->source_triangle[triangle - meshes.range(mesh).triangle_first];
}

// One that has its position and normal with it.
Contact to_point(const Scene& scene, const DeviceMeshes& meshes,
                 const std::array<std::uint32_t, 2>& pair, const ox_contact& contact) {
  const std::uint32_t side = (contact.side_kind & OX_HIT_SIDE) != 0 ? 1 : 0;
  const Scene::Object& frame = scene.objects[pair[(contact.side_kind & OX_HIT_IN_A) != 0 ? 0 : 1]];
  const auto vector = [](const ox_f32(&v)[3]) { return Vec3d(Vec3f{v[0], v[1], v[2]}); };
  const Vec3d normal = scene.objects[pair[1]].pose.rotate(vector(contact.normal));
  Contact result;
  result.position =
      frame_pose(frame.pose, meshes.mesh(frame.mesh)).transform(vector(contact.position));
  result.normal = (1.0 / length(normal)) * normal;
  result.depth = static_cast<double>(contact.depth);
  result.triangles[side] = source_triangle(meshes, scene.objects[pair[side]].mesh, contact.vertex);
  result.triangles[1 - side] =
      source_triangle(meshes, scene.objects[pair[1 - side]].mesh, contact.triangle);
  return result;
}

// One of a vertex of a mesh and a face of the other.
Contact to_vertex(const Scene& scene, const DeviceMeshes& meshes,
                  const std::array<std::uint32_t, 2>& pair, const ox_contact& contact) {
  const std::uint32_t side = (contact.side_kind & OX_HIT_SIDE) != 0 ? 1 : 0;
  const Scene::Object& source = scene.objects[pair[side]];
  const Scene::Object& target = scene.objects[pair[1 - side]];
  const Mesh& source_mesh = meshes.mesh(source.mesh);
  const Mesh& target_mesh = meshes.mesh(target.mesh);
  const Pose source_pose = frame_pose(source.pose, source_mesh);
  const Pose target_pose = frame_pose(target.pose, target_mesh);
  const std::uint32_t vertex = contact.vertex - meshes.range(source.mesh).vertex_first;
  const std::uint32_t triangle = contact.triangle - meshes.range(target.mesh).triangle_first;

  // Out of the target is into the source; the normal is to point into the first object.
  const Vec3d outward = target_pose.rotate(face_normal(target_mesh, triangle));
  const bool turned = (side == 0) == ((contact.side_kind & OX_HIT_REVERSED) != 0);
  Contact result;
  result.position = source_pose.transform(Vec3d(source_mesh.vertices[vertex]));
  result.normal = ((turned ? -1.0 : 1.0) / length(outward)) * outward;
  // Again in double precision: bodies come to rest 1e-9 m deep, where floats would push and let go
  // by turns. What the device took for inside, to within its rounding, stays a contact.
  const Vec3d corner =
      target_pose.rotate(Vec3d(target_mesh.vertices[target_mesh.topology->triangles[triangle][0]]));
  const Vec3d from = source_pose.rotate(Vec3d(source_mesh.vertices[vertex]));
  // Of places far from the origin the difference is exact, the sums are not.
  const Vec3d apart = (corner - from) + (target_pose.position - source_pose.position);
  const double height = dot(apart, outward) / length(outward);
  const bool reversed = (contact.side_kind & OX_HIT_REVERSED) != 0;
  result.depth = reversed ? -height : height;
  result.triangles[side] = meshes.owner_triangle(contact.vertex);
  result.triangles[1 - side] = target_mesh.topology->source_triangle[triangle];
  return result;
}

Contact to_contact(const Scene& scene, const DeviceMeshes& meshes,
                   const std::array<std::uint32_t, 2>& pair, const ox_contact& contact) {
  const bool is_point = (contact.side_kind & OX_HIT_POINT) != 0;
  Contact result =
      is_point ? to_point(scene, meshes, pair, contact) : to_vertex(scene, meshes, pair, contact);
  const auto placed = [&](std::size_t k) -> PlacedMesh {
    const Scene::Object& object = scene.objects[pair[k]];
    return {meshes.mesh(object.mesh), object.pose};
  };
  result.depth = known_depth(result, {placed(0), placed(1)});
  for (std::size_t k = 0; k < 2; ++k)
    result.features[k] = feature_of(meshes, scene.objects[pair[k]].mesh, contact.feature[k]);
  result.region = contact.region;
  if ((contact.region & OX_REGION_CROSSED) == 0)
    result.within = (contact.side_kind & OX_HIT_SIDE) != 0 ? 2 : 1;
  return result;
}

bool is_deformable(const Scene& scene, const std::array<std::uint32_t, 2>& pair) {
  return scene.meshes[scene.objects[pair[0]].mesh]->deformable ||
         scene.meshes[scene.objects[pair[1]].mesh]->deformable;
}

// The program's numbers of the triangles come last: the order is not to depend on its listing.
bool comes_first(const Contact& a, const Contact& b) {
  const auto rank = [](const Contact& c) {
    return std::tie(c.position.x, c.position.y, c.position.z, c.normal.x, c.normal.y, c.normal.z,
                    c.features, c.triangles);
  };
  return a.depth != b.depth ? a.depth > b.depth : rank(a) < rank(b);
}

// Among contacts whose depths are the same to a float, the device may have taken another.
void put_deepest_first(std::span<Contact> contacts) {
  const auto deepest =
      std::max_element(contacts.begin(), contacts.end(),
                       [](const Contact& a, const Contact& b) { return a.depth < b.depth; });
  std::rotate(contacts.begin(), deepest, deepest + 1);
}

}  // namespace

void append_contacts(const Scene& scene, const DeviceMeshes& meshes, std::size_t first_pair,
                     std::span<const ox_range> ranges, std::span<const ox_contact> contacts,
                     bool sort, PairContacts& result) {
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto& pair = scene.pairs[first_pair + i];
    const std::size_t first = result.contacts.size();
    result.ranges.push_back({first, ranges[i].count, ranges[i].features});
    if (ranges[i].count == 0) continue;
    for (const ox_contact& contact : contacts.subspan(ranges[i].first, ranges[i].count))
      result.contacts.push_back(to_contact(scene, meshes, pair, contact));
    const std::span found = std::span(result.contacts).subspan(first);
    if (sort && is_deformable(scene, pair))
      std::sort(found.begin(), found.end(), comes_first);
    else
      put_deepest_first(found);
    number_repeats(found, meshes.mesh(scene.objects[pair[0]].mesh),
                   meshes.mesh(scene.objects[pair[1]].mesh));
  }
}

}  // namespace ode_ext
