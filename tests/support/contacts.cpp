// SPDX-License-Identifier: BSD-3-Clause
// Collecting and comparing contacts, of ode_world.h.
#include <cstring>
#include <sstream>

#include "support/ode_world.h"

namespace ode_ext::test {
namespace {

bool same_bits(const dContactGeom& a, const dContactGeom& b) {
  return std::memcmp(a.pos, b.pos, 3 * sizeof(dReal)) == 0 &&
         std::memcmp(a.normal, b.normal, 3 * sizeof(dReal)) == 0 &&
         std::memcmp(&a.depth, &b.depth, sizeof(dReal)) == 0 && a.side1 == b.side1 &&
         a.side2 == b.side2;
}

std::string describe(const dContactGeom& c) {
  std::ostringstream text;
  text.precision(17);
  text << "pos (" << c.pos[0] << ", " << c.pos[1] << ", " << c.pos[2] << ") normal (" << c.normal[0]
       << ", " << c.normal[1] << ", " << c.normal[2] << ") depth " << c.depth << " sides "
       << c.side1 << ", " << c.side2;
  return text.str();
}

std::string numbered(const char* what, std::size_t i, const std::string& text) {
  return text.empty() ? "" : what + (" " + std::to_string(i)) + ": " + text;
}

}  // namespace

Contacts collide(dGeomID o1, dGeomID o2, int limit) {
  Contacts contacts(static_cast<std::size_t>(limit));
  const int count = dCollide(o1, o2, limit, contacts.data(), sizeof(dContactGeom));
  contacts.resize(static_cast<std::size_t>(count));
  return contacts;
}

long long Collected::total() const {
  long long sum = 0;
  for (const auto& [pair, found] : contacts) sum += static_cast<long long>(found.size());
  return sum;
}

void collect(void* data, dGeomID o1, dGeomID o2) {
  auto& collected = *static_cast<Collected*>(data);
  collected.order.emplace_back(o1, o2);
  if (!dGeomIsSpace(o1) && !dGeomIsSpace(o2)) {
    collected.contacts[{o1, o2}] = collide(o1, o2);
  } else if (collected.recurse) {
    dSpaceCollide2(o1, o2, data, &collect);
  }
}

void collect_order_only(void* data, dGeomID o1, dGeomID o2) {
  static_cast<Collected*>(data)->order.emplace_back(o1, o2);
}

std::string difference(const Contacts& a, const Contacts& b) {
  if (a.size() != b.size()) {
    return std::to_string(a.size()) + " contacts against " + std::to_string(b.size());
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same_bits(a[i], b[i])) {
      return numbered("contact", i, describe(a[i]) + "\n  against " + describe(b[i]));
    }
  }
  return "";
}

std::string difference(const std::vector<Contacts>& a, const std::vector<Contacts>& b) {
  if (a.size() != b.size()) return "different numbers of pairs";
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (const auto text = difference(a[i], b[i]); !text.empty()) return numbered("pair", i, text);
  }
  return "";
}

std::string difference_with_geoms(const Contacts& a, const Contacts& b) {
  if (const auto text = difference(a, b); !text.empty()) return text;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].g1 != b[i].g1 || a[i].g2 != b[i].g2) return numbered("contact", i, "other geoms");
  }
  return "";
}

std::string difference_with_geoms(const Collected& a, const Collected& b) {
  if (a.order != b.order) {
    return "other pairs or another order: " + std::to_string(a.order.size()) +
           " callbacks against " + std::to_string(b.order.size());
  }
  for (std::size_t i = 0; i < a.order.size(); ++i) {
    const auto in_a = a.contacts.find(a.order[i]), in_b = b.contacts.find(a.order[i]);
    if ((in_a == a.contacts.end()) != (in_b == b.contacts.end())) return "other pairs collided";
    if (in_a == a.contacts.end()) continue;
    const auto text = difference_with_geoms(in_a->second, in_b->second);
    if (!text.empty()) return numbered("pair", i, text);
  }
  return "";
}

Contacts flipped(Contacts contacts) {
  for (dContactGeom& c : contacts) {
    for (int k = 0; k < 3; ++k) c.normal[k] = -c.normal[k];
    std::swap(c.g1, c.g2);
    std::swap(c.side1, c.side2);
  }
  return contacts;
}

std::vector<Contacts> answers_of(const Collected& collected) {
  std::vector<Contacts> answers;
  for (const GeomPair& pair : collected.order) {
    const auto found = collected.contacts.find(pair);
    if (found != collected.contacts.end()) answers.push_back(found->second);
  }
  return answers;
}

}  // namespace ode_ext::test
