// SPDX-License-Identifier: BSD-3-Clause
// The meshes of a program: dTriMeshDataID -> what the pipeline needs of it, kept while it does not
// change. A handle is dereferenced only when a live geom has just named it.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "ode/mesh_arrays.h"

namespace ode_ext {

class MeshStore {
 public:
  // `options` as build_mesh takes them, for meshes that live for long. With `trust`, a known mesh
  // is not read again until announced.
  MeshStore(const MeshOptions& options, bool trust) : options_(options), trust_(trust) {}

  // The mesh as it is now: its triangles are compared with those it was made of, and if they are
  // others it is rebuilt, or followed where it is deformable and only its vertices moved. Looks
  // once per mesh and value of `look`, and where it has not as many triangles as a geom says, or is
  // of other arrays: another mesh may have the handle by now. `round` is what prune goes by
  // (rounds.h).
  const std::shared_ptr<const Mesh>& refresh(dTriMeshDataID data, int triangle_count,
                                             std::uint64_t look, std::uint64_t round);

  // The mesh as of the last refresh; null if it is not known, was announced to have changed, or has
  // another number of triangles than `triangle_count`.
  std::shared_ptr<const Mesh> known(dTriMeshDataID data, int triangle_count) const;

  // The mesh as of the last refresh, not looked at, but in use in this round; null if not known.
  std::shared_ptr<const Mesh> keep(dTriMeshDataID data, std::uint64_t round);
  // Whether `mesh` is what was last read. Never dereferences the handle.
  bool is_as_known(dTriMeshDataID data, const std::shared_ptr<const Mesh>& mesh) const;

  // Whether it lay, when last read, outside of the box that ODE knows of it.
  bool has_left_box(dTriMeshDataID data) const { return entries_.at(data).left_box; }
  // Whether its contacts cannot be computed (mesh/range.h), as it was when last read.
  bool is_refused(dTriMeshDataID data) const { return entries_.at(data).refused; }
  // How often deformable meshes changed since the last call.
  std::uint64_t take_deformed() { return std::exchange(deformed_, 0); }

  void announce_change(dTriMeshDataID data);
  void set_deformable(dTriMeshDataID data, bool deformable);
  void forget(dTriMeshDataID data);
  // Forgets meshes that no round from this one on has met, but for which are deformable.
  void forget_before(std::uint64_t round);
  // Forgets meshes that no round has met for a long time. Looks every so many rounds.
  void prune(std::uint64_t round);
  // Drops meshes that this round has not met; where there are none, all but those in use. They are
  // built again when they are met. False: there was none to drop.
  bool make_room(const std::unordered_set<const Mesh*>& used, std::uint64_t round);

  // All meshes in an order that does not change while only deformable ones move, which keep their
  // places; rigid ones of equal content are there once. And a place of one in it.
  const std::vector<std::shared_ptr<const Mesh>>& resident();
  // Another one for each list that resident() gives.
  std::uint64_t resident_number() const { return resident_number_; }
  std::uint32_t index_of(const Mesh* mesh) const { return index_.at(mesh); }

  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const MeshTopology> topology;  // of a deformable mesh, of all its shapes
    std::optional<MeshArrays> arrays;              // that it was last looked at in
    std::uint64_t last_look = 0;
    std::uint64_t last_round = 0;
    std::uint64_t order = 0;
    bool changed = false;  // announced
    bool deformable = false;
    bool left_box = false;
    bool refused = false;
  };

  void update(Entry& entry);  // from source_, which a mesh that is built keeps
  std::shared_ptr<const Mesh> build();
  static void drop(Entry& entry);
  static bool has_triangles(const Entry& entry, int count);

  MeshOptions options_;
  bool trust_;
  std::unordered_map<dTriMeshDataID, Entry> entries_;
  // Equal content of rigid meshes is built once, whoever holds it. By content_hash.
  std::unordered_multimap<std::uint64_t, std::weak_ptr<const Mesh>> by_content_;
  std::vector<std::shared_ptr<const Mesh>> resident_;
  std::unordered_map<const Mesh*, std::uint32_t> index_;
  bool resident_is_stale_ = false;
  std::uint64_t resident_number_ = 0;
  std::uint64_t pruned_round_ = 0;
  std::uint64_t next_order_ = 0;
  std::uint64_t deformed_ = 0;
  SourceTriangles source_;
};

}  // namespace ode_ext
