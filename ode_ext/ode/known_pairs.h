// SPDX-License-Identifier: BSD-3-Clause
// All that is known of pairs: their meshes, their geoms as they were last seen, and their answers;
// and how answers come to be, a batch at a time. Not locked: a BatchCollider is.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <string>

#include "collide/collider.h"
#include "ode/answers.h"
#include "ode/members.h"
#include "ode/mesh_store.h"
#include "ode/pair_gather.h"
#include "ode/pair_scene.h"
#include "ode/pass_stats.h"
#include "ode/rounds.h"

namespace ode_ext {

inline constexpr std::uint64_t kPassesGivenUp = 64;

class KnownPairs {
 public:
  // What is found out is noted in `stats`.
  KnownPairs(const ColliderOptions& options, float open_thickness, bool trust_meshes,
             PassStats& stats);

  const Collider& collider() const { return *collider_; }
  // Another in its place, of the same device, with nothing there yet. What else knows that has to
  // be gone. Throws DeviceError; it is as it was then.
  void make_collider_anew();
  MeshStore& meshes() { return meshes_; }
  Members& members() { return members_; }

  // The number of the outermost pass.
  std::uint64_t pass() const { return pass_; }
  void begin_pass() {
    ++pass_;
    members_.let_go();
  }
  // By which all that is known ages.
  std::uint64_t round() const { return rounds_.number(); }
  void note_outermost(const PassRoot& root, std::size_t pairs) { rounds_.note_pass(root, pairs); }
  // Meshes are read anew when this number changes.
  std::uint64_t look() const { return look_; }
  void look_again() { look_ = ++looks_; }
  // While one lives meshes are read anew. Then it is as before: a pass of another thread reads
  // again what was read meanwhile, and nothing else.
  class LookBetween {
   public:
    explicit LookBetween(KnownPairs& known) : known_(known), before_(known.look_) {
      known_.look_again();
    }
    ~LookBetween() { known_.look_ = before_; }
    LookBetween(const LookBetween&) = delete;
    LookBetween& operator=(const LookBetween&) = delete;

   private:
    KnownPairs& known_;
    std::uint64_t before_;
  };

  Answer* find(dGeomID g1, dGeomID g2) { return answers_.find(g1, g2); }
  Answer& entry(dGeomID g1, dGeomID g2) { return answers_.entry(g1, g2); }
  void prefetch(dGeomID g1, dGeomID g2) const { answers_.prefetch(g1, g2); }
  // Whether an answer is of the geoms as they are now. `reads`: their meshes too, where these were
  // not since look_again(); else as they were last read.
  bool holds(Answer& answer, dGeomID g1, dGeomID g2, bool reads);
  // Of one that holds.
  AnswerCopy copy_of(const Answer& answer) const;

  // A batch begins, pairs are added that are not answered yet, and are computed.
  // skips_given_up: pairs that the device had no room for of late, while they are of the same
  // meshes: each attempt takes as long as a pass.
  void begin_batch(bool skips_given_up) {
    scene_.begin();
    skips_given_up_ = skips_given_up;
    why_given_up_.clear();
    given_up_ = 0;
  }
  // With its geoms as they are, each looked at once for a batch.
  void add(Answer& answer, const GatheredPair& pair);
  void add(Answer& answer, PairMember& a, PairMember& b);
  // What status bits say of a geom that is met, of a mesh that is known.
  void note_status(dTriMeshDataID data, bool is_placed);
  // Throws DeviceError; the batch is to be dropped then.
  void compute(PassMemory* memory);
  void drop_batch() { scene_.drop(); }
  bool is_given_up(const Answer& answer) const {
    return answer.given_up != 0 && pass_ < answer.given_up + kPassesGivenUp;
  }
  // Why there is no room for pairs of the batch, "": there is; and of how many that was tried.
  const std::string& why_given_up() const { return why_given_up_; }
  std::int64_t given_up() const { return given_up_; }
  // Answers of the batch with contacts, those that were there before among them.
  long long colliding() const { return scene_.colliding(); }
  // Answers of the batch that are other ones than before, or will be.
  std::size_t changed() const { return scene_.changed(); }

  // Forgets what no round met of late.
  void prune();
  // Where no pass ages what is known: forgets all pairs, and meshes that nothing met since the last
  // time.
  void age();

 private:
  void give_up(std::size_t pair, const std::string& why);
  // What is known of one geom of an answer: looked up once for it, and not again in every pass.
  Members::Seen& seen(Answer& answer, dGeomID geom, dGeomID other);
  PairMember& member_of(Members::Seen& seen, const PlacedGeom& placed);
  const PairMember* current_member(Answer& answer, dGeomID geom, dGeomID other, bool reads);

  PassStats& stats_;
  std::unique_ptr<Collider> collider_;
  MeshStore meshes_;
  Members members_;
  Answers answers_;
  PairScene scene_;  // that is being built
  Rounds rounds_;
  std::uint64_t pass_ = 0;
  std::uint64_t look_ = 0, looks_ = 0;
  bool skips_given_up_ = false;
  std::string why_given_up_;
  std::int64_t given_up_ = 0;
};

}  // namespace ode_ext
