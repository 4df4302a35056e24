// SPDX-License-Identifier: BSD-3-Clause
// Collider, before its first batch.
#include <memory>
#include <stdexcept>
#include <string>

#include "collide/collider.h"
#include "opencl/choice.h"
#include "opencl/driver_thread.h"

namespace ode_ext {
namespace {

BatchSettings settings_of(const ColliderOptions& options) {
  BatchSettings settings;
  if (options.rays == Rays::kIterativePaper) settings.modes |= OX_MODE_PAPER;
  if (options.deformable_target == DeformableTarget::kBasic) settings.modes |= OX_MODE_BASIC;
  if (options.edges) settings.modes |= OX_MODE_EDGES;
  if (!follows_paper(options)) settings.modes |= OX_MODE_FLOOD;
  settings.displacement_limit = options.displacement_limit;
  settings.walk_limit = options.walk_limit;
  settings.max_contacts = options.max_contacts;
  settings.max_contacts_deformable = options.max_contacts_deformable;
  return settings;
}

bool lanes_are_items(const ColliderOptions& options, const DeviceInfo& device) {
  if (lanes_are_groups(options, device)) return true;
  if (options.lanes == Lanes::kOfDevice) return (device.type & CL_DEVICE_TYPE_CPU) == 0;
  return options.lanes == Lanes::kItems;
}

// How many work-items look at two meshlets: those of a block of lanes of either side.
std::uint32_t items_per_meshlet_pair(const ColliderOptions& options, const DeviceInfo& device) {
  if (!lanes_are_items(options, device)) return 1;
  const unsigned width =
      options.vector_width != 0 ? options.vector_width : suitable_vector_width(device);
  return 2 * OX_LANES / width;
}

std::string program_options(const ColliderOptions& options, const DeviceInfo& device) {
  std::string text = options.count_work ? "-DOX_COUNT_WORK" : "";
  if (!options.builtins) text += " -DOX_NO_BUILTINS";
  if (lanes_are_items(options, device)) text += " -DOX_LANES_ARE_ITEMS";
  if (lanes_are_groups(options, device)) text += std::string(" ") + kGroupsApart;
  if (follows_paper(options)) text += std::string(" ") + paper::kProgramOption;
  if (may_run_whole(options, device)) text += " -DOX_WHOLE_STEP";
  // Last, where Program puts that of the device: drivers keep kernels by this text.
  if (options.vector_width != 0)
    text += " -DOX_VECTOR_WIDTH=" + std::to_string(options.vector_width);
  return text;
}

// Where lanes are groups; nullptr: they are not, or the driver does not build these kernels, or not
// as they have to be. Then they are items, which asks less of it.
std::unique_ptr<Program> program_of_groups(ColliderOptions& options, Device& device) {
  if (!lanes_are_groups(options, device.info())) return nullptr;
  try {
    auto program = std::make_unique<Program>(
        device, std::string(kLanesAreGroup) + " -DOX_VECTOR_WIDTH=" + std::to_string(OX_LANES));
    self_test_groups(*program, OX_LANES);
    return program;
  } catch (const DeviceError&) {
    options.lanes = Lanes::kItems;
    return nullptr;
  }
}

}  // namespace

Collider::Collider(const ColliderOptions& options)
    : options_(options),
      device_(options.device, options.largest_buffer, options.share_memory),
      group_program_(program_of_groups(options_, device_)),
      program_(device_, program_options(options_, device_.info())),
      search_(program_, of_groups(), items_per_meshlet_pair(options_, device_.info())),
      assembly_(program_, of_groups()),
      data_(program_),
      read_back_(device_) {
  data_.settings = settings_of(options);
  if (follows_paper(options_)) paper_.emplace(program_, options_);
  if (may_run_whole(options_, device_.info())) {
    whole_step_.emplace(program_, "whole_step");
    data_.lists.keep_shares(device_.info().compute_units);
  }
  if (options_.vector_width != 0 && options_.vector_width != 1 && options_.vector_width != 4 &&
      options_.vector_width != 8 && options_.vector_width != 16)
    throw std::invalid_argument("vector_width is " + std::to_string(options_.vector_width) +
                                ", not 0, 1, 4, 8 or 16");
  if (options_.work_group_size > device_.info().work_group_limit)
    throw std::invalid_argument("work_group_size is " + std::to_string(options_.work_group_size) +
                                ", more than the " +
                                std::to_string(device_.info().work_group_limit) + " that '" +
                                device_.info().name + "' can run");
  self_test(program_);
  warm_up();
}

ColliderOptions Collider::options_here() const {
  ColliderOptions options = options_;
  options.device = selection_of(device_.info(), list_devices());
  return options;
}

// Launches every kernel on empty input, so that one that cannot run in groups of this size is known
// now. PoCL compiles a kernel at its first launch, and again at the first one of 65,536 items or
// more, wherever that falls in a simulation; launching that many settles both.
void Collider::warm_up() {
  const Scene scene;
  Batch batch{scene, nullptr, report_,
              Workload(options_, device_, data_.lists, scene, nullptr, report_)};
  batch.workload.begin_attempt();
  data_.meshes.set({});
  data_.pairs.upload_objects(scene);
  data_.pairs.upload_pairs(scene, {0, 0});
  const std::size_t local = options_.work_group_size;
  const bool is_pocl =
      device_.info().platform_name.find("Portable Computing Language") != std::string::npos;
  const Launch wide{is_pocl ? (std::size_t{1} << 16) / local + 1 : 1, local};
  const Launch of_queue = group_program_ ? Launch{1, OX_LANES} : wide;
  data_.launch(search_.cull, of_queue);
  for (Kernel* kernel : {&search_.pair_step, &search_.match, &search_.cross})
    data_.launch(*kernel, wide);
  if (paper_) {
    paper_->warm_up(wide, data_, batch);
  } else {
    data_.launch(search_.flood, of_queue);
    for (Kernel* kernel : {&search_.vertex_step, &search_.ray_step}) data_.launch(*kernel, wide);
  }
  assembly_.run(wide, wide, of_queue, data_);
  if (whole_step_) data_.launch(*whole_step_, {1, 1});
  data_.meshes.warm_up(wide);
  device_.finish();
  take_milliseconds();
}

std::unique_ptr<Collider> make_collider(const ColliderOptions& options) {
  return from_driver_thread([&] { return std::make_unique<Collider>(options); });
}

}  // namespace ode_ext
