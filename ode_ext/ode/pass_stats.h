// SPDX-License-Identifier: BSD-3-Clause
// What the pipeline reports of a step, as the public statistics have it.
#pragma once

#include "ode_ext/ode_ext.h"
#include "pipeline/step_report.h"

namespace ode_ext {

void note_report(const StepReport& report, dBatchColliderStats& stats);

}  // namespace ode_ext
