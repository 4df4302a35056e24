// SPDX-License-Identifier: BSD-3-Clause
#include "scene_file/body_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "makers/catalog.h"
#include "meshes/mesh_file.h"
#include "meshes/random.h"
#include "scene_file/rotation.h"

namespace falling_objects {
namespace {

constexpr int kMostBodies = 1000000;  // of a [[body]]; as many as [drop] takes

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const ShapeMaker& maker : shape_makers()) names.emplace_back(maker.name);
  return names;
}

TriangleMesh make_shape(const ShapeMaker& maker, TomlTable& table) {
  std::vector<double> values;
  for (const ShapeParameter& p : maker.parameters) {
    if (p.whole) {
      values.push_back(table.whole(p.name, static_cast<int>(p.fallback), static_cast<int>(p.least),
                                   static_cast<int>(p.most)));
    } else {
      values.push_back(table.number(p.name, p.fallback, {p.least, p.most}));
    }
  }
  try {
    return maker.make(values);
  } catch (const std::invalid_argument& e) {
    table.fail(std::string("a ") + maker.name + ": " + e.what());
  }
}

TriangleMesh make_shape(const ShapeMaker& maker) {
  std::vector<double> values;
  for (const ShapeParameter& p : maker.parameters) values.push_back(p.fallback);
  return maker.make(values);
}

// Where the bodies of a table stand, seen from the first, and how far they are twisted [rad].
struct Site {
  Point position;
  double twist;
};

std::vector<Site> read_sites(TomlTable& table) {
  const Point spacing = table.point("spacing", {1, 1, 1});
  const double twist = table.number("twist", 0) * std::numbers::pi / 180;
  const int layers = table.whole("pyramid", 0, 1, 1000);
  const std::vector<double> counts =
      table.optional_numbers("count", 3).value_or(std::vector<double>{1, 1, 1});
  for (const double count : counts) {
    if (!(count >= 1 && count == std::floor(count))) {
      table.fail("count", "'count' must be three whole numbers from 1 on");
    }
  }
  if (const double bodies = counts[0] * counts[1] * counts[2]; bodies > kMostBodies) {
    std::ostringstream text;
    text << "'count' makes " << std::fixed << std::setprecision(0) << bodies << " bodies, at most "
         << kMostBodies;
    table.fail("count", text.str());
  }
  if (layers > 0 && table.has("count")) table.fail("pyramid", "'pyramid' goes without 'count'");
  std::vector<Site> sites;
  if (layers > 0) {
    // A wall that narrows: each layer has one body less than the one below.
    for (int layer = 0; layer < layers; ++layer) {
      for (int i = 0; i < layers - layer; ++i) {
        sites.push_back({{spacing[0] * (i - (layers - 1 - layer) / 2.0), 0, spacing[2] * layer},
                         twist * layer});
      }
    }
    return sites;
  }
  for (int k = 0; k < counts[2]; ++k) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        sites.push_back({{spacing[0] * (i - (counts[0] - 1) / 2),
                          spacing[1] * (j - (counts[1] - 1) / 2), spacing[2] * k},
                         twist * k});
      }
    }
  }
  return sites;
}

}  // namespace

BodyReader::BodyReader(SceneDescription& scene, std::string folder)
    : scene_(scene), folder_(std::move(folder)) {}

void BodyReader::add_mesh(const std::string& name, TriangleMesh mesh) {
  const Point middle = center_on_mass(mesh);
  numbers_.emplace(name, scene_.meshes.size());
  origins_.push_back({-middle[0], -middle[1], -middle[2]});
  scene_.meshes.push_back({name, std::move(mesh)});
}

void BodyReader::read_mesh(const std::string& name, TomlTable& table) {
  if (const std::string file = table.text("file", ""); !file.empty()) {
    if (table.has("shape")) table.fail("shape", "a mesh has 'shape' or 'file', not both");
    const std::filesystem::path path = std::filesystem::path(folder_) / file;
    const auto radius = table.optional_number("radius", kPositive);
    if (radius && table.has("scale"))
      table.fail("scale", "a mesh has 'radius' or 'scale', not both");
    const double scale = table.number("scale", 1, kPositive);
    TriangleMesh mesh;
    try {
      scene_.files.push_back(path.string());
      mesh = read_mesh_file(path.string());
      center_on_mass(mesh);
      scale_mesh(mesh, radius ? *radius / bounding_radius(mesh) : scale);
      check_reach(mesh, path.string());
      check_has_volume(mesh, path.string());
    } catch (const std::runtime_error& e) {
      table.fail("file", e.what());
    }
    add_mesh(name, std::move(mesh));
  } else {
    const std::string shape = table.text("shape");
    const ShapeMaker* maker = find_shape_maker(shape);
    if (maker == nullptr) {
      table.fail("shape", "'" + shape + "' is no shape; there are " + list(shape_names()));
    }
    TriangleMesh mesh = make_shape(*maker, table);
    try {
      check_has_volume(mesh, name);
    } catch (const std::runtime_error& e) {
      table.fail("shape", e.what());
    }
    add_mesh(name, std::move(mesh));
  }
  table.finish();
}

std::size_t BodyReader::mesh_named(const std::string& name, const char* key,
                                   const TomlTable& table) {
  if (const auto found = numbers_.find(name); found != numbers_.end()) return found->second;
  const ShapeMaker* maker = find_shape_maker(name);
  if (maker == nullptr) {
    std::vector<std::string> own;
    for (const auto& [known, number] : numbers_) own.push_back(known);
    table.fail(key,
               "there is no mesh '" + name + "'; " +
                   (own.empty() ? std::string("the file has none") : "the file has " + list(own)) +
                   ", and every shape is one: " + list(shape_names()));
  }
  add_mesh(name, make_shape(*maker));
  return scene_.meshes.size() - 1;
}

void BodyReader::read_body(TomlTable& table) {
  BodyDescription body;
  const std::string mesh = table.text("mesh");
  body.mesh = mesh_named(mesh, "mesh", table);
  const std::string name = table.text("name", mesh);
  const Point at = table.point("at", {0, 0, 0});
  if (const auto v = table.optional_numbers("turn", 4)) {
    const Point axis{(*v)[0], (*v)[1], (*v)[2]};
    if (axis == Point{0, 0, 0}) {
      table.fail("turn", "'turn' is an axis, which must have a length, and an angle in degrees");
    }
    body.rotation =
        rotation_about(direction_of(axis), std::fmod((*v)[3], 360) * std::numbers::pi / 180);
  }
  body.velocity = table.point("velocity", {0, 0, 0});
  body.spin = table.point("spin", {0, 0, 0});
  body.density = table.number("density", body.density, kPositive);
  body.mu = table.optional_number("mu", kNotNegative);
  const std::string motion = table.choice("motion", "free", {"free", "fixed", "driven"});
  body.motion = motion == "free"    ? Motion::kFree
                : motion == "fixed" ? Motion::kFixed
                                    : Motion::kDriven;
  const double jitter = table.number("jitter", 0, kNotNegative);
  const bool tumble = table.flag("tumble", false);
  Random random(static_cast<std::uint64_t>(table.whole("seed", 1, 0, 1000000000)));
  const std::vector<Site> sites = read_sites(table);
  table.finish();
  const Quaternion turn = body.rotation;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    body.name = sites.size() == 1 ? name : name + ' ' + std::to_string(i + 1);
    const Quaternion twisted = product(rotation_about({0, 0, 1}, sites[i].twist), turn);
    body.rotation = tumble ? random_rotation(random) : twisted;
    const Point origin = rotate(body.rotation, origins_[body.mesh]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double aside = jitter > 0 ? random.between(-jitter, jitter) : 0;
      body.position[k] = at[k] + sites[i].position[k] + aside - origin[k];
    }
    scene_.bodies.push_back(body);
  }
}

std::size_t BodyReader::body_named(const char* key, TomlTable& table) const {
  return body_named(key, table.text(key), table);
}

std::size_t BodyReader::body_named(const char* key, const std::string& name,
                                   const TomlTable& table) const {
  const auto& bodies = scene_.bodies;
  const auto is_named = [&](const BodyDescription& body) { return body.name == name; };
  const auto found = std::find_if(bodies.begin(), bodies.end(), is_named);
  if (const auto count = std::count_if(found, bodies.end(), is_named); count > 1) {
    table.fail(key, std::to_string(count) + " bodies are named '" + name +
                        "': give each [[body]] a 'name' of its own");
  }
  if (bodies.empty()) {
    table.fail(key, "there is no body '" + name + "': what is dropped has no names");
  }
  if (found == bodies.end()) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min<std::size_t>(bodies.size(), 20); ++i)
      names.push_back(bodies[i].name);
    table.fail(key, "there is no body '" + name + "'; there are " + list(names) +
                        (bodies.size() > 20 ? ", ..." : ""));
  }
  return static_cast<std::size_t>(found - bodies.begin());
}

std::vector<std::size_t> BodyReader::bodies_named(const char* key, TomlTable& table) const {
  const std::string name = table.text(key);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    const std::string number = std::to_string(numbers.size() + 1);
    if (scene_.bodies[i].name == name + ' ' + number) numbers.push_back(i);
  }
  if (numbers.empty()) return {body_named(key, table)};
  body_named(key, name + " 1", table);  // fails where that is the name of several
  if (std::any_of(scene_.bodies.begin(), scene_.bodies.end(),
                  [&](const BodyDescription& body) { return body.name == name; })) {
    table.fail(key, "one body is named '" + name + "', and others '" + name + " 1' to '" + name +
                        ' ' + std::to_string(numbers.size()) +
                        "': give each [[body]] a 'name' of its own");
  }
  return numbers;
}

}  // namespace falling_objects
