// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/options.h"

#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <map>

namespace falling_objects {
namespace {

constexpr const char* kDeformableScene = "rigid-deformable";

constexpr const char* kDescription =
    "Non-convex meshes fall into a bowl, in a window, in a film, or unseen: then it prints what "
    "each\n"
    "stage of the collision pass took, how deep meshes got into each other, and a hash of every\n"
    "contact.";

constexpr const char* kFooter = R"(
Checks:
  --check fails on: a state that is not finite; an object below the ground by more than its radius
  or out of the bowl; a contact deeper than the smaller object's bounding diameter; two objects
  inside each other by more than half the thinnest part of either for more than 0.5 s, as measured
  on the meshes every 0.1 s, independently of the collider; a device that failed. With sheets, at
  the end: a vertex of a sheet more than 1 cm inside an object or under the ground; more than 0.1 %
  of the sheets' triangles crossing the surface of an object or the ground.
  --check-rest fails if, over the last 0.5 s, the mean speed is above g/(2 hz) or more than 5 % of
  the speeds are above g/hz (0.08 and 0.16 m/s at 60 Hz). g/hz is what one step of free fall adds:
  what is slower is held by its contacts. With sheets, also if in any step of the last 0.5 s any
  vertex of a sheet moves by more than 0.05 m/s allows.

Examples:
  falling_objects                                   1,000 objects, 10 s, the default device
  falling_objects --device pocl --check             on PoCL; exit code 1 if something is wrong
  falling_objects --objects 100 --compare           against ODE's own collider, at the same poses
  falling_objects --collider ode --csv ode.csv      ODE's own collider alone, a row per step
  falling_objects --scene rigid-deformable --check --check-rest --snapshot end.obj
  falling_objects --mesh chair.obj --mesh table.ply meshes of your own, scaled to 1 m
  falling_objects --video out.mp4 --beside ode      ODE's own collider to the left, no screen needed
  falling_objects --frames out/%04d.png --overlay caption,contacts --camera=-60,30,12

Exit codes: 0 done, 1 a check failed, 2 wrong usage or unreadable file, 3 no device.)";

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv, std::ostream& out,
                            std::ostream& err) {
  ParsedOptions parsed;
  Options& o = parsed.options;
  CLI::App app(kDescription, "falling_objects");
  app.footer(kFooter);
  app.get_formatter()->column_width(36);

  const auto positive = CLI::Range(1e-6, 1e6);
  app.add_option("--scene", o.scene,
                 "Of GRAPP section 6. rigid (default): 1,000 objects of four shapes; "
                 "rigid-deformable: 216 of them, and 36 sheets of cloth that fall on them")
      ->check(CLI::IsMember({"rigid", kDeformableScene}))
      ->option_text("rigid|rigid-deformable")
      ->group("Scene");
  const CLI::Option* objects =
      app.add_option("--objects", o.objects, "How many objects (default: 1000, under sheets 216)")
          ->check(CLI::Range(1, 1000000))
          ->group("Scene");
  const CLI::Option* sheets =
      app.add_option("--sheets", o.sheets, "How many sheets (default: 36 in rigid-deformable)")
          ->check(CLI::Range(1, 1000))
          ->group("Scene");
  app.add_option("--steps", o.steps, "How many steps")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str()
      ->group("Scene");
  app.add_option("--hz", o.hz, "Steps per simulated second")
      ->check(positive)
      ->capture_default_str()
      ->group("Scene");
  app.add_option("--seed", o.seed, "Of the placement and the ground")
      ->capture_default_str()
      ->group("Scene");
  app.add_option("--mesh", o.meshes,
                 "Drop this mesh instead of the four shapes (OBJ, STL, PLY, glTF); repeatable")
      ->allow_extra_args(false)
      ->group("Scene");

  const std::map<std::string, Collider> colliders{{"batch", Collider::kBatch},
                                                  {"ode", Collider::kOde}};
  app.add_option("--collider", o.collider, "Whose contacts drive the simulation (default: batch)")
      ->transform(CLI::CheckedTransformer(colliders))
      ->option_text("batch|ode")
      ->group("Collision");
  app.add_flag("--compare", o.compare,
               "Collide every step with both colliders and compare their times")
      ->group("Collision");
  app.add_option("--max-contacts", o.max_contacts, "Contacts per pair at most")
      ->check(CLI::Range(1, 64))
      ->capture_default_str()
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

  app.add_option("--csv", o.csv, "Write a row per step to this file")->group("Output");
  app.add_flag("--check", o.check, "Exit with 1 if the simulation went wrong (see below)")
      ->group("Output");
  app.add_flag("--check-rest", o.check_rest, "Also if the objects are not at rest at the end")
      ->group("Output");
  app.add_option("--snapshot", o.snapshot, "Write all meshes at the end to this OBJ file")
      ->group("Output");
  app.add_flag("--quiet", o.quiet, "No progress")->group("Output");
  add_picture_options(app, o.pictures);
  try {
    app.parse(argc, argv);
    const bool deformable = o.scene == kDeformableScene;
    if (deformable && objects->empty()) o.objects = 216;
    if (deformable && sheets->empty()) o.sheets = 36;
    if (!deformable && o.sheets > 0) {
      throw CLI::ValidationError("--sheets", "only with --scene rigid-deformable");
    }
    // ODE's own collider knows no open meshes with two sides.
    if (deformable && (o.compare || o.collider == Collider::kOde)) {
      throw CLI::ValidationError("--scene", "rigid-deformable needs the batch collider alone");
    }
  } catch (const CLI::ParseError& e) {
    parsed.exit_code = app.exit(e, out, err) == 0 ? kExitOk : kExitUsage;
  }
  return parsed;
}

}  // namespace falling_objects
