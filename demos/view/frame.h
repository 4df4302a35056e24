// SPDX-License-Identifier: BSD-3-Clause
// What a picture shows of a world, as plain data: whoever simulates fills it, the renderer draws
// it. Lengths are in metres, z is up, colors are as on the screen (sRGB, 0 to 1).
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace view {

using Pose = glm::mat4x3;    // columns: the three axes, then the position
using MeshId = std::size_t;  // as Renderer::add_mesh returned it
using Color = glm::vec3;

struct Instance {
  MeshId mesh;
  Pose pose;
  Color color;
};

// A surface that changes its shape, seen from both sides.
struct Cloth {
  std::vector<glm::vec3> vertices;
  std::vector<unsigned> triangles;  // three vertices each
  Color color;
};

// Drawn over everything, fainter where something is in front.
struct Arrow {
  glm::vec3 from, to;
  Color color;
};

// Edges of a box along the axes.
struct Box {
  glm::vec3 low, high;
  Color color;
};

// Triangles that are marked, as bright as their color: in front of the surface that they lie on, or
// over everything, fainter where something is in front.
struct Patch {
  std::vector<glm::vec3> corners;  // three a triangle
  Color color;
  bool over_all = false;
};

struct Frame {
  std::vector<Instance> grounds;  // do not move, and carry a grid of 1 m
  std::vector<Instance> objects;
  std::vector<Instance> glass;  // objects that what is in them is seen through
  std::vector<Cloth> cloths;
  std::vector<Arrow> arrows;
  std::vector<Box> boxes;
  std::vector<Patch> patches;
  std::vector<Instance> shown_through;     // drawn once more, faint, where something is in front
  glm::vec3 to_sun{0.57F, -0.23F, 0.79F};  // unit
  // The ball in which shadows fall.
  glm::vec3 center{0};
  float radius = 1;
  // In the corner of the picture: the first line is its title.
  std::vector<std::string> caption;
};

}  // namespace view
