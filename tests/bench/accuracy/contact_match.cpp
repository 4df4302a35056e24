// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/contact_match.h"

#include <algorithm>
#include <cmath>

namespace ode_ext::accuracy {
namespace {

bool same(const dContactGeom& a, const dContactGeom& b, double tolerance) {
  return test::distance(test::pos(a), test::pos(b)) <= tolerance &&
         std::fabs(a.depth - b.depth) <= tolerance &&
         test::distance(test::normal(a), test::normal(b)) <= kNormalRounding;
}

}  // namespace

bool same_contacts(const test::Contacts& a, const test::Contacts& b, double tolerance) {
  if (a.size() != b.size()) return false;
  test::Contacts left = b;
  for (const dContactGeom& contact : a) {
    const auto match = std::find_if(left.begin(), left.end(), [&](const dContactGeom& other) {
      return same(contact, other, tolerance);
    });
    if (match == left.end()) return false;
    left.erase(match);
  }
  return true;
}

}  // namespace ode_ext::accuracy
