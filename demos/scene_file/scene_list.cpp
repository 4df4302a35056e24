// SPDX-License-Identifier: BSD-3-Clause
#include "scene_file/scene_list.h"

#include <iomanip>

#include "makers/catalog.h"
#include "scene_file/scene_file.h"

namespace falling_objects {

void print_scenes(std::ostream& out) {
  out << "Scenes:\n";
  for (const std::string& name : scene_names()) {
    out << "  " << std::left << std::setw(18) << name
        << read_scene_file(find_scene_file(name)).title << '\n';
  }
  out << "\nShapes, and their parameters with what they are by default (lengths in meters):\n";
  for (const ShapeMaker& maker : shape_makers()) {
    out << "  " << std::left << std::setw(18) << maker.name << maker.meaning << '\n';
    if (maker.parameters.empty()) continue;
    out << std::string(20, ' ');
    const char* separator = "";
    for (const ShapeParameter& p : maker.parameters) {
      out << separator << p.name << " = " << p.fallback;
      separator = ", ";
    }
    out << '\n';
  }
}

}  // namespace falling_objects
