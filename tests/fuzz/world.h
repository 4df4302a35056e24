// SPDX-License-Identifier: BSD-3-Clause
// What a fuzzed program makes in ODE, and what ODE itself cannot take: it aborts on meshes without
// triangles and crashes when a mesh of one triangle is updated, and all of its spaces but the
// simple one overflow on numbers that are huge or not finite. All is destroyed with the world.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <optional>
#include <vector>

#include "fuzz/decode_mesh.h"
#include "fuzz/oracles.h"

namespace ode_ext::fuzz {

// A dTriMeshData with the arrays that ODE refers to.
struct Mesh {
  DecodedMesh decoded;
  std::vector<double> doubles;  // the vertices, where ODE was given doubles
  bool in_doubles = false;
  dTriMeshDataID id = nullptr;
  bool unseen = false;  // changed in place, and nobody was told
  std::optional<test::FclSurface> surface;

  int triangles() const { return decoded.mesh.triangle_count(); }
  const test::FclSurface* tame_surface();
};

struct Space {
  dSpaceID id = nullptr;
  bool simple = true;  // and so are all that it is in
};

struct Geom {
  dGeomID id = nullptr;     // a mesh, or a dGeomTransform around one
  dGeomID inner = nullptr;  // the mesh in it
  Mesh* mesh = nullptr;
  Space* space = nullptr;
  bool merges = false, refuses = false;  // has a merge callback, a triangle callback

  test::TestPose pose() const;
  Sides sides() const;
};

class World {
 public:
  static constexpr std::size_t kMeshes = 6, kSpaces = 5, kGeoms = 12;

  World();
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Each does nothing, and returns null, where there is no room or nothing to choose from.
  Mesh* make_mesh(ByteSource& bytes);
  Space* make_space(ByteSource& bytes);
  Geom* make_geom(ByteSource& bytes);
  Mesh* choose_mesh(ByteSource& bytes);
  Space* choose_space(ByteSource& bytes);  // never null
  Geom* choose_geom(ByteSource& bytes);

  void pose(Geom& geom, ByteSource& bytes);
  void shake(ByteSource& bytes);  // small moves of all geoms
  void move_to(Geom& geom, Space& space);
  void give(Geom& geom, Mesh& mesh);
  void edit(Mesh& mesh, ByteSource& bytes);  // in place
  void rebuild(Mesh& mesh, ByteSource& bytes);
  void destroy(Geom& geom);
  void destroy(Mesh& mesh);  // and the geoms that use it

  const std::vector<std::unique_ptr<Geom>>& geoms() const { return geoms_; }
  Geom* find(dGeomID id) const;
  // Nothing in it is out of what stock ODE can be asked about.
  bool all_tame() const;

 private:
  bool only_tame(const Mesh& mesh) const;
  void build(Mesh& mesh);
  void set_pose(Geom& geom, const test::TestPose& pose);

  std::vector<std::unique_ptr<Mesh>> meshes_;
  std::vector<std::unique_ptr<Space>> spaces_;
  std::vector<std::unique_ptr<Geom>> geoms_;
};

}  // namespace ode_ext::fuzz
