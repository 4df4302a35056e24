// SPDX-License-Identifier: BSD-3-Clause
// What is collided and what is found, written where ODE_EXT_CAPTURE says, for ode_ext-replay: a
// user's report becomes a test case. Without the variable each call is one test of a flag.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "contacts/contact.h"
#include "ode/members.h"
#include "ode_ext/ode_ext.h"

namespace ode_ext {

// Opens the file that ODE_EXT_CAPTURE names, once per process; nothing if it is not set. Throws
// std::runtime_error with a sentence if it cannot be written.
void open_capture_of_environment();

// Introduces a collider, by an address of its own.
void capture_collider(const void* collider, const dBatchColliderParams& params,
                      const std::string& device);

// Meshes, poses and pairs of what the device is given next. Returns what to pass to
// capture_contacts; nothing where nothing is captured.
std::optional<std::uint32_t> capture_pass(const void* collider,
                                          std::span<const PairMember* const> members,
                                          std::span<const std::array<std::uint32_t, 2>> pairs);

// What was found of that pass.
void capture_contacts(std::optional<std::uint32_t> pass, const PairContacts& found);

}  // namespace ode_ext
