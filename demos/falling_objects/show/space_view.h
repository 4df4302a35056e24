// SPDX-License-Identifier: BSD-3-Clause
// What an ODE space holds, as a picture: any meshes at any poses, whoever put them there.
#pragma once

#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "simulation/sheets.h"
#include "view/camera.h"
#include "view/frame.h"
#include "view/renderer.h"

namespace falling_objects {

struct Overlays {
  bool contacts = false, touched = false, boxes = false;
  bool regions = false, meshlets = false, inside = false;  // as far as the collider tells
};

class SpaceView {
 public:
  explicit SpaceView(view::Renderer& renderer) : renderer_(renderer) {}

  // The meshes (kMeshBit) and sheets of a space, without a caption. `sheets` may be null, and so
  // may `collider`, which the contacts are of.
  view::Frame frame(dSpaceID space, const Sheets* sheets, std::span<const dContactGeom> contacts,
                    const Overlays& overlays, dBatchColliderID collider = nullptr);

  // The sun stands behind the viewer's left shoulder as this camera looks.
  void light_from(const view::Camera& camera);

 private:
  struct Kind {
    view::MeshId mesh;
    view::Color color;
    bool ground;
    bool open;                        // of a ground only what faces up is drawn
    std::vector<view::MeshId> coats;  // of its meshlets, a color each; empty: not known yet
  };
  const Kind& kind_of(dGeomID geom, const view::Box& moving);
  void tell_apart(view::Frame& frame) const;
  // `geoms` are those of the frame's objects.
  void mark_contacts(view::Frame& frame, const std::vector<dGeomID>& geoms,
                     std::span<const dContactGeom> contacts, const Overlays& overlays,
                     dBatchColliderID collider) const;
  void light(const view::Box& all);
  void make_glass(view::Frame& frame, const std::vector<dGeomID>& geoms);
  // In place of objects their meshlets.
  void dress(view::Frame& frame, const std::vector<dGeomID>& geoms, dBatchColliderID collider);

  view::Renderer& renderer_;
  std::map<dTriMeshDataID, Kind> kinds_;
  std::size_t moving_kinds_ = 0;
  float radius_ = 0;  // of where things were in the first picture [m]
  glm::vec3 lit_center_{0};
  float lit_radius_ = 0, first_lit_radius_ = 0;  // [m]
  std::optional<std::set<dGeomID>> vessels_;     // that something was in at first
  glm::vec3 to_sun_ = view::Frame().to_sun;
};

// Sees all that can move, and where it falls to.
view::Camera overview(const view::Frame& frame);

}  // namespace falling_objects
