// SPDX-License-Identifier: BSD-3-Clause
#include "preload/idioms/program.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#ifdef IDIOMS_BY_API
#include <ode_ext/ode_ext.h>
#endif

namespace idioms {

bool must_be_sound = false;

void fail(const std::string& message) {
  std::fprintf(stderr, "idioms: %s\n", message.c_str());
  std::exit(EXIT_FAILURE);
}

#ifdef IDIOMS_BY_API
namespace {
thread_local dBatchColliderID collider;
}

void begin() {
  collider = dBatchColliderCreate(nullptr);
  if (collider == nullptr) fail(dBatchColliderGetLastErrorMessage());
}
void end() { dBatchColliderDestroy(collider); }
void announce_change(dTriMeshDataID data) { dBatchColliderTriMeshDataUpdate(collider, data); }
void space_collide(dSpaceID space, void* data, dNearCallback* callback) {
  if (dBatchColliderSpaceCollide(collider, space, data, callback) != 1)
    fail(dBatchColliderGetLastErrorMessage());
}
void space_collide2(dGeomID g1, dGeomID g2, void* data, dNearCallback* callback) {
  if (dBatchColliderSpaceCollide2(collider, g1, g2, data, callback) != 1)
    fail(dBatchColliderGetLastErrorMessage());
}
#else
void begin() {}
void end() {}
void announce_change(dTriMeshDataID) {}
void space_collide(dSpaceID space, void* data, dNearCallback* callback) {
  dSpaceCollide(space, data, callback);
}
void space_collide2(dGeomID g1, dGeomID g2, void* data, dNearCallback* callback) {
  dSpaceCollide2(g1, g2, data, callback);
}
#endif

double Random::between(double low, double high) {
  state_ = state_ * 1664525u + 1013904223u;
  return low + (high - low) * (state_ >> 8) / double{1 << 24};
}

Mesh::Mesh(Shape shape, float scale) : data_(dGeomTriMeshDataCreate()) {
  if (shape == kTorus)
    add_torus();
  else
    add_cube();
  for (auto& vertex : vertices_)
    for (float& coordinate : vertex) coordinate *= scale;
  build();
}

Mesh::~Mesh() { dGeomTriMeshDataDestroy(data_); }

void Mesh::add_torus() {
  constexpr int kAround = 12, kAcross = 8;
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const double u = 2 * M_PI * i / kAround, v = 2 * M_PI * j / kAcross;
      const double radius = 1 + 0.4 * std::cos(v);
      vertices_.push_back({static_cast<float>(radius * std::cos(u)),
                           static_cast<float>(radius * std::sin(u)),
                           static_cast<float>(0.4 * std::sin(v))});
      const auto at = [](int a, int b) {
        return static_cast<dTriIndex>(a % kAround * kAcross + b % kAcross);
      };
      for (const dTriIndex index :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        indices_.push_back(index);
    }
}

void Mesh::add_cube() {
  for (int i = 0; i < 8; ++i)
    vertices_.push_back({i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f});
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& face : kFaces)
    for (const int corner : {0, 1, 2, 0, 2, 3})
      indices_.push_back(static_cast<dTriIndex>(face[corner]));
}

void Mesh::build() {
  dGeomTriMeshDataBuildSingle(data_, vertices_.data(), sizeof(vertices_[0]),
                              static_cast<int>(vertices_.size()), indices_.data(),
                              static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
}

void Mesh::stretch(float along_x) {
  for (auto& vertex : vertices_) vertex[0] *= along_x;
}

namespace {

int number_of(dGeomID geom) {
  return static_cast<int>(reinterpret_cast<std::intptr_t>(dGeomGetData(geom)));
}

void check(bool is_so, const char* what) {
  if (must_be_sound && !is_so) fail(std::string("a contact is not sound: ") + what);
}

// Within the box of a geom, but for its depth.
bool is_at(const dContactGeom& contact, dGeomID geom) {
  dReal box[6];
  dGeomGetAABB(geom, box);
  const double slack = contact.depth + 1e-3;
  for (int k = 0; k < 3; ++k)
    if (contact.pos[k] < box[2 * k] - slack || contact.pos[k] > box[2 * k + 1] + slack)
      return false;
  return true;
}

void check_contact(const dContactGeom& contact, dGeomID g1, dGeomID g2) {
  const double length = std::hypot(contact.normal[0], contact.normal[1], contact.normal[2]);
  check(std::fabs(length - 1) < 1e-4, "its normal is no unit vector");
  check(contact.depth >= 0 && contact.depth < 10, "its depth is none");
  check(is_at(contact, g1) && is_at(contact, g2), "it is not where its geoms are");
  check(contact.side1 >= 0 && contact.side2 >= 0, "it names no triangles");
}

}  // namespace

void Log::pair(dGeomID g1, dGeomID g2, const dContactGeom* contacts, int count, std::size_t skip) {
  text_ += "pair " + std::to_string(step_) + ": " + std::to_string(number_of(g1)) + " and " +
           std::to_string(number_of(g2)) + (count > 0 ? " collide\n" : " do not\n");
  const auto* bytes = reinterpret_cast<const unsigned char*>(contacts);
  for (int i = 0; i < count; ++i) {
    const auto& contact =
        *reinterpret_cast<const dContactGeom*>(bytes + static_cast<std::size_t>(i) * skip);
    check_contact(contact, g1, g2);
    char line[200];
    std::snprintf(line, sizeof(line), "  %a %a %a  %a %a %a  %a  %d %d %d %d\n", contact.pos[0],
                  contact.pos[1], contact.pos[2], contact.normal[0], contact.normal[1],
                  contact.normal[2], contact.depth, number_of(contact.g1), number_of(contact.g2),
                  contact.side1, contact.side2);
    text_ += line;
  }
}

void name(dGeomID geom, int number) {
  dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::intptr_t>(number)));
}

void place(dBodyID body, Random& random, double extent) {
  const auto coordinate = [&] { return static_cast<dReal>(random.between(0, extent)); };
  const auto angle = [&] { return static_cast<dReal>(random.between(-M_PI, M_PI)); };
  const dReal x = coordinate(), y = coordinate(), z = coordinate();
  dBodySetPosition(body, x, y, z);
  dMatrix3 rotation;
  const dReal a = angle(), b = angle(), c = angle();
  dRFromEulerAngles(rotation, a, b, c);
  dBodySetRotation(body, rotation);
}

Bodies::~Bodies() {
  for (const dGeomID geom : geoms) dGeomDestroy(geom);
  for (const dBodyID body : bodies) dBodyDestroy(body);
}

dGeomID Bodies::add(dWorldID world, dSpaceID space, const Mesh& mesh) {
  bodies.push_back(dBodyCreate(world));
  geoms.push_back(dCreateTriMesh(space, mesh.data(), nullptr, nullptr, nullptr));
  dGeomSetBody(geoms.back(), bodies.back());
  name(geoms.back(), ++added_);
  return geoms.back();
}

void Bodies::place(Random& random, double extent) {
  for (const dBodyID body : bodies) idioms::place(body, random, extent);
}

void Bodies::destroy_first() {
  dGeomDestroy(geoms.front());
  dBodyDestroy(bodies.front());
  geoms.erase(geoms.begin());
  bodies.erase(bodies.begin());
}

}  // namespace idioms
