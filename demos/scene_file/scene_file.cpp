// SPDX-License-Identifier: BSD-3-Clause
#include "scene_file/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "meshes/mesh_file.h"
#include "scene_file/body_reader.h"
#include "scene_file/rotation.h"
#include "scene_file/toml_table.h"

namespace falling_objects {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".toml";

// Beside an installed program, and where this one was built from.
std::vector<fs::path> scene_folders() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return {program.parent_path().parent_path() / "share/ode_ext/scenes", FALLING_OBJECTS_SCENES};
}

void read_world(TomlTable& table, WorldSettings& world) {
  world.gravity = table.point("gravity", world.gravity);
  world.solver = table.choice("solver", "quick", {"quick", "exact"}) == "quick" ? Solver::kQuick
                                                                                : Solver::kExact;
  world.iterations = table.whole("iterations", world.iterations, 1, 100000);
  world.erp = table.number("erp", world.erp, kShare);
  world.cfm = table.number("cfm", world.cfm, kNotNegative);
  world.surface_layer = table.number("surface_layer", world.surface_layer, kNotNegative);
  world.correcting_speed = table.number("correcting_speed", world.correcting_speed, kNotNegative);
  world.linear_damping = table.number("linear_damping", world.linear_damping, kShare);
  world.angular_damping = table.number("angular_damping", world.angular_damping, kShare);
  table.finish();
}

void read_contact(TomlTable& table, ContactSettings& contact) {
  contact.per_pair = table.whole("per_pair", contact.per_pair, 1, 64);
  contact.mu = table.number("mu", contact.mu, kNotNegative);
  contact.bounce = table.number("bounce", contact.bounce, kShare);
  contact.bounce_speed = table.number("bounce_speed", contact.bounce_speed, kNotNegative);
  contact.soft_erp = table.optional_number("soft_erp", kShare);
  contact.soft_cfm = table.optional_number("soft_cfm", kNotNegative);
  table.finish();
}

// Of all that the file knows, those meshes remain that are dropped, in the order in which they are
// named.
Drop read_drop(TomlTable& table, SceneDescription& scene, BodyReader& bodies) {
  Drop drop;
  drop.objects = table.whole("objects", drop.objects, 1, 1000000);
  drop.sheets = table.whole("sheets", drop.sheets, 0, 1000);
  std::vector<NamedMesh> meshes;
  for (const std::string& name : table.texts("meshes")) {
    const std::size_t number = bodies.mesh_named(name, "meshes", table);
    meshes.push_back(scene.meshes[number]);
  }
  scene.meshes = std::move(meshes);
  table.finish();
  return drop;
}

// What is dropped starts in balls of this radius, which keep it apart.
void check_sizes(const SceneDescription& scene, const TomlTable& file) {
  for (const NamedMesh& mesh : scene.meshes) {
    if (bounding_radius(mesh.mesh) > 1.001 * kShapeRadius) {
      std::ostringstream text;
      text << "what is dropped must fit into a ball of radius " << kShapeRadius << ", '"
           << mesh.name << "' has " << bounding_radius(mesh.mesh);
      file.fail("drop", text.str());
    }
  }
}

JointDescription read_joint(TomlTable& table, const SceneDescription& scene,
                            const BodyReader& bodies) {
  JointDescription joint;
  joint.kind = table.choice("kind", "hinge", {"hinge", "slider"}) == "hinge"
                   ? JointDescription::Kind::kHinge
                   : JointDescription::Kind::kSlider;
  joint.body = bodies.body_named("body", table);
  if (!table.text("other", "").empty()) joint.other = bodies.body_named("other", table);
  if (joint.other == joint.body) table.fail("other", "a body is not joined to itself");
  joint.anchor = table.point("anchor", scene.bodies[joint.body].position);
  joint.axis = table.point("axis", joint.axis);
  if (joint.axis == Point{0, 0, 0}) table.fail("axis", "'axis' must have a length");
  joint.axis = direction_of(joint.axis);
  if (auto motor = table.table("motor")) {
    joint.motor = Motor{motor->number("speed"), motor->number("force", 1e9, kNotNegative)};
    motor->finish();
  }
  table.finish();
  return joint;
}

// What cannot move stays where it is and above all, which would show nothing. Named bodies may be
// driven; where all that can move are meant, those are the free ones.
void check_can_move(const Expectation& e, const SceneDescription& scene, const TomlTable& table) {
  const auto can_move = [&](std::size_t body) {
    return scene.bodies[body].motion != Motion::kFixed;
  };
  if (!e.bodies.empty()) {
    if (!std::any_of(e.bodies.begin(), e.bodies.end(), can_move)) {
      table.fail("body", "'" + scene.bodies[e.bodies[0]].name +
                             "' is fixed: nothing can be expected of what cannot move");
    }
    if (e.kind == Expectation::Kind::kRatio && !can_move(e.other)) {
      table.fail("other", "'" + scene.bodies[e.other].name +
                              "' is fixed: nothing turns in a ratio to what cannot move");
    }
  } else if (!scene.bodies.empty() &&
             std::none_of(scene.bodies.begin(), scene.bodies.end(),
                          [](const BodyDescription& b) { return b.motion == Motion::kFree; })) {
    table.fail("kind", "no body of the scene is free: nothing can be expected of what cannot move");
  }
}

Expectation read_expectation(TomlTable& table, const SceneDescription& scene,
                             const BodyReader& bodies) {
  Expectation e;
  using Kind = Expectation::Kind;
  const std::string kind = table.choice(
      "kind", "still", {"ratio", "screw", "still", "stays", "moves", "above", "apart"});
  if (kind == "ratio" || kind == "screw") {
    e.bodies = {bodies.body_named("body", table)};
  } else if (kind != "apart" && !table.text("body", "").empty()) {
    e.bodies = bodies.bodies_named("body", table);
  }
  if (kind == "ratio") {
    e.kind = Kind::kRatio;
    e.other = bodies.body_named("other", table);
    e.value = table.number("ratio");
    e.within = table.number("within", 0.02, kNotNegative);
  } else if (kind == "screw") {
    e.kind = Kind::kScrew;
    e.value = table.number("pitch");
    if (e.value == 0) table.fail("pitch", "'pitch' must not be 0: a screw rises as it turns");
    e.within = table.number("within", 0.25, kNotNegative);
    e.turns = table.number("turns", 0, kNotNegative);
  } else if (kind == "still") {
    e.kind = Kind::kStill;
    e.value = table.number("speed");
  } else if (kind == "above") {
    e.kind = Kind::kAbove;
    e.value = table.number("height");
  } else if (kind == "apart") {
    e.kind = Kind::kApart;
    e.value = table.number("depth");
  } else {
    e.kind = kind == "stays" ? Kind::kStays : Kind::kMoves;
    e.value = table.number("distance");
  }
  e.after = table.number("after", 0, kNotNegative);
  if (kind == "stays") e.until = table.number("until", e.until, kNotNegative);
  if (e.until <= e.after) table.fail("until", "'until' must be later than 'after'");
  check_can_move(e, scene, table);
  table.finish();
  return e;
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const fs::path& folder : scene_folders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string find_scene_file(const std::string& name) {
  if (name.ends_with(kExtension) || name.find('/') != std::string::npos) return name;
  for (const fs::path& folder : scene_folders()) {
    const fs::path path = folder / (name + kExtension);
    std::error_code error;  // too long a name, for one: there is no such file
    if (fs::exists(path, error)) return path.string();
  }
  throw SceneFileError("there is no scene '" + name + "'; there are " + list(scene_names()) +
                       ", and any file that ends in " + kExtension);
}

SceneDescription read_scene_file(const std::string& path) {
  std::error_code error;  // reading says what is wrong
  if (fs::is_directory(path, error)) {
    throw SceneFileError("'" + path + "' is a folder; a scene is a file that ends in " +
                         kExtension);
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw SceneFileError("cannot read the scene '" + path + "'");
  return read_scene(text.str(), path);
}

SceneDescription read_scene(const std::string& text, const std::string& path) {
  toml::table parsed;
  try {
    parsed = toml::parse(text);
  } catch (const toml::parse_error& e) {
    throw SceneFileError(path + ':' + std::to_string(e.source().begin.line) + ": " +
                         std::string(e.description()));
  }
  SceneDescription scene;
  scene.files.push_back(path);
  TomlTable file(parsed, path, "a scene");
  BodyReader bodies(scene, fs::path(path).parent_path().string());
  scene.title = file.text("title", "");
  scene.steps = file.whole("steps", scene.steps, 1, 1000000000);
  scene.hz = file.number("hz", scene.hz, {1e-6, 1e6});
  if (auto table = file.table("world")) read_world(*table, scene.world);
  if (auto table = file.table("contact")) read_contact(*table, scene.contact);
  if (auto table = file.table("camera")) {
    scene.camera = CameraHint{table->point("eye"), table->point("target", {})};
    if (scene.camera->eye == scene.camera->target) {
      table->fail("eye", "'eye' and 'target' must be two places");
    }
    table->finish();
  }
  for (auto& [name, table] : file.named_tables("mesh")) bodies.read_mesh(name, table);
  for (TomlTable& table : file.tables("body")) bodies.read_body(table);
  if (auto table = file.table("drop")) {
    if (!scene.bodies.empty()) file.fail("drop", "a scene has [drop] or [[body]], not both");
    scene.drop = read_drop(*table, scene, bodies);
    check_sizes(scene, file);
  }
  for (TomlTable& table : file.tables("joint")) {
    scene.joints.push_back(read_joint(table, scene, bodies));
  }
  for (TomlTable& table : file.tables("expect")) {
    scene.expectations.push_back(read_expectation(table, scene, bodies));
  }
  file.finish();
  if (scene.bodies.empty() && !scene.drop) file.fail("a scene needs [[body]] or [drop]");
  return scene;
}

}  // namespace falling_objects
