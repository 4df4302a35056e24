// SPDX-License-Identifier: BSD-3-Clause
// What a work-group goes through together, as one program for group_emulation.cpp.
#include "contacts/choose.cl"
#include "contacts/reduce.cl"
#include "cull.cl"
#include "flood.cl"
#include "self_test_group.cl"
