// SPDX-License-Identifier: BSD-3-Clause
// Contacts of the collider as planes that hold vertices of sheets.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cloth/sheet.h"
#include "meshes/surface.h"
#include "simulation/scene.h"

namespace falling_objects {

class SheetContacts {
 public:
  // Reads `sheets` in every step; there will be `count` of them.
  SheetContacts(const Scene& scene, const std::vector<std::unique_ptr<Sheet>>& sheets,
                std::size_t count);

  // Sorts the contacts by sheet, and passes over those of no sheet. They must stay while they are
  // read.
  void sort(std::span<const dContactGeom> contacts);
  // Those of one sheet. Changes nothing of any other: sheets may be read at the same time.
  void read(std::size_t sheet);

  // Of one sheet, in the order of the contacts, those with objects last: they decide. The owner is
  // an object, the ground if it is their number, and a sheet above that.
  std::vector<ClothContact>& planes_of(std::size_t sheet) { return planes_[sheet]; }

 private:
  bool is_sheet(dGeomID geom) const { return index_of(geom) >= first_sheet_; }
  void read_object(std::size_t sheet, const dContactGeom& contact);
  void read_other(std::size_t sheet, const dContactGeom& contact);
  bool vertex_of(std::size_t sheet, int triangle, Vector p, std::uint32_t& vertex) const;

  const Scene& scene_;
  const std::vector<std::unique_ptr<Sheet>>& sheets_;
  std::vector<Surface> surfaces_;  // of the shapes, and of the ground
  // Where each vertex of each sheet was last held: a good place to look from again.
  struct Hold {
    std::size_t owner = SIZE_MAX;
    std::size_t triangle = 0;
  };
  std::vector<std::vector<Hold>> holds_;
  std::size_t first_sheet_;                               // its index as a geom
  std::vector<std::vector<const dContactGeom*>> sorted_;  // by sheet
  std::vector<std::vector<ClothContact>> planes_;
};

}  // namespace falling_objects
