// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include "meshes/parts.h"
#include "meshes/shapes.h"

namespace falling_objects {
namespace {

// The library leaves alone what is less across or reaches farther [m] (README, "Limits").
constexpr double kLeastExtent = 1.0 / (1 << 30);
constexpr double kMostReach = static_cast<double>(std::uint64_t{1} << 36);
// Of a closed mesh, a share of the cube of its largest extent. Vertices are floats: a needle whose
// thickness is rounding, 6e-8 of its length, has 4e-15. ODE aborts where a mass is not positive,
// and where dividing by it gives no number.
constexpr double kLeastVolume = 1e-13;

}  // namespace

void check_reach(const TriangleMesh& mesh, const std::string& path) {
  if (!(bounding_radius(mesh) <= kMostReach))
    throw std::runtime_error("the mesh '" + path + "' is too large: the library takes 6.8e10 m");
}

void check_has_volume(const TriangleMesh& mesh, const std::string& path) {
  Point low = mesh.vertex(0), high = low;
  for (std::size_t i = 1; i < mesh.vertex_count(); ++i) {
    const Point p = mesh.vertex(i);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (!std::isfinite(extent)) throw std::runtime_error("the mesh '" + path + "' is too large");
  TriangleMesh unit;  // far from the origin its volume would be a difference of large numbers
  unit.indices = mesh.indices;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Point p = mesh.vertex(i);
    unit.add_vertex({(p[0] - low[0]) / extent, (p[1] - low[1]) / extent, (p[2] - low[2]) / extent});
  }
  const bool is_flat = is_closed(mesh) && !(signed_volume(unit) >= kLeastVolume);
  if (!(extent >= kLeastExtent) || is_flat) {
    throw std::runtime_error("the mesh '" + path + "' is too small or too flat to have a volume");
  }
}

TriangleMesh read_mesh_file(const std::string& path) {
  if (std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot read the mesh '" + path + "': it is a folder");
  }
  Assimp::Importer importer;
  // Normals and texture coordinates keep vertices apart that are one vertex to a collider.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_RemoveComponent |
                aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr) {
    throw std::runtime_error("cannot read the mesh '" + path + "': " + importer.GetErrorString());
  }
  TriangleMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const auto first = static_cast<unsigned>(mesh.vertex_count());
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& v = part.mVertices[i];
      mesh.add_vertex({v.x, v.y, v.z});
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices == 3) {
        mesh.add_triangle(first + face.mIndices[0], first + face.mIndices[1],
                          first + face.mIndices[2]);
      }
    }
  }
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                   [](float x) { return std::isfinite(x); })) {
    throw std::runtime_error("the mesh '" + path + "' has a vertex that is not finite");
  }
  weld(mesh);
  if (mesh.triangle_count() == 0) {
    throw std::runtime_error("the mesh '" + path + "' holds no triangle");
  }
  if (is_closed(mesh)) turn_parts_outwards(mesh);
  check_has_volume(mesh, path);
  return mesh;
}

TriangleMesh load_mesh(const std::string& path) {
  TriangleMesh mesh = read_mesh_file(path);
  normalise(mesh, kShapeRadius);
  return mesh;
}

}  // namespace falling_objects
