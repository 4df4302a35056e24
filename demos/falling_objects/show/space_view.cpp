// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/space_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "falling_objects/show/boxes.h"
#include "falling_objects/show/coats.h"
#include "falling_objects/show/grounds.h"
#include "falling_objects/show/mesh_of_geom.h"
#include "falling_objects/show/region_marks.h"

namespace falling_objects {
namespace {

constexpr view::Color kGround{0.74F, 0.72F, 0.68F}, kFixed{0.45F, 0.47F, 0.50F};
// Far apart in hue and not far in lightness.
constexpr std::array<view::Color, kCoats> kShapes{{{0.86F, 0.33F, 0.25F},
                                                   {0.22F, 0.47F, 0.75F},
                                                   {0.93F, 0.68F, 0.20F},
                                                   {0.25F, 0.60F, 0.42F},
                                                   {0.58F, 0.39F, 0.70F},
                                                   {0.16F, 0.64F, 0.69F},
                                                   {0.88F, 0.50F, 0.60F},
                                                   {0.55F, 0.55F, 0.30F}}};
constexpr std::array<view::Color, 3> kCloths{
    {{0.90F, 0.86F, 0.76F}, {0.78F, 0.34F, 0.36F}, {0.38F, 0.55F, 0.68F}}};
constexpr view::Color kShallow{0.05F, 0.05F, 0.09F}, kDeep{0.95F, 0.03F, 0.12F};
constexpr view::Color kTouched{1.0F, 0.85F, 0.1F};
constexpr view::Color kInside{1.0F, 0.1F, 0.85F};
constexpr float kLargest = 4;  // what does not move and throws all of its shadow, over what moves
constexpr std::size_t kMostGlass = 100;  // objects in the scene: each is compared with each
constexpr float kSpot = 0.007F;          // of the radius of the scene: a contact of a region

// A contact of no depth is an arrow nevertheless.
constexpr float kPerDepth = 50;
constexpr float kShortest = 0.015F, kLongest = 0.25F;  // of the radius of the scene
constexpr float kRed = 0.03F;  // [m] of depth from which on an arrow is all red

view::Arrow arrow_of(const dContactGeom& contact, float radius) {
  const auto depth = static_cast<float>(contact.depth);
  const float length = std::min(kShortest * radius + kPerDepth * depth, kLongest * radius);
  const glm::vec3 at = to_glm(contact.pos);
  return {at, at + length * to_glm(contact.normal),
          glm::mix(kShallow, kDeep, std::clamp(depth / kRed, 0.0F, 1.0F))};
}

void add_touched(dGeomID geom, int side, std::vector<glm::vec3>& corners) {
  if (dGeomGetClass(geom) != dTriMeshClass || side < 0 ||
      side >= dGeomTriMeshGetTriangleCount(geom)) {
    return;
  }
  std::array<dVector3, 3> corner{};
  dGeomTriMeshGetTriangle(geom, side, &corner[0], &corner[1], &corner[2]);
  for (const auto& c : corner) corners.push_back(to_glm(c));
}

view::Cloth cloth_of(const Cloth& cloth, view::Color color) {
  view::Cloth seen{{}, cloth.triangles(), color};
  for (const Vector& p : cloth.positions()) {
    seen.vertices.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y),
                               static_cast<float>(p.z));
  }
  return seen;
}

// It has a body that others push.
bool moves(dGeomID geom) {
  dBodyID body = dGeomGetBody(geom);
  return body != nullptr && dBodyIsKinematic(body) == 0;
}

// Spaces list geoms in any order; a shape's color is not to depend on it.
std::vector<dGeomID> meshes_in(dSpaceID space) {
  std::vector<dGeomID> geoms;
  const int count = dSpaceGetNumGeoms(space);
  for (int i = 0; i < count; ++i) {
    dGeomID geom = dSpaceGetGeom(space, i);
    if (dGeomGetClass(geom) == dTriMeshClass && (dGeomGetCategoryBits(geom) & kMeshBit) != 0) {
      geoms.push_back(geom);
    }
  }
  std::stable_sort(geoms.begin(), geoms.end(),
                   [](dGeomID a, dGeomID b) { return index_of(a) < index_of(b); });
  return geoms;
}

std::set<dGeomID> inside_others(std::span<const dContactGeom> contacts,
                                std::span<const dBatchContactRegion> regions) {
  std::set<dGeomID> inside;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (regions[i].overlap == dBatchOverlapFirstInside) inside.insert(contacts[i].g1);
    if (regions[i].overlap == dBatchOverlapSecondInside) inside.insert(contacts[i].g2);
  }
  return inside;
}

}  // namespace

const SpaceView::Kind& SpaceView::kind_of(dGeomID geom, const view::Box& moving) {
  dTriMeshDataID data = dGeomTriMeshGetTriMeshDataID(geom);
  const auto known = kinds_.find(data);
  if (known != kinds_.end()) return known->second;
  IndexedMesh mesh = mesh_of(data);
  const bool ground = mesh.closed && !moves(geom) && reaches_under(box_of(geom), moving);
  const bool open = ground && !is_convex(mesh);
  if (open) keep_top(mesh);
  Kind kind{
      renderer_.add_mesh(mesh.positions, mesh.triangles, mesh.closed), kGround, ground, open, {}};
  if (moves(geom)) {
    kind.color = kShapes[moving_kinds_++ % kShapes.size()];
  } else if (!ground) {
    kind.color = kFixed;
  }
  return kinds_.emplace(data, kind).first->second;
}

// A little lighter or darker than its neighbour of the same shape; where all have one shape, or are
// few, the colors of shapes in turn.
void SpaceView::tell_apart(view::Frame& frame) const {
  const auto moving = std::count_if(frame.objects.begin(), frame.objects.end(),
                                    [](const view::Instance& o) { return o.color != kFixed; });
  const bool each = moving_kinds_ == 1 || moving <= static_cast<int>(kShapes.size());
  std::size_t i = 0;
  for (view::Instance& object : frame.objects) {
    if (object.color == kFixed) continue;
    if (each) object.color = kShapes[i % kShapes.size()];
    object.color *= 0.92F + 0.04F * static_cast<float>(i % 5);
    ++i;
  }
}

void SpaceView::dress(view::Frame& frame, const std::vector<dGeomID>& geoms,
                      dBatchColliderID collider) {
  std::vector<view::Instance> dressed;
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    dTriMeshDataID data = dGeomTriMeshGetTriMeshDataID(geoms[i]);
    std::vector<view::MeshId>& coats = kinds_.at(data).coats;
    if (coats.empty()) {
      std::vector<int> meshlets(static_cast<std::size_t>(dGeomTriMeshGetTriangleCount(geoms[i])));
      if (dBatchColliderGetMeshlets(collider, data, static_cast<int>(meshlets.size()),
                                    meshlets.data()) > 0) {
        const IndexedMesh mesh = mesh_of(data);
        for (const auto& triangles : coats_of(mesh, meshlets)) {
          coats.push_back(renderer_.add_mesh(mesh.positions, triangles, mesh.closed));
        }
      }
    }
    if (coats.empty()) dressed.push_back(frame.objects[i]);
    for (std::size_t k = 0; k < coats.size(); ++k) {
      dressed.push_back({coats[k], frame.objects[i].pose, kShapes[k]});
    }
  }
  frame.objects = std::move(dressed);
}

void SpaceView::mark_contacts(view::Frame& frame, const std::vector<dGeomID>& geoms,
                              std::span<const dContactGeom> contacts, const Overlays& overlays,
                              dBatchColliderID collider) const {
  std::vector<dBatchContactRegion> regions;
  if (overlays.regions || overlays.inside) regions = regions_of(collider, contacts);
  view::Patch touched{{}, kTouched};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const dContactGeom& contact = contacts[i];
    if (overlays.contacts) {
      frame.arrows.push_back(arrow_of(contact, radius_));
      if (overlays.regions && regions[i].region >= 0) {
        frame.arrows.back().color = color_of(contact, regions[i]);
      }
    }
    if (overlays.touched) {
      add_touched(contact.g1, contact.side1, touched.corners);
      add_touched(contact.g2, contact.side2, touched.corners);
    }
  }
  if (!touched.corners.empty()) frame.patches.push_back(std::move(touched));
  if (overlays.regions) mark_regions(contacts, regions, kSpot * radius_, frame.patches);
  if (overlays.inside) {
    const std::set<dGeomID> inside = inside_others(contacts, regions);
    for (std::size_t i = 0; i < geoms.size(); ++i) {
      if (!inside.contains(geoms[i])) continue;
      frame.objects[i].color = kInside;
      frame.shown_through.push_back(frame.objects[i]);
    }
  }
}

// All that throws shadows but what flies away. The ball does not follow every step: the shadows'
// edges would swim.
void SpaceView::light(const view::Box& all) {
  constexpr float kRoom = 1.2F, kFarthest = 4;
  const glm::vec3 center = (all.low + all.high) / 2.0F;
  const float radius = radius_of(all);
  const bool inside = glm::distance(center, lit_center_) + radius <= kRoom * lit_radius_;
  if (inside || (lit_radius_ > 0 && radius > kFarthest * first_lit_radius_)) return;
  lit_center_ = center;
  if (!(lit_radius_ > 0)) first_lit_radius_ = radius;
  lit_radius_ = lit_radius_ > 0 ? kRoom * radius : radius;
}

// What has another object within its box, and had from the start: in a heap that comes and goes.
void SpaceView::make_glass(view::Frame& frame, const std::vector<dGeomID>& geoms) {
  std::vector<view::Box> boxes;
  for (dGeomID geom : geoms) boxes.push_back(box_of(geom));
  std::vector<view::Instance> opaque;
  std::set<dGeomID> vessels;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const bool may = !vessels_ || vessels_->contains(geoms[i]);
    const bool contains =
        may && std::any_of(boxes.begin(), boxes.end(),
                           [&](const view::Box& other) { return holds(boxes[i], other); });
    if (contains) vessels.insert(geoms[i]);
    (contains ? frame.glass : opaque).push_back(frame.objects[i]);
  }
  frame.objects = std::move(opaque);
  if (!vessels_) vessels_ = std::move(vessels);
}

view::Frame SpaceView::frame(dSpaceID space, const Sheets* sheets,
                             std::span<const dContactGeom> contacts, const Overlays& overlays,
                             dBatchColliderID collider) {
  view::Frame frame;
  const std::vector<dGeomID> geoms = meshes_in(space);
  std::vector<view::Box> moving;
  for (dGeomID geom : geoms) {
    if (moves(geom)) moving.push_back(box_of(geom));
  }
  if (sheets != nullptr) {
    for (std::size_t i = 0; i < sheets->all().size(); ++i) {
      const Sheet& sheet = *sheets->all()[i];
      frame.cloths.push_back(cloth_of(sheet.cloth(), kCloths[i % kCloths.size()]));
      moving.push_back(around(frame.cloths.back().vertices));
    }
  }
  const view::Box all = around(moving);
  std::vector<view::Box> lit{all};
  std::vector<dGeomID> of_objects;
  for (dGeomID geom : geoms) {
    const Kind& kind = kind_of(geom, all);
    if (!moves(geom) && !kind.open && radius_of(box_of(geom)) < kLargest * radius_of(all)) {
      lit.push_back(box_of(geom));
    }
    (kind.ground ? frame.grounds : frame.objects).push_back({kind.mesh, pose_of(geom), kind.color});
    if (!kind.ground) of_objects.push_back(geom);
  }
  tell_apart(frame);
  if (!(radius_ > 0)) radius_ = radius_of(all);
  light(around(lit));
  frame.to_sun = to_sun_;
  frame.center = lit_center_;
  frame.radius = lit_radius_;
  mark_contacts(frame, of_objects, contacts, overlays, collider);
  if (overlays.meshlets)
    dress(frame, of_objects, collider);
  else if (of_objects.size() <= kMostGlass)
    make_glass(frame, of_objects);
  if (overlays.boxes) frame.boxes = std::move(moving);
  return frame;
}

void SpaceView::light_from(const view::Camera& camera) {
  const float azimuth = camera.azimuth - glm::radians(38.0F), elevation = glm::radians(52.0F);
  to_sun_ = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
             std::sin(elevation)};
}

view::Camera overview(const view::Frame& frame) {
  // Lower than the middle: things fall.
  const glm::vec3 target = frame.center - glm::vec3(0, 0, 0.12F * frame.radius);
  view::Camera camera = view::looking_at(target, 0.9F * frame.radius);
  camera.azimuth = glm::radians(-60.0F);
  camera.elevation = glm::radians(36.0F);
  return camera;
}

}  // namespace falling_objects
