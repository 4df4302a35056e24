// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/judge.h"

#include <algorithm>
#include <ctime>
#include <sstream>

#include "fuzz/getters.h"
#include "ode/stock_collider.h"
#include "support/ode_world.h"

namespace ode_ext::fuzz {
namespace {

using test::Contacts;
using test::TestPose;

// A program of a few operations can ask for thousands of pairs; these are enough of each.
constexpr int kMostAsked = 1000, kMostCompared = 40;

}  // namespace

void Judge::report(const std::string& flaw) {
  if (flaw_.empty()) flaw_ = flaw;
}

// Of the whole process: waiting for other processes does not count, and the device's thread does.
double Judge::seconds() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double Judge::time_of(Geom& a, Geom& b) {
  const dBatchColliderID collider = colliders_.kept(0).id;
  const dGeomID pair[] = {a.id, b.id};
  dContactGeom contacts[64];
  const auto ask = [&] {
    dBatchColliderCollidePairs(collider, pair, 1, 64, contacts, sizeof contacts[0], nullptr);
  };
  ask();  // builds what is not known yet
  const TestPose pose = test::pose_of(a.id);
  const double start = seconds();
  TestPose moved = pose;
  moved.position[0] += 1e-9;  // [m] the same to the eye, but nothing that is known already
  test::set_pose(a.id, moved);
  if (options_.delay) options_.delay();
  ask();
  const double took = seconds() - start;
  test::set_pose(a.id, pose);
  return took;
}

double Judge::stock_time_of(Geom& a, Geom& b) {
  if (!finite(a.mesh->decoded.mesh) || !finite(b.mesh->decoded.mesh) || !tame(a.pose()) ||
      !tame(b.pose()))
    return 0;
  ++tally.stock;
  dContactGeom contacts[64];
  const double start = seconds();
  stock_collide(a.id, b.id, 64, contacts, sizeof contacts[0]);
  return seconds() - start;
}

void Judge::find_slow_pair(const char* what, double took) {
  const auto& geoms = world_.geoms();
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (geoms[i]->inner != nullptr || geoms[j]->inner != nullptr) continue;
      const double ours = time_of(*geoms[i], *geoms[j]);
      if (ours <= options_.slow) continue;
      const double stock = stock_time_of(*geoms[i], *geoms[j]);
      if (ours <= options_.times_stock * stock) continue;
      slow_ = slow_ || flaw_.empty();
      std::ostringstream text;
      text << "a pair takes " << ours << " s, stock ODE " << stock << " s (0: not asked)";
      report(text.str());
      return;
    }
  }
  if (took <= options_.hang) return;
  slow_ = slow_ || flaw_.empty();
  std::ostringstream text;
  text << what << " took " << took << " s, but no pair does by itself";
  report(text.str());
}

void Judge::ask(dGeomID id_a, dGeomID id_b, int limit, const Collider* in_pass) {
  Geom *a = world_.find(id_a), *b = world_.find(id_b);
  if (a == nullptr || b == nullptr || a == b || ++asked_ > kMostAsked) return;
  Contacts contacts = test::collide(id_a, id_b, limit);
  if (options_.tamper) options_.tamper(contacts);
  judge(*a, *b, contacts, limit, in_pass);
  if (not_ours(in_pass)) return;
  // In either order of arguments, as often as asked, with any limit: the same.
  const Contacts other_way = test::flipped(test::collide(id_b, id_a, limit));
  if (!a->merges && !b->merges && !a->refuses && !b->refuses) {
    if (const auto difference = test::difference(contacts, other_way); !difference.empty())
      report("dCollide(b, a) is not dCollide(a, b) turned round: " + difference);
  }
  Contacts prefix = contacts;
  prefix.resize(std::min<std::size_t>(prefix.size(), 1));
  if (const auto difference = test::difference(test::collide(id_a, id_b, 1), prefix);
      !difference.empty())
    report("one contact is not the first of many: " + difference);
}

void Judge::ask_pairs(const std::vector<Geom*>& geoms, int limit, const Collider& collider) {
  timed("dBatchColliderCollidePairs", [&] { ask_pairs_inside(geoms, limit, collider); });
}

void Judge::ask_pairs_inside(const std::vector<Geom*>& geoms, int limit, const Collider& collider) {
  std::vector<dGeomID> ids;
  bool meshes = true;
  for (const Geom* geom : geoms) {
    ids.push_back(geom->id);
    meshes = meshes && geom->inner == nullptr;
  }
  const auto most = static_cast<std::size_t>(limit);
  const std::size_t pairs = ids.size() / 2;
  std::vector<dContactGeom> room(pairs * most + 1);
  std::vector<int> counts(pairs + 1, -7);
  const int total = dBatchColliderCollidePairs(collider.id, ids.data(), static_cast<int>(pairs),
                                               limit, room.data(), sizeof room[0], counts.data());
  if (!meshes && pairs > 0) {
    if (total != -1) report("dBatchColliderCollidePairs took a geom that is not a mesh");
    return;
  }
  int sum = 0;
  for (std::size_t i = 0; i < pairs; ++i) sum += counts[i];
  if (device_fails) return;
  if (total != sum || counts[pairs] != -7) {
    report("dBatchColliderCollidePairs returned " + std::to_string(total) + ", its counts are " +
           std::to_string(sum) + ": " + dBatchColliderGetLastErrorMessage());
    return;
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto first = room.begin() + static_cast<std::ptrdiff_t>(i * most);
    Contacts contacts(first, first + counts[i]);
    Geom &a = *geoms[2 * i], &b = *geoms[2 * i + 1];
    if (&a == &b) {
      if (!contacts.empty()) report("a geom has contacts with itself");
      continue;
    }
    if (!not_ours(&collider)) judge_getters(a, b, contacts, collider);
    if (options_.tamper) options_.tamper(contacts);
    judge(a, b, contacts, limit, &collider);
  }
}

// Of a pair that the collider was asked for just now.
void Judge::judge_getters(Geom& a, Geom& b, const Contacts& contacts, const Collider& by) {
  report(unidentified(by.id, contacts));
  report(misplaced(by.id, contacts, !a.refuses && !b.refuses, by.complete));
  for (const Geom* geom : {&a, &b}) {
    Mesh& mesh = *geom->mesh;
    std::vector<int> meshlets(static_cast<std::size_t>(mesh.triangles()), -7);
    const int count = dBatchColliderGetMeshlets(by.id, mesh.id, mesh.triangles(), meshlets.data());
    report(scattered(meshlets, count, mesh.decoded.mesh));
    if (count == 0 && by.complete && mesh.tame_surface() != nullptr)
      report("a mesh that was just met has no meshlets");
    tally.meshlets += count;
  }
}

void Judge::judge(Geom& a, Geom& b, const Contacts& contacts, int limit, const Collider* by) {
  if (not_ours(by)) return;
  tally.contacts += static_cast<long long>(contacts.size());
  const std::string form = malformed(contacts, a.sides(), b.sides());
  if (!form.empty()) {
    report(form);
    return;
  }
  const bool stale = by == nullptr && (a.mesh->unseen || b.mesh->unseen);
  const bool complete = by == nullptr ? !incomplete : by->complete;
  if (stale || !complete || a.refuses || b.refuses) {
    ++tally.unjudged;
    return;
  }
  const Subject first{a.mesh->decoded.mesh, a.mesh->tame_surface(), a.mesh->decoded.solid,
                      a.pose()};
  const Subject second{b.mesh->decoded.mesh, b.mesh->tame_surface(), b.mesh->decoded.solid,
                       b.pose()};
  report(untrue(first, second, !contacts.empty(), tally));
  if (by != nullptr && by->alike) compare(a, b, contacts, limit, *by);
}

// Colliders that know other pairs, from another past, with other settings.
void Judge::compare(Geom& a, Geom& b, const Contacts& contacts, int limit, const Collider& by) {
  if (a.inner != nullptr || b.inner != nullptr || a.merges || b.merges) return;
  for (std::size_t i = 0; i < Colliders::kKept; ++i) {
    const Collider& other = colliders_.kept(i);
    if (!other.alike || other.id == by.id) continue;
    if (++compared_ > kMostCompared) continue;
    const dGeomID pair[] = {a.id, b.id};
    Contacts others(static_cast<std::size_t>(limit));
    int count = 0;
    if (dBatchColliderCollidePairs(other.id, pair, 1, limit, others.data(), sizeof others[0],
                                   &count) < 0) {
      continue;  // its pass is running
    }
    others.resize(static_cast<std::size_t>(count));
    ++tally.compared;
    if (const auto difference = test::difference(contacts, others); !difference.empty())
      report("another collider says something else: " + difference);
  }
}

}  // namespace ode_ext::fuzz
