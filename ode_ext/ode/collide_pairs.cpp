// SPDX-License-Identifier: BSD-3-Clause
// BatchCollider, where a program gives it the pairs.
#include <numeric>
#include <optional>

#include "collide/own_work.h"
#include "ode/batch_collider.h"
#include "ode/contact_export.h"
#include "ode/messages.h"
#include "ode/program_callbacks.h"
#include "ode/stock_collider.h"
#include "ode/stopwatch.h"

namespace ode_ext {
namespace {

// What dCollide itself checks before it asks a collider.
bool can_collide(dGeomID g1, dGeomID g2) {
  return g1 != g2 && (dGeomGetBody(g1) == nullptr || dGeomGetBody(g1) != dGeomGetBody(g2));
}

// Returns how many pairs it answered.
long long collide_by_stock(std::span<const dGeomID> geoms, std::span<const std::size_t> pairs,
                           int flags, PairOutput& output) {
  long long answered = 0;
  for (const std::size_t i : pairs) {
    const dGeomID g1 = geoms[2 * i], g2 = geoms[2 * i + 1];
    if (!can_collide(g1, g2)) {
      output.note(i, 0);
      continue;
    }
    ++answered;
    output.note(i, stock_collide(g1, g2, flags, output.of(i), output.skip()));
  }
  return answered;
}

}  // namespace

int BatchCollider::collide_pairs(std::span<const dGeomID> geoms, int flags, dContactGeom* contacts,
                                 int skip, int* counts) {
  const Stopwatch whole;
  PairOutput output(contacts, flags & 0xffff, skip, counts);
  // What the program's code has a part in waits until the lock is gone: callbacks, and ODE's own
  // collider, which calls them.
  std::vector<PairToAsk> to_ask;
  std::vector<std::size_t> by_stock;
  collide_batch(geoms, output, to_ask, by_stock);
  const long long answered_by_stock = collide_by_stock(geoms, by_stock, flags, output);
  for (const auto& [i, answer] : to_ask)
    output.note(i, export_asked(answer, geoms[2 * i], geoms[2 * i + 1], output.limit(),
                                output.of(i), skip));

  const OwnWork work(mutex_);
  stats_.pairs_colliding = output.colliding();
  stats_.pairs_stock += answered_by_stock;
  stats_.meshes = static_cast<std::int64_t>(known_.meshes().size());
  stats_.ms_pass = whole.milliseconds();
  return output.total();
}

void BatchCollider::collide_batch(std::span<const dGeomID> geoms, PairOutput& output,
                                  std::vector<PairToAsk>& to_ask,
                                  std::vector<std::size_t>& by_stock) {
  const HeldMessages held;
  const OwnWork work(mutex_);
  hear_announcements();
  begin_stats(is_passing());
  try {
    make_anew_what_keeps_failing();
    compute_pairs(geoms);
    note_success();
  } catch (const std::exception& error) {
    fail(error);
    by_stock.resize(geoms.size() / 2);
    std::iota(by_stock.begin(), by_stock.end(), std::size_t{0});
    return;
  }
  for (std::size_t i = 0; i < geoms.size() / 2; ++i) {
    const dGeomID g1 = geoms[2 * i], g2 = geoms[2 * i + 1];
    if (!can_collide(g1, g2)) {
      output.note(i, 0);
      continue;
    }
    const Answer& answer = known_.entry(g1, g2);
    if (!answer.valid)
      by_stock.push_back(i);
    else if (has_callbacks(g1, g2, triangle_callbacks_))
      to_ask.emplace_back(i, known_.copy_of(answer));
    else
      output.note(i, export_contacts(answer.contacts, answer.geoms[0], g1, g2, output.limit(),
                                     output.of(i), output.skip()));
  }
}

void BatchCollider::compute_pairs(std::span<const dGeomID> geoms) {
  std::optional<KnownPairs::LookBetween> look;
  if (!is_within_a_pass()) look.emplace(known_);
  age_outside(geoms.size() / 2);
  known_.begin_batch(is_within_a_pass());
  for (std::size_t i = 0; i < geoms.size() / 2; ++i) {
    const dGeomID g1 = geoms[2 * i], g2 = geoms[2 * i + 1];
    if (!can_collide(g1, g2)) continue;
    Answer& answer = known_.entry(g1, g2);
    answer.last_round = known_.round();
    answer.passes_unasked = 0;
    known_.add(answer, GatheredPair{{g1, g1}, {g2, g2}});
  }
  stats_.pairs = static_cast<long long>(geoms.size() / 2);
  made_outside_ += known_.changed();
  known_.compute(nullptr);
  note_report();
}

}  // namespace ode_ext
