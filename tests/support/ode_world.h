// SPDX-License-Identifier: BSD-3-Clause
// ODE for tests: what it creates it destroys, and contacts are collected per pair.
#pragma once

#include <ode/ode.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

using Contacts = std::vector<dContactGeom>;
using GeomPair = std::pair<dGeomID, dGeomID>;

enum class SpaceKind { Simple, Hash, SweepAndPrune, QuadTree };
inline constexpr SpaceKind kSpaceKinds[] = {SpaceKind::Simple, SpaceKind::Hash,
                                            SpaceKind::SweepAndPrune, SpaceKind::QuadTree};
const char* name_of(SpaceKind kind);

// A dTriMeshData together with the arrays that ODE refers to and never copies.
class OdeMesh {
 public:
  explicit OdeMesh(TestMesh mesh);
  ~OdeMesh();
  OdeMesh(const OdeMesh&) = delete;
  OdeMesh& operator=(const OdeMesh&) = delete;

  dTriMeshDataID id() const { return id_; }
  const TestMesh& mesh() const { return mesh_; }
  TestMesh& edit() { return mesh_; }  // in place; keep the number of vertices and triangles
  void rebuild(TestMesh mesh);        // dGeomTriMeshDataBuildSingle again
  // Another dTriMeshData at the address of the destroyed one; false if the allocator gives others.
  bool replace_at_same_address(TestMesh mesh);

 private:
  TestMesh mesh_;
  dTriMeshDataID id_;
};

// dInitODE2 to dCloseODE, and everything created in between through it.
class OdeWorld {
 public:
  OdeWorld();
  ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  OdeMesh& mesh(TestMesh mesh);
  dSpaceID space(SpaceKind kind, dSpaceID parent = nullptr);
  dGeomID geom(const OdeMesh& mesh, const TestPose& pose, dSpaceID space = nullptr);
  dGeomID own(dGeomID geom);  // of any class, destroyed with the world
  void destroy(dGeomID geom);
  void destroy(OdeMesh& mesh);
  void restart();  // dCloseODE and dInitODE2 with everything destroyed

 private:
  void clear();

  std::vector<dGeomID> geoms_;
  std::vector<dSpaceID> spaces_;
  std::vector<std::unique_ptr<OdeMesh>> meshes_;
};

void set_pose(dGeomID geom, const TestPose& pose);
// dGeomTriMeshSetData marks the geom as moved but leaves it in its space among those that did not,
// where ODE does not look for it: a later dSpaceCollide aborts (docs/reliability.md). So it is
// taken out and put back. The box is sized at once.
void set_mesh(dGeomID geom, dTriMeshDataID mesh);
TestPose pose_of(dGeomID geom);
bool is_mesh(dGeomID geom);

// A heap of meshes of several kinds in one space, most of them overlapping others.
struct Pile {
  Pile(OdeWorld& world, dSpaceID space, int count, std::uint64_t seed, const Point& origin = {});
  void shake(std::uint64_t seed);  // gives every geom a new pose

  std::vector<dGeomID> geoms;
  Point origin;
};

// dCollide with room for `limit` contacts.
Contacts collide(dGeomID o1, dGeomID o2, int limit = 64);

// What a near callback saw: every pair in order, and the contacts of pairs of geoms.
struct Collected {
  std::vector<GeomPair> order;
  std::map<GeomPair, Contacts> contacts;
  bool recurse = false;  // dSpaceCollide2 into spaces, as most programs do
  long long total() const;
};
void collect(void* collected, dGeomID o1, dGeomID o2);  // dCollide for every pair of geoms
void collect_order_only(void* collected, dGeomID o1, dGeomID o2);

// Where two answers differ, in words; "" where pos, normal, depth and sides are the same byte for
// byte. The fourth entries of pos and normal mean nothing and are not compared.
std::string difference(const Contacts& a, const Contacts& b);
// Of two lists of answers, one a pair.
std::string difference(const std::vector<Contacts>& a, const std::vector<Contacts>& b);
// The same, and the geoms.
std::string difference_with_geoms(const Contacts& a, const Contacts& b);
// Of two passes over the same space: pairs, their order, and contacts with their geoms.
std::string difference_with_geoms(const Collected& a, const Collected& b);

// As seen from the other geom: normal negated, geoms and sides exchanged.
Contacts flipped(Contacts contacts);
// The answers in the order of the callbacks, to compare with another scene of the same make.
std::vector<Contacts> answers_of(const Collected& collected);

inline Point pos(const dContactGeom& c) { return {c.pos[0], c.pos[1], c.pos[2]}; }
inline Point normal(const dContactGeom& c) { return {c.normal[0], c.normal[1], c.normal[2]}; }

}  // namespace ode_ext::test
