// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/snapshot.h"

#include <limits>
#include <string>

#include "simulation/pose.h"

namespace falling_objects {
namespace {

class ObjWriter {
 public:
  // As many digits as tell one float from the next: far from the origin fewer move what touches.
  explicit ObjWriter(std::ostream& out) : out_(out) {
    out_.precision(std::numeric_limits<float>::max_digits10);
  }

  void write(const std::string& name, const std::vector<Vector>& vertices,
             const std::vector<unsigned>& triangles) {
    out_ << "g " << name << '\n';
    for (const Vector& v : vertices) out_ << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      out_ << 'f';
      for (std::size_t k = 0; k < 3; ++k) out_ << ' ' << first_ + triangles[i + k];
      out_ << '\n';
    }
    first_ += vertices.size();
  }

 private:
  std::ostream& out_;
  std::size_t first_ = 1;  // OBJ counts from one
};

}  // namespace

void write_snapshot(std::ostream& out, const Scene& scene,
                    const std::vector<std::unique_ptr<Sheet>>& sheets) {
  ObjWriter writer(out);
  const auto write = [&](const std::string& name, const TriangleMesh& mesh, dBodyID body) {
    const auto pose = pose_of(body);
    std::vector<Vector> vertices;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      const auto [x, y, z] = mesh.vertex(i);
      vertices.push_back(pose.to_world({x, y, z}));
    }
    writer.write(name, vertices, mesh.indices);
  };
  if (!scene.ground().empty()) write("ground", scene.ground().mesh(), nullptr);
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    write("object_" + std::to_string(i), scene.shape_of(i).mesh, scene.objects()[i].body);
  }
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const Cloth& cloth = sheets[i]->cloth();
    writer.write("sheet_" + std::to_string(i), cloth.positions(), cloth.triangles());
  }
}

}  // namespace falling_objects
