// SPDX-License-Identifier: BSD-3-Clause
// Prints the contacts of two meshes as JSON, from ode_ext or from ODE's own collider: what a
// program gets that collides given pairs without a space. scripts/contact-pictures draws them.
#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "contacts/pairs.h"

namespace contacts {
namespace {

using nlohmann::json;

constexpr int kMost = 16;

// As of falling_objects.
enum ExitCode { kExitOk = 0, kExitFailed = 1, kExitUsage = 2 };

// ODE keeps pointers to the mesh: it has to live as long as this.
class Body {
 public:
  explicit Body(const Placed& placed) : data_(dGeomTriMeshDataCreate()), mesh_(placed.mesh) {
    dGeomTriMeshDataBuildSingle(data_, mesh_.vertices.data(), 3 * sizeof(float),
                                static_cast<int>(mesh_.vertices.size() / 3), mesh_.indices.data(),
                                static_cast<int>(mesh_.indices.size()), 3 * sizeof(dTriIndex));
    geom_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
    dGeomSetPosition(geom_, placed.position[0], placed.position[1], placed.position[2]);
    dGeomSetQuaternion(geom_, placed.turn);
  }
  ~Body() {
    dGeomDestroy(geom_);
    dGeomTriMeshDataDestroy(data_);
  }
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  dGeomID geom() const { return geom_; }

  json in_world() const {
    json vertices = json::array(), triangles = json::array();
    for (std::size_t i = 0; i < mesh_.vertices.size(); i += 3) {
      const dReal* r = dGeomGetRotation(geom_);
      const dReal* p = dGeomGetPosition(geom_);
      json place = json::array();
      for (int row = 0; row < 3; ++row)
        place.push_back(p[row] + r[4 * row] * mesh_.vertices[i] +
                        r[4 * row + 1] * mesh_.vertices[i + 1] +
                        r[4 * row + 2] * mesh_.vertices[i + 2]);
      vertices.push_back(place);
    }
    for (std::size_t i = 0; i < mesh_.indices.size(); i += 3)
      triangles.push_back({mesh_.indices[i], mesh_.indices[i + 1], mesh_.indices[i + 2]});
    return {{"vertices", vertices}, {"triangles", triangles}};
  }

 private:
  dTriMeshDataID data_;
  Mesh mesh_;
  dGeomID geom_ = nullptr;
};

std::vector<dContactGeom> collide(dGeomID g1, dGeomID g2, bool stock) {
  std::vector<dContactGeom> found(kMost);
  int count = 0;
  if (stock) {  // no collider exists: this is plain ODE
    count = dCollide(g1, g2, kMost, found.data(), sizeof(dContactGeom));
  } else {
    dBatchColliderID collider = dBatchColliderCreate(nullptr);
    const dGeomID pair[] = {g1, g2};
    if (collider == nullptr || dBatchColliderCollidePairs(collider, pair, 1, kMost, found.data(),
                                                          sizeof(dContactGeom), &count) < 0)
      throw std::runtime_error(dBatchColliderGetLastErrorMessage());
    dBatchColliderDestroy(collider);
  }
  found.resize(static_cast<std::size_t>(count));
  return found;
}

json describe(const Pair& pair, bool stock) {
  const Body upper(pair.upper()), lower(pair.lower());
  json contacts = json::array();
  for (const dContactGeom& c : collide(upper.geom(), lower.geom(), stock))
    contacts.push_back({{"position", {c.pos[0], c.pos[1], c.pos[2]}},
                        {"normal", {c.normal[0], c.normal[1], c.normal[2]}},
                        {"depth", c.depth}});
  return {{"pair", pair.name},
          {"sentence", pair.sentence},
          {"collider", stock ? "ODE" : "ode_ext"},
          {"overlap", pair.depth},
          {"meshes", {upper.in_world(), lower.in_world()}},
          {"contacts", contacts}};
}

}  // namespace
}  // namespace contacts

int main(int argc, char** argv) {
  using namespace contacts;
  std::string name = all_pairs()[0].name;
  bool stock = false;
  CLI::App app("Prints the contacts of a pair of meshes as JSON.", "contacts");
  std::string footer = "Pairs:\n";
  std::vector<std::string> names;
  for (const Pair& pair : all_pairs()) {
    names.push_back(pair.name);
    footer += std::string("  ") + pair.name + "  " + pair.sentence + "\n";
  }
  app.footer(footer + "Normals point into the first mesh. The device is that of ODE_EXT_DEVICE.");
  app.add_option("pair", name, "Which pair")->check(CLI::IsMember(names))->capture_default_str();
  app.add_flag("--stock", stock, "The contacts of ODE's own collider instead");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitOk : kExitUsage;
  }
  ExitCode exit_code = kExitOk;
  dInitODE2(0);
  try {
    for (const Pair& pair : all_pairs())
      if (name == pair.name) std::puts(describe(pair, stock).dump().c_str());
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw std::runtime_error("the contacts could not be written");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contacts: %s\n", error.what());
    exit_code = kExitFailed;
  }
  dCloseODE();
  return exit_code;
}
