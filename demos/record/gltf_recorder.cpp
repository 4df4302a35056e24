// SPDX-License-Identifier: BSD-3-Clause
#include "record/gltf_recorder.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <stdexcept>

namespace falling_objects {
namespace {

// Told apart by lightness, too.
constexpr std::array<std::array<double, 3>, 8> kColors{{{0.85, 0.47, 0.22},
                                                        {0.25, 0.51, 0.76},
                                                        {0.93, 0.76, 0.31},
                                                        {0.33, 0.62, 0.41},
                                                        {0.70, 0.36, 0.56},
                                                        {0.55, 0.78, 0.85},
                                                        {0.61, 0.50, 0.40},
                                                        {0.80, 0.80, 0.78}}};

// Vertices, triangles and poses go into one buffer, each run of them as a view with an accessor.
class ModelWriter {
 public:
  ModelWriter() { model_.buffers.emplace_back(); }

  // `limits`: the accessor must say what its least and greatest values are.
  template <std::size_t N>
  int add(const std::vector<std::array<float, N>>& values, int type, bool limits = false) {
    tinygltf::Accessor accessor;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = type;
    accessor.count = values.size();
    for (std::size_t k = 0; limits && k < N; ++k) {
      const auto [least, most] = std::minmax_element(
          values.begin(), values.end(), [&](const auto& a, const auto& b) { return a[k] < b[k]; });
      accessor.minValues.push_back(static_cast<double>((*least)[k]));
      accessor.maxValues.push_back(static_cast<double>((*most)[k]));
    }
    return add(accessor, values.data(), values.size() * sizeof(values[0]), 0);
  }

  int add_mesh(const std::string& name, const TriangleMesh& mesh) {
    std::vector<std::array<float, 3>> vertices(mesh.vertex_count());
    std::memcpy(vertices.data(), mesh.vertices.data(), mesh.vertices.size() * sizeof(float));
    tinygltf::Accessor indices;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.type = TINYGLTF_TYPE_SCALAR;
    indices.count = mesh.indices.size();
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = add(vertices, TINYGLTF_TYPE_VEC3, true);
    primitive.indices = add(indices, mesh.indices.data(), mesh.indices.size() * sizeof(unsigned),
                            TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    model_.bufferViews[model_.bufferViews.size() - 2].target = TINYGLTF_TARGET_ARRAY_BUFFER;
    primitive.material = add_material(name);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    tinygltf::Mesh out;
    out.name = name;
    out.primitives.push_back(primitive);
    model_.meshes.push_back(out);
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  int add_node(const tinygltf::Node& node) {
    model_.nodes.push_back(node);
    return static_cast<int>(model_.nodes.size()) - 1;
  }

  tinygltf::Model& model() { return model_; }

 private:
  int add(tinygltf::Accessor accessor, const void* data, std::size_t size, int target) {
    std::vector<unsigned char>& bytes = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = size;
    view.target = target;
    // All are of 4 bytes: what follows is aligned.
    const auto* first = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), first, first + size);
    model_.bufferViews.push_back(view);
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_material(const std::string& name) {
    const auto& [red, green, blue] = kColors[model_.materials.size() % kColors.size()];
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {red, green, blue, 1};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.7;
    model_.materials.push_back(material);
    return static_cast<int>(model_.materials.size()) - 1;
  }

  tinygltf::Model model_;
};

template <std::size_t N>
std::vector<double> as_doubles(const std::array<float, N>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

GltfRecorder::GltfRecorder(const Scene& scene) : scene_(scene), tracks_(scene.objects().size()) {}

void GltfRecorder::record(double time) {
  times_.push_back(static_cast<float>(time));
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const dBodyID body = scene_.objects()[i].body;
    const dReal* p = dBodyGetPosition(body);
    const dReal* q = dBodyGetQuaternion(body);
    Track& track = tracks_[i];
    // Of the two quaternions of a rotation the one that is nearer to the last: what is between them
    // is the way that was gone.
    double sign = 1;
    if (!track.rotations.empty()) {
      const auto& last = track.rotations.back();
      const double same = q[1] * static_cast<double>(last[0]) +
                          q[2] * static_cast<double>(last[1]) +
                          q[3] * static_cast<double>(last[2]) + q[0] * static_cast<double>(last[3]);
      if (same < 0) sign = -1;
    }
    const auto as_float = [](double x) { return static_cast<float>(x); };
    track.positions.push_back({as_float(p[0]), as_float(p[1]), as_float(p[2])});
    track.rotations.push_back({as_float(sign * q[1]), as_float(sign * q[2]), as_float(sign * q[3]),
                               as_float(sign * q[0])});
  }
}

void GltfRecorder::write(const std::string& path) const {
  ModelWriter writer;
  for (const Shape& shape : scene_.shapes()) writer.add_mesh(shape.name, shape.mesh);
  tinygltf::Node root;
  root.name = "scene";
  root.rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  tinygltf::Animation animation;
  animation.name = "run";
  std::vector<std::array<float, 1>> times;
  for (const float time : times_) times.push_back({time});
  const int input = writer.add(times, TINYGLTF_TYPE_SCALAR, true);
  const auto animate = [&](int node, const char* path_of_node, int output) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = node;
    channel.target_path = path_of_node;
    animation.samplers.push_back(sampler);
    animation.channels.push_back(channel);
  };
  if (!scene_.ground().empty()) {
    tinygltf::Node ground;
    ground.name = "ground";
    ground.mesh = writer.add_mesh("ground", scene_.ground().mesh());
    root.children.push_back(writer.add_node(ground));
  }
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    const Object& object = scene_.objects()[i];
    tinygltf::Node node;
    node.name = scene_.name_of(i);
    node.mesh = static_cast<int>(object.shape);
    node.translation = as_doubles(track.positions.front());
    node.rotation = as_doubles(track.rotations.front());
    const int number = writer.add_node(node);
    root.children.push_back(number);
    if (std::adjacent_find(track.positions.begin(), track.positions.end(), std::not_equal_to<>()) !=
        track.positions.end()) {
      animate(number, "translation", writer.add(track.positions, TINYGLTF_TYPE_VEC3));
    }
    if (std::adjacent_find(track.rotations.begin(), track.rotations.end(), std::not_equal_to<>()) !=
        track.rotations.end()) {
      animate(number, "rotation", writer.add(track.rotations, TINYGLTF_TYPE_VEC4));
    }
  }
  tinygltf::Model& model = writer.model();
  tinygltf::Scene scene;
  scene.nodes = {writer.add_node(root)};
  model.scenes = {scene};
  model.defaultScene = 0;
  model.asset.version = "2.0";
  model.asset.generator = "falling_objects of ode_ext";
  if (!animation.channels.empty()) model.animations = {animation};
  std::ofstream file(path, std::ios::binary);
  const bool written = tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, file, false, true);
  file.close();
  if (!written || !file) throw std::runtime_error("cannot write '" + path + "'");
}

}  // namespace falling_objects
