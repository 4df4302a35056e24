// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/options.h"

#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <map>

namespace falling_objects {
namespace {

constexpr const char* kDescription =
    "Non-convex meshes fall into a bowl, without a window. Prints what each stage of the "
    "collision\n"
    "pass took, how deep meshes got into each other, and a hash of every contact.";

constexpr const char* kFooter = R"(
Checks:
  --check fails on: a state that is not finite; an object below the ground by more than its radius
  or out of the bowl; a contact deeper than the smaller object's bounding diameter; two objects
  inside each other by more than half the thinnest part of either for more than 0.5 s, as measured
  on the meshes every 0.1 s, independently of the collider; a device that failed.
  --check-rest fails if, over the last 0.5 s, the mean speed is above g/(2 hz) or more than 5 % of
  the speeds are above g/hz (0.08 and 0.16 m/s at 60 Hz). g/hz is what one step of free fall adds:
  what is slower is held by its contacts.

Examples:
  falling_objects                                   1,000 objects, 10 s, the default device
  falling_objects --device pocl --check             on PoCL; exit code 1 if something is wrong
  falling_objects --objects 100 --compare           against ODE's own collider, at the same poses
  falling_objects --collider ode --csv ode.csv      ODE's own collider alone, a row per step
  falling_objects --mesh chair.obj --mesh table.ply meshes of your own, scaled to 1 m

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
  app.add_option("--scene", o.scene, "rigid: 1,000 objects of four shapes (GRAPP section 6)")
      ->check(CLI::IsMember({"rigid"}))
      ->group("Scene");
  app.add_option("--objects", o.objects, "How many objects")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
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
  const std::map<std::string, int> workloads{{"predicted", dBatchWorkloadPredicted},
                                             {"exact", dBatchWorkloadExact}};
  const std::map<std::string, int> predictions{{"pair-scaled", dBatchPredictionPairScaled},
                                               {"plain", dBatchPredictionPlain}};
  // The transformers turn names into values; the type names are spelled out for the help.
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
  app.add_option("--workload", o.workload, "How kernels are launched (default: predicted)")
      ->transform(CLI::CheckedTransformer(workloads))
      ->option_text("predicted|exact")
      ->group("Collision");
  app.add_option("--prediction", o.prediction, "GRAPP's Eq. 1 or Eq. 2 (default: pair-scaled)")
      ->transform(CLI::CheckedTransformer(predictions))
      ->option_text("pair-scaled|plain")
      ->group("Collision");
  app.add_option("--confidence", o.confidence, "Factor on predictions (default: the library's)")
      ->check(positive)
      ->group("Collision");
  app.add_flag("--trust-meshes", o.trust_meshes, "Do not look for changed meshes in every pass")
      ->group("Collision");

  app.add_option("--csv", o.csv, "Write a row per step to this file")->group("Output");
  app.add_flag("--check", o.check, "Exit with 1 if the simulation went wrong (see below)")
      ->group("Output");
  app.add_flag("--check-rest", o.check_rest, "Also if the objects are not at rest at the end")
      ->group("Output");
  app.add_flag("--quiet", o.quiet, "No progress")->group("Output");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    parsed.exit_code = app.exit(e, out, err) == 0 ? kExitOk : kExitUsage;
  }
  return parsed;
}

}  // namespace falling_objects
