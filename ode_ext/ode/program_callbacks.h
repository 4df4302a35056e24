// SPDX-License-Identifier: BSD-3-Clause
// What a program's own callbacks have to say of the triangles of contacts: dTriTriMergeCallback,
// and dTriCallback where it is wanted.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "ode/answers.h"

namespace ode_ext {

// Whether there is anybody to ask.
bool has_callbacks(dGeomID g1, dGeomID g2, bool triangle_callbacks);

// The first `limit` contacts of those that no dTriCallback refuses (if `triangle_callbacks`), the
// deepest first, with the triangles that merge callbacks made of those a contact stands for. Runs
// the program's code: hold no lock, and an answer of one's own. What that code throws is noted as
// the last error and taken for having no opinion.
std::vector<Contact> ask_program(const AnswerCopy& answer, int limit, bool triangle_callbacks);

}  // namespace ode_ext
