// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/sheet_contacts.h"

#include <algorithm>
#include <cmath>

#include "simulation/pose.h"

namespace falling_objects {
namespace {

constexpr double kObjectFriction = 0.6;
constexpr double kSheetFriction = 0.5;
constexpr double kMoving = 0.05;           // [m/s] of the place touched: wakes a sheet
constexpr double kSheetMoving = 0.2;       // [m/s] mean of another sheet: wakes this one
constexpr double kSheetThickness = 0.008;  // [m] between two sheets that lie on each other
// The collider gives a vertex's position in floats relative to a sheet of 1.6 m: 1e-7 m.
constexpr double kSamePlace = 1e-5;

Vector velocity_at(dBodyID body, Vector p) {
  if (body == nullptr || !dBodyIsEnabled(body)) return {};
  const Vector arm = p - vector_of(dBodyGetPosition(body));
  return vector_of(dBodyGetLinearVel(body)) + cross(vector_of(dBodyGetAngularVel(body)), arm);
}

}  // namespace

SheetContacts::SheetContacts(const Scene& scene, const std::vector<std::unique_ptr<Sheet>>& sheets,
                             std::size_t count)
    : scene_(scene),
      sheets_(sheets),
      first_sheet_(scene.objects().size() + 1),
      sorted_(count),
      planes_(count) {
  for (const Shape& shape : scene.shapes()) surfaces_.emplace_back(shape.mesh);
  surfaces_.emplace_back(scene.ground().mesh());
  holds_.resize(count, std::vector<Hold>((kSheetQuads + 1) * (kSheetQuads + 1)));
}

void SheetContacts::sort(std::span<const dContactGeom> contacts) {
  for (auto& sorted : sorted_) sorted.clear();
  for (const dContactGeom& contact : contacts) {
    for (const dGeomID geom : {contact.g1, contact.g2}) {
      if (is_sheet(geom)) sorted_[index_of(geom) - first_sheet_].push_back(&contact);
    }
  }
}

void SheetContacts::read(std::size_t sheet) {
  planes_[sheet].clear();
  for (const dContactGeom* contact : sorted_[sheet]) {
    if (is_sheet(contact->g1) && is_sheet(contact->g2)) read_other(sheet, *contact);
  }
  for (const dContactGeom* contact : sorted_[sheet]) {
    if (!is_sheet(contact->g1) || !is_sheet(contact->g2)) read_object(sheet, *contact);
  }
}

// The corner of the triangle that is at p, if one is: the contact came from a ray of that vertex.
bool SheetContacts::vertex_of(std::size_t sheet, int triangle, Vector p,
                              std::uint32_t& vertex) const {
  const std::vector<unsigned>& corners = sheets_[sheet]->cloth().triangles();
  for (std::size_t k = 0; k < 3; ++k) {
    const unsigned corner = corners[3 * static_cast<std::size_t>(triangle) + k];
    const Vector apart = sheets_[sheet]->seen(corner) - p;
    if (dot(apart, apart) > kSamePlace * kSamePlace) continue;
    vertex = corner;
    return true;
  }
  return false;
}

// The collider says that the vertex is in the skin, and of which triangle. The mesh underneath has
// a closest place to it, and the vertex has to be a margin away from there: unlike the face that a
// ray leaves through, that direction turns steadily as a vertex slides over an edge.
void SheetContacts::read_object(std::size_t sheet, const dContactGeom& contact) {
  const bool sheet_is_first = is_sheet(contact.g1);
  const dGeomID other = sheet_is_first ? contact.g2 : contact.g1;
  const Vector p = vector_of(contact.pos);
  ClothContact plane;
  plane.owner = index_of(other);
  if (!vertex_of(sheet, sheet_is_first ? contact.side1 : contact.side2, p, plane.vertex)) return;
  const dBodyID body = dGeomGetBody(other);
  const bool on_ground = plane.owner == scene_.objects().size();
  const Surface& surface =
      on_ground ? surfaces_.back() : surfaces_[scene_.objects()[plane.owner].shape];
  const ode_ext::oracle::Pose pose = pose_of(body);
  const Vector local = pose.to_local(p);
  const int triangle = sheet_is_first ? contact.side2 : contact.side1;
  Surface::Place near = surface.closest_from(static_cast<std::size_t>(triangle), local);
  Hold& hold = holds_[sheet][plane.vertex];
  if (hold.owner == plane.owner) {
    const Surface::Place again = surface.closest_from(hold.triangle, local);
    if (std::abs(again.distance) < std::abs(near.distance)) near = again;
  }
  hold = {plane.owner, near.triangle};
  plane.normal = pose.to_world(near.outwards) - pose.position;
  plane.place = pose.to_world(near.point);
  plane.offset = dot(plane.normal, plane.place) + kSheetMargin;
  plane.velocity = velocity_at(body, plane.place);
  plane.wakes = length(plane.velocity) > kMoving;
  plane.friction = kObjectFriction;
  planes_[sheet].push_back(plane);
}

// A sheet has no inside, only two sides: the vertex stays on the one on which it is as the step
// begins (the collider saw where it is going), half the thickness from the plane in the middle
// between it and the other sheet. The other's own vertices have contacts of their own and keep to
// the other side. That plane does not move in the step: two sheets that fall together lose a little
// of their speed, and none can drive another.
void SheetContacts::read_other(std::size_t sheet, const dContactGeom& contact) {
  const bool own_is_first = index_of(contact.g1) - first_sheet_ == sheet;
  const Vector p = vector_of(contact.pos);
  ClothContact plane;
  if (!vertex_of(sheet, own_is_first ? contact.side1 : contact.side2, p, plane.vertex)) return;
  plane.owner = index_of(own_is_first ? contact.g2 : contact.g1);
  const Sheet& shown = *sheets_[plane.owner - first_sheet_];
  const Cloth& cloth = sheets_[sheet]->cloth();
  const Cloth& below = shown.cloth();
  const int triangle = own_is_first ? contact.side2 : contact.side1;
  const unsigned* corners = &below.triangles()[3 * static_cast<std::size_t>(triangle)];
  // Where the ray met the triangle as it was shown: the same place on it as the step begins.
  const Vector a = shown.seen(corners[0]), b = shown.seen(corners[1]), c = shown.seen(corners[2]);
  const Vector n = cross(b - a, c - a);
  const double area = dot(n, n);
  if (!(area > 0)) return;
  const double wb = std::clamp(dot(cross(p - a, c - a), n) / area, 0.0, 1.0);
  const double wc = std::clamp(dot(cross(b - a, p - a), n) / area, 0.0, 1 - wb);
  const auto blend = [&](const std::vector<Vector>& of) {
    return (1 - wb - wc) * of[corners[0]] + wb * of[corners[1]] + wc * of[corners[2]];
  };
  const std::vector<Vector>& x = below.positions();
  const Vector normal = unit(cross(x[corners[1]] - x[corners[0]], x[corners[2]] - x[corners[0]]));
  const Vector here = cloth.positions()[plane.vertex], there = blend(x);
  const double side = dot(normal, here - there) < 0 ? -1 : 1;
  plane.normal = side * normal;
  plane.place = 0.5 * (here + there);
  plane.offset = dot(plane.normal, plane.place) + kSheetThickness / 2;
  plane.friction = kSheetFriction;
  plane.wakes = below.mean_speed() > kSheetMoving;
  planes_[sheet].push_back(plane);
}

}  // namespace falling_objects
