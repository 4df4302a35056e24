// SPDX-License-Identifier: BSD-3-Clause
// BatchCollider, where the device fails: what is said, and what becomes of the device.
#include <string>

#include "ode/batch_collider.h"
#include "ode/messages.h"

namespace ode_ext {

void BatchCollider::make_anew_what_keeps_failing() {
  if (!health_.is_to_be_made_anew()) return;
  log(LogLevel::kInfo, "the device failed " + std::to_string(health_.failures()) +
                           " times in a row: it is taken up from the start");
  memories_.clear();  // of that device
  known_.make_collider_anew();
}

void BatchCollider::fail(const std::exception& error, bool alone) {
  known_.drop_batch();
  health_.note_failure();
  note_failed_status(error.what(), alone);
  if (!failure_said_)
    log(LogLevel::kError, std::string(error.what()) + " Meanwhile ODE's own collider answers.");
  failure_said_ = true;
}

void BatchCollider::note_given_up(bool alone) {
  const std::string why = known_.why_given_up() + " This is of one pair; others are collided.";
  note_failed_status(why, alone);
  if (!given_up_said_) log(LogLevel::kError, why + " Meanwhile ODE's own collider answers for it.");
  given_up_said_ = true;
}

void BatchCollider::note_failed_status(const std::string& why, bool alone) {
  if ((stats_.status & dBatchStatusDeviceFailed) == 0) failed_alone_ = alone;
  stats_.status |= dBatchStatusDeviceFailed;
  set_last_error(why);
}

void BatchCollider::note_success() {
  if (!known_.why_given_up().empty()) note_given_up();
  if (stats_.pairs_computed == 0) return;
  health_.note_success();
  failure_said_ = false;
  if (is_within_a_pass() && known_.why_given_up().empty()) given_up_said_ = false;
}

}  // namespace ode_ext
