// SPDX-License-Identifier: BSD-3-Clause
#include "ode/program_callbacks.h"

#include <cxxabi.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>

#include "mesh/feature_number.h"
#include "ode/messages.h"

namespace ode_ext {
namespace {

// Between here and the program is ODE, through which nothing may be thrown, but where the program
// ends the thread: that cannot be stopped.
template <class Call>
int guarded(const char* name, int otherwise, Call call) {
  try {
    return call();
  } catch (const abi::__forced_unwind&) {
    throw;
  } catch (const std::exception& error) {
    set_last_error(std::string("the program's ") + name + " threw: " + error.what());
  } catch (...) {
    set_last_error(std::string("the program's ") + name + " threw");
  }
  return otherwise;
}

// What the callbacks of one geom make of the triangles that a contact stands for: all at a vertex,
// those at an edge, the one in a facet.
class Judge {
 public:
  Judge(dGeomID geom, dGeomID other, bool triangle_callbacks)
      : geom_(geom),
        other_(other),
        accept_(triangle_callbacks ? dGeomTriMeshGetCallback(geom) : nullptr),
        merge_(dGeomTriMeshGetTriMergeCallback(geom)) {}

  // False: the contact is refused, for each of its triangles is. Else `triangle` is what it gets.
  bool judge(const AnswerCopy& answer, const Contact& contact, std::size_t side,
             std::uint32_t& triangle) const {
    triangle = contact.triangles[side];
    if (accept_ == nullptr && merge_ == nullptr) return true;
    std::vector<std::uint32_t> triangles =
        triangles_at(*answer.members[side].mesh->topology, contact.features[side]);
    if (triangles.empty()) triangles = {triangle};
    if (accept_ != nullptr)
      std::erase_if(triangles, [&](std::uint32_t t) { return !accepts(static_cast<int>(t)); });
    if (triangles.empty()) return false;
    if (merge_ != nullptr)
      triangle = static_cast<std::uint32_t>(merged(triangles));
    else if (std::find(triangles.begin(), triangles.end(), triangle) == triangles.end())
      triangle = triangles.front();
    return true;
  }

 private:
  bool accepts(int triangle) const {
    return guarded("dTriCallback", 1, [&] { return accept_(geom_, other_, triangle); }) != 0;
  }

  int merged(const std::vector<std::uint32_t>& triangles) const {
    int result = static_cast<int>(triangles.front());
    for (std::size_t i = 1; i < triangles.size(); ++i)
      result = guarded("dTriTriMergeCallback", result,
                       [&] { return merge_(geom_, result, static_cast<int>(triangles[i])); });
    return result;
  }

  dGeomID geom_;
  dGeomID other_;
  dTriCallback* accept_;
  dTriTriMergeCallback* merge_;
};

}  // namespace

bool has_callbacks(dGeomID g1, dGeomID g2, bool triangle_callbacks) {
  for (const dGeomID geom : {g1, g2}) {
    if (dGeomTriMeshGetTriMergeCallback(geom) != nullptr) return true;
    if (triangle_callbacks && dGeomTriMeshGetCallback(geom) != nullptr) return true;
  }
  return false;
}

std::vector<Contact> ask_program(const AnswerCopy& answer, int limit, bool triangle_callbacks) {
  const dGeomID first = answer.members[0].geom, second = answer.members[1].geom;
  const std::array judges{Judge(first, second, triangle_callbacks),
                          Judge(second, first, triangle_callbacks)};
  const auto most = static_cast<std::size_t>(limit);
  std::vector<Contact> result;
  for (Contact contact : answer.contacts) {
    // Who may refuse is asked of all: the deepest of what remains is to come first at any limit.
    if (!triangle_callbacks && result.size() == most) break;
    std::array<std::uint32_t, 2> triangles;
    if (!judges[0].judge(answer, contact, 0, triangles[0]) ||
        !judges[1].judge(answer, contact, 1, triangles[1]))
      continue;
    contact.triangles = triangles;
    result.push_back(contact);
  }
  if (result.size() < answer.contacts.size() && !result.empty() && triangle_callbacks) {
    const auto deepest =
        std::max_element(result.begin(), result.end(),
                         [](const Contact& a, const Contact& b) { return a.depth < b.depth; });
    std::rotate(result.begin(), deepest, deepest + 1);
  }
  if (result.size() > most) result.resize(most);
  return result;
}

}  // namespace ode_ext
