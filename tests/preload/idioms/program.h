// SPDX-License-Identifier: BSD-3-Clause
// What every program of this directory is made of. Built twice: against ODE alone, for a run as it
// is and one under the preload, and with the API's calls in place of ODE's.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace idioms {

// Contacts are to be sound, which ODE's own are not always.
extern bool must_be_sound;

// A pass, by ODE or by the API. Each thread has a collider of its own where the API is used.
void space_collide(dSpaceID space, void* data, dNearCallback* callback);
void space_collide2(dGeomID g1, dGeomID g2, void* data, dNearCallback* callback);
// The API wants to be told where no pass looks at meshes; the preload sees it by itself.
void announce_change(dTriMeshDataID data);
// Around dInitODE2 and dCloseODE, in the thread that makes the passes.
void begin();
void end();

// Prints `message` and ends the program.
[[noreturn]] void fail(const std::string& message);

// Equal numbers on every machine.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) {}
  double between(double low, double high);

 private:
  std::uint32_t state_;
};

// A torus about z of 192 triangles, or a cube of 12: what ODE's mesh refers to.
class Mesh {
 public:
  enum Shape { kTorus, kCube };
  explicit Mesh(Shape shape, float scale = 1);
  ~Mesh();
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;

  void build();                 // from the vertices as they are
  void stretch(float along_x);  // in place
  dTriMeshDataID data() const { return data_; }

 private:
  void add_torus();
  void add_cube();

  dTriMeshDataID data_;
  std::vector<std::array<float, 3>> vertices_;
  std::vector<dTriIndex> indices_;
};

// What was asked and answered, printed at the end: a line a pair, which is the same whoever
// collides, and its contacts to the last bit.
class Log {
 public:
  void pair(dGeomID g1, dGeomID g2, const dContactGeom* contacts, int count,
            std::size_t skip = sizeof(dContactGeom));
  void next_step() { ++step_; }
  const std::string& text() const { return text_; }

 private:
  int step_ = 0;
  std::string text_;
};

// Bodies with a mesh each, in a space or several.
class Bodies {
 public:
  ~Bodies();
  dGeomID add(dWorldID world, dSpaceID space, const Mesh& mesh);
  void place(Random& random, double extent);  // each anywhere in a cube of that edge [m]
  void destroy_first();

  std::vector<dBodyID> bodies;
  std::vector<dGeomID> geoms;

 private:
  int added_ = 0;
};

void name(dGeomID geom, int number);  // by which it is printed
void place(dBodyID body, Random& random, double extent);

}  // namespace idioms
