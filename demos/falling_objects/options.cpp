// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/options.h"

#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "falling_objects/option_checks.h"
#include "falling_objects/output_file.h"
#include "scene_file/scene_file.h"
#include "scene_file/scene_list.h"
#include "scene_file/user_meshes.h"

namespace falling_objects {
namespace {

constexpr const char* kDescription =
    "Meshes fall, stand, roll and turn each other, in a window, in a film, or unseen: then it\n"
    "prints what each stage of the collision pass took, how deep meshes got into each other, and "
    "a\n"
    "hash of every contact.";

constexpr const char* kFooter = R"(
Scenes:
  A name, or a TOML file of your own: docs/scenes.md says what is in one, --list what there is.

Checks:
  --check fails on: what the scene expects ([[expect]] in its file) and does not come to pass; a
  state that is not finite; an object below the ground by more than its radius or out of the bowl; a
  contact deeper than the smaller object's bounding diameter; two objects inside each other by more
  than half the thinnest part of either for more than 0.5 s, as measured on the meshes every 0.1 s,
  independently of the collider; a device that failed. With sheets, at the end: a vertex of a sheet
  more than 1 cm inside an object or under the ground; more than 0.1 % of the sheets' triangles
  crossing the surface of an object or the ground.
  --check-rest fails if, over the last 0.5 s, the mean speed is above g/(2 hz) or more than 5 % of
  the speeds are above g/hz (0.08 and 0.16 m/s at 60 Hz). g/hz is what one step of free fall adds:
  what is slower is held by its contacts. With sheets, also if in any step of the last 0.5 s any
  vertex of a sheet moves by more than 0.05 m/s allows.

Examples:
  falling_objects                                   1,000 objects, 10 s, the default device
  falling_objects --device :cpu: --check            on a processor; code 1 if something is wrong
  falling_objects --objects 100 --compare           against ODE's own collider, at the same poses
  falling_objects --collider ode --csv ode.csv      ODE's own collider alone, a row per step
  falling_objects --scene rigid-deformable --check --check-rest --snapshot end.obj
  falling_objects --mesh chair.obj --mesh table.ply meshes of your own, scaled to 1 m
  falling_objects --video out.mp4 --beside ode      ODE's own collider to the left, no screen needed
  falling_objects --frames out/%04d.png --overlay caption,contacts --camera=-60,30,12
  falling_objects --scene nut-on-bolt --check       what ought to hold, and does it?
  falling_objects --scene my.toml --mesh part.glb   a scene and a mesh of your own

Ctrl-C ends a run after the step that it is in, and what there is of it is written.

Exit codes: 0 done, 1 a check failed or an output could not be written, 2 wrong usage or unreadable
file, 3 no device, 128 and its number: ended by a signal.)";

// There or not.
bool are_one_file(const std::string& a, const std::string& b) {
  std::error_code none;
  if (std::filesystem::equivalent(a, b, none)) return true;
  const auto whole = [&](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, none), none);
  };
  return whole(a) == whole(b);
}

// Throws where one output would be written over another, or over what is read.
void check_files(const Options& o) {
  struct File {
    std::string option, path;
    bool is_read;
  };
  std::vector<File> files;
  for (const std::string& file : o.description.files) files.push_back({"--scene", file, true});
  for (const std::string& mesh : o.meshes)
    files.push_back({"--mesh", mesh_option(mesh).path, true});
  for (const auto& [option, path] :
       std::vector<std::pair<const char*, std::string>>{{"--csv", o.csv},
                                                        {"--snapshot", o.snapshot},
                                                        {"--record", o.record},
                                                        {"--frames", o.pictures.frames},
                                                        {"--video", o.pictures.video}}) {
    if (path.empty()) continue;
    for (const File& file : files) {
      if (are_one_file(file.path, path)) {
        throw CLI::ValidationError(
            option, "names the file that " + file.option + (file.is_read ? " reads" : " writes"));
      }
    }
    files.push_back({option, path, false});
  }
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv, std::ostream& out,
                            std::ostream& err) {
  ParsedOptions parsed;
  Options& o = parsed.options;
  CLI::App app(kDescription, "falling_objects");
  app.footer(kFooter);
  app.get_formatter()->column_width(36);

  app.add_option("--scene", o.scene, "The name of a scene, or a TOML file (default: rigid)")
      ->option_text("NAME|FILE.toml")
      ->group("Scene");
  bool list_all = false;
  app.add_flag("--list", list_all, "List the scenes, and the shapes that files can name")
      ->group("Scene");
  const CLI::Option* objects =
      app.add_option("--objects", o.objects,
                     "How many objects, in a scene that drops some (default: what its file says)")
          ->check(CLI::Range(1, 1000000))
          ->group("Scene");
  const CLI::Option* sheets =
      app.add_option("--sheets", o.sheets, "How many sheets, in a scene that has some")
          ->check(CLI::Range(1, 1000))
          ->group("Scene");
  const CLI::Option* steps =
      app.add_option("--steps", o.steps, "How many steps (default: what the scene says)")
          ->check(CLI::Range(1, std::numeric_limits<int>::max()))
          ->group("Scene");
  const CLI::Option* hz =
      app.add_option("--hz", o.hz, "Steps per simulated second (default: what the scene says)")
          ->check(within(1e-6, 1e6))
          ->group("Scene");
  app.add_option("--seed", o.seed, "Of the placement and the ground")
      ->check(is_seed())
      ->capture_default_str()
      ->group("Scene");
  app.add_option("--mesh", o.meshes,
                 "Drop this mesh (OBJ, STL, PLY, glTF) instead of the scene's, or NAME=FILE for a "
                 "mesh of a scene that drops none; repeatable")
      ->allow_extra_args(false)
      ->group("Scene");

  app.add_option_function<std::string>(
         "--collider",
         [&o](const std::string& name) {
           o.collider = name == "ode" ? Collider::kOde : Collider::kBatch;
         },
         "Whose contacts drive the simulation (default: batch)")
      ->check(CLI::IsMember({"batch", "ode"}))
      ->option_text("batch|ode")
      ->group("Collision");
  app.add_flag("--compare", o.compare,
               "Collide every step with both colliders and compare their times")
      ->group("Collision");
  const CLI::Option* max_contacts =
      app.add_option("--max-contacts", o.max_contacts,
                     "Contacts per pair at most (default: what the scene says, or 16)")
          ->check(CLI::Range(1, 64))
          ->group("Collision");
  app.add_option("--device", o.device, "OpenCL device, as in ODE_EXT_DEVICE")->group("Collision");
  app.add_option("--config", o.config,
                 "Settings of the batch collider, such as rays=iterative,workload=exact; "
                 "ode_ext-info --settings lists them")
      ->check([](const std::string& config) {
        return dBatchConfigCheck(config.c_str()) == 0 ? "" : dBatchColliderGetLastErrorMessage();
      })
      ->group("Collision");
  app.add_flag("--trust-meshes", o.trust_meshes, "Do not look for changed meshes in every pass")
      ->group("Collision");

  app.add_option("--csv", o.csv, "Write a row per step to this file")
      ->check(why_not_written)
      ->group("Output");
  app.add_flag("--check", o.check, "Exit with 1 if the simulation went wrong (see below)")
      ->group("Output");
  app.add_flag("--check-rest", o.check_rest, "Also if the objects are not at rest at the end")
      ->group("Output");
  app.add_option("--snapshot", o.snapshot, "Write all meshes at the end to this OBJ file")
      ->check(why_not_written)
      ->group("Output");
  app.add_option("--record", o.record,
                 "Write the run to this .glb file (glTF), about 30 poses a second, for Blender and "
                 "other viewers; without sheets")
      ->check(ends_in({".glb"}))
      ->check(why_not_written)
      ->group("Output");
  app.add_flag("--quiet", o.quiet, "No progress")->group("Output");
  add_picture_options(app, o.pictures);
  try {
    app.parse(argc, argv);
    if (list_all) {
      print_scenes(out);
      parsed.exit_code = kExitOk;
      return parsed;
    }
    o.description = read_scene_file(find_scene_file(o.scene));
    SceneDescription& scene = o.description;
    if (!scene.drop && !objects->empty()) {
      throw CLI::ValidationError("--objects", "scene " + o.scene + " drops none");
    }
    if (!sheets->empty() && (!scene.drop || scene.drop->sheets == 0)) {
      throw CLI::ValidationError("--sheets", "scene " + o.scene + " has none");
    }
    if (scene.drop) {
      if (objects->empty()) o.objects = scene.drop->objects;
      if (sheets->empty()) o.sheets = scene.drop->sheets;
      if (o.objects != scene.drop->objects) scene.camera.reset();  // it sees as many as in the file
      scene.drop = Drop{o.objects, o.sheets};
    } else {
      o.objects = static_cast<int>(scene.bodies.size());
    }
    if (steps->empty()) o.steps = scene.steps;
    if (hz->empty()) o.hz = scene.hz;
    if (max_contacts->empty()) o.max_contacts = scene.contact.per_pair;
    if (o.pictures.window && o.wants_more_than_a_window()) {
      throw CLI::ValidationError(
          "--window",
          "a window neither measures nor writes: leave out --check, --check-rest, "
          "--compare, --csv, --snapshot, --record, --frames and --video, or --window");
    }
    check_files(o);
    // ODE's own collider knows no open meshes with two sides.
    if (o.has_sheets() && (o.compare || o.collider == Collider::kOde)) {
      throw CLI::ValidationError("--scene", "sheets need the batch collider alone");
    }
  } catch (const CLI::ParseError& e) {
    parsed.exit_code = app.exit(e, out, err) == 0 ? kExitOk : kExitUsage;
  } catch (const SceneFileError& e) {
    err << e.what() << '\n';
    parsed.exit_code = kExitUsage;
  } catch (const std::bad_alloc&) {
    err << "not enough memory for the scene '" << o.scene << "'\n";
    parsed.exit_code = kExitUsage;
  }
  return parsed;
}

}  // namespace falling_objects
