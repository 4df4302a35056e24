// SPDX-License-Identifier: BSD-3-Clause
// The two CSV files of a run.
#pragma once

#include <optional>
#include <ostream>

#include "paper/contestant.h"
#include "paper/missed.h"

namespace paper {

// A row per step and configuration. `place`: in the order of the step. `missed`: only of
// configurations that may miss something.
void write_steps_header(std::ostream& out);
void write_step(std::ostream& out, int step, std::size_t place, const Contestant& contestant,
                const std::optional<Missed>& missed);

// A row per counted step, configuration and kernel that had work.
void write_work_header(std::ostream& out);
void write_work(std::ostream& out, int step, const Contestant& contestant);

}  // namespace paper
