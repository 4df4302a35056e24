// SPDX-License-Identifier: BSD-3-Clause
#include "makers/catalog.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "makers/solids.h"
#include "makers/spur_gear.h"
#include "makers/swept.h"
#include "makers/thread.h"
#include "meshes/ground.h"
#include "meshes/shapes.h"

namespace falling_objects {
namespace {

using Values = std::span<const double>;

unsigned whole(double value) { return static_cast<unsigned>(value); }

void expect(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

ShapeParameter length(const char* name, double fallback) { return {name, fallback, 1e-4, 1e3}; }
ShapeParameter count(const char* name, double fallback, double least, double most) {
  return {name, fallback, least, most, true};
}
ShapeParameter sides(double fallback) { return count("sides", fallback, 6, 400); }
ShapeParameter seed() { return count("seed", 1, 0, 1e9); }

Thread thread_of(Values v) {
  expect(v[0] > v[1], "'major' must be larger than 'minor'");
  expect(whole(v[3]) % 6 == 0, "'sides' must be a multiple of 6");
  return {v[0], v[1], v[2], whole(v[3]), whole(v[4])};
}

std::vector<ShapeParameter> thread_parameters(double turns, std::vector<ShapeParameter> more) {
  std::vector<ShapeParameter> all{length("major", 0.1), length("minor", 0.08),
                                  length("pitch", 0.05), count("sides", 36, 12, 240),
                                  count("turns", turns, 1, 100)};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<ShapeMaker> make_catalog() {
  std::vector<ShapeMaker> all;
  const auto add = [&](const char* name, const char* meaning,
                       std::vector<ShapeParameter> parameters,
                       std::function<TriangleMesh(Values)> make) {
    all.push_back({name, meaning, std::move(parameters), std::move(make)});
  };
  const auto add_plain = [&](const char* name, const char* meaning, TriangleMesh (*make)()) {
    add(name, meaning, {}, [make](Values) { return make(); });
  };
  add("cube", "a cube of cells x cells quads a face",
      {length("size", 1), count("cells", 1, 1, 100)},
      [](Values v) { return make_box(v[0], v[0], v[0], whole(v[1])); });
  add("box", "a box", {length("x", 1), length("y", 1), length("z", 1), count("cells", 1, 1, 100)},
      [](Values v) { return make_box(v[0], v[1], v[2], whole(v[3])); });
  add("plate", "a flat square box",
      {length("size", 10), length("thickness", 0.5), count("cells", 1, 1, 100)},
      [](Values v) { return make_box(v[0], v[0], v[1], whole(v[2])); });
  add("sphere", "a ball", {length("radius", 0.5), sides(24)},
      [](Values v) { return make_sphere(v[0], whole(v[1])); });
  add("cylinder", "a cylinder along z", {length("radius", 0.5), length("height", 1), sides(24)},
      [](Values v) { return make_cylinder(v[0], v[1], whole(v[2])); });
  add("torus", "a ring about z; the radii are those of its middle line and of its tube",
      {length("ring", 0.4), length("tube", 0.1), sides(36), count("tube_sides", 12, 3, 200)},
      [](Values v) {
        expect(v[0] > v[1], "'ring' must be larger than 'tube'");
        return make_torus(v[0], v[1], whole(v[2]), whole(v[3]));
      });
  add("pipe", "a cylinder along z with a hole through it",
      {length("outer", 0.5), length("inner", 0.4), length("height", 1), sides(24)}, [](Values v) {
        expect(v[0] > v[1], "'outer' must be larger than 'inner'");
        return make_pipe(v[0], v[1], v[2], whole(v[3]));
      });
  add("shell", "a hollow ball", {length("outer", 0.5), length("inner", 0.4), sides(24)},
      [](Values v) {
        expect(v[0] > v[1], "'outer' must be larger than 'inner'");
        return make_shell(v[0], v[1], whole(v[2]));
      });
  add("cup", "a cylinder with a floor, open at the top",
      {length("radius", 0.5), length("height", 1), length("wall", 0.1), sides(24)}, [](Values v) {
        expect(v[2] < std::min(v[0], v[1]), "'wall' must be less than 'radius' and 'height'");
        return make_cup(v[0], v[1], v[2], whole(v[3]));
      });
  add("rock", "a ball with bumps",
      {length("radius", 0.5), {"roughness", 0.3, 0, 0.5}, sides(24), seed()}, [](Values v) {
        return make_rock(v[0], v[1], whole(v[2]), static_cast<std::uint64_t>(v[3]));
      });
  add("terrain", "hills on a square slab; steepness raises the border, as a bowl",
      {length("half_size", 10), {"steepness", 0, 0, 2}, seed()},
      [](Values v) { return Ground(v[0], static_cast<std::uint64_t>(v[2]), v[1]).mesh(); });
  add("spur-gear", "an involute gear about z, a tooth on the x axis; radius = teeth * module / 2",
      {count("teeth", 18, 12, 200),
       length("module", 0.1),
       length("thickness", 0.2),
       {"backlash", 0.01, 0, 1},
       {"bore", 0, 0, 1e3}},
      [](Values v) {
        expect(v[3] < v[1], "'backlash' must be less than 'module'");
        expect(v[4] < v[1] * (v[0] / 2 - 1.25), "'bore' must be less than the root radius");
        return make_spur_gear({whole(v[0]), v[1], v[2], v[3], v[4]});
      });
  add("bolt", "a bolt along z, its thread from z = 0 upwards, its head below",
      thread_parameters(6, {length("head_radius", 0.2), {"head_height", 0.1, 0, 1e3}}),
      [](Values v) {
        expect(v[6] == 0 || v[5] > 1.2 * v[0], "'head_radius' must be larger than 1.2 'major'");
        return make_bolt(thread_of(v), v[5], v[6]);
      });
  add("nut", "a nut for such a bolt, which fits a whole number of pitches above it",
      thread_parameters(2, {length("clearance", 0.002), length("radius", 0.2)}), [](Values v) {
        const Thread thread = thread_of(v);
        expect(v[5] < std::min(0.1 * v[2], v[0] - v[1]),
               "'clearance' must be less than 'pitch' / 10");
        expect(v[6] > 1.3 * v[0], "'radius' must be larger than 1.3 'major'");
        return make_nut(thread, v[5], v[6]);
      });
  add("link", "a link of a chain, long along z; links hang in each other `length` apart",
      {length("length", 0.3), length("width", 0.14), length("wire", 0.05),
       count("sides", 12, 6, 60)},
      [](Values v) {
        expect(v[0] > v[1], "'length' must be larger than 'width'");
        expect(v[1] > 2 * v[2], "'width' must be larger than twice 'wire'");
        return make_link(v[0], v[1], v[2], whole(v[3]));
      });
  add("hook", "a hook in the x-z plane; its bend is about the origin, its shank at -x goes up",
      {length("radius", 0.12),
       length("shank", 0.3),
       {"tip", 0.05, 0, 1e3},
       length("wire", 0.05),
       count("sides", 12, 6, 60)},
      [](Values v) {
        expect(v[0] > v[3], "'radius' must be larger than 'wire'");
        return make_hook(v[0], v[1], v[2], v[3], whole(v[4]));
      });
  add_plain("horseshoe", "of the paper's scenes: 902 triangles, radius 0.5", make_horseshoe);
  add_plain("bumpy-torus", "of the paper's scenes: 2,130 triangles", make_bumpy_torus);
  add_plain("jack", "of the paper's scenes: 3,264 triangles", make_jack);
  add_plain("gear", "of the paper's scenes: 3,458 triangles", make_gear);
  return all;
}

}  // namespace

const std::vector<ShapeMaker>& shape_makers() {
  static const std::vector<ShapeMaker> all = make_catalog();
  return all;
}

const ShapeMaker* find_shape_maker(const std::string& name) {
  const auto& all = shape_makers();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const ShapeMaker& m) { return name == m.name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace falling_objects
