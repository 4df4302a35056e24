// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <stdexcept>

#include "meshes/shapes.h"

namespace falling_objects {

TriangleMesh read_mesh_file(const std::string& path) {
  Assimp::Importer importer;
  // Normals and texture coordinates keep vertices apart that are one vertex to a collider.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_Triangulate | aiProcess_RemoveComponent | aiProcess_SortByPType |
                aiProcess_JoinIdenticalVertices | aiProcess_PreTransformVertices);
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
  if (is_closed(mesh) && signed_volume(mesh) < 0) turn_inside_out(mesh);
  return mesh;
}

TriangleMesh load_mesh(const std::string& path) {
  TriangleMesh mesh = read_mesh_file(path);
  normalise(mesh, kShapeRadius);
  return mesh;
}

}  // namespace falling_objects
