// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/program.h"

#include <optional>

#include "fuzz/judge.h"
#include "fuzz/world.h"
#include "opencl/error.h"

namespace ode_ext::fuzz {
namespace {

constexpr int kMostOperations = 64;
constexpr int kLimits[] = {1, 4, 16, 64, 64, 64, 100, 1000};

// Of 32 values of a byte 22 are an operation each; the rest are more of those without which the
// others have nothing to do.
Operation operation_of(std::uint8_t byte) {
  constexpr Operation kMore[] = {Operation::MakeMesh, Operation::MakeGeom, Operation::MakeGeom,
                                 Operation::MakeGeom, Operation::Pose,     Operation::Pass,
                                 Operation::Pass,     Operation::Shake,    Operation::CollidePairs,
                                 Operation::Collide};
  static_assert(kOperations + std::size(kMore) == 32);
  const int value = byte % 32;
  return value < kOperations ? static_cast<Operation>(value) : kMore[value - kOperations];
}

class Program {
 public:
  Program(ByteSource bytes, Colliders& colliders, const ProgramOptions& options)
      : bytes_(bytes), colliders_(colliders), judge_(world_, colliders, options) {
    for (std::size_t i = 0; i < Colliders::kKept; ++i) colliders_.kept(i);
  }
  ~Program() {
    dBatchColliderDestroy(own_.id);
    fault_injector::disarm();
    // The kept colliders are told, as they should be: a mark goes by the address.
    for (const dTriMeshDataID marked : marked_) dBatchColliderTriMeshDataDestroyed(nullptr, marked);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  Verdict run() {
    judge_.tally.executions = 1;
    while (!bytes_.empty() && judge_.flaw().empty() && judge_.tally.operations < kMostOperations) {
      ++judge_.tally.operations;
      step(operation_of(bytes_.byte()));
    }
    if (judge_.flaw().empty()) ask_all();
    return {judge_.flaw(), judge_.slow(), judge_.tally};
  }

 private:
  // What a near callback does.
  enum class Near { Ask, AskSwapped, Nothing, AskTwice, AskOther, Forbidden, Count };
  struct Callback {
    Program* program;
    Near near;
    int limit;
    const Collider* collider;  // null: plain dSpaceCollide
    bool nested;
  };

  const Collider& choose_collider() {
    const int choice = bytes_.below(8);
    return choice == 7 && own_.id != nullptr
               ? own_
               : colliders_.kept(static_cast<std::size_t>(choice) % Colliders::kKept);
  }
  int limit() { return kLimits[bytes_.below(8)]; }

  void step(Operation operation);
  void ask_all();
  void pass(bool two);
  void pairs();
  void edit(Mesh& mesh);
  void announce(Mesh& mesh);
  void destroy(Mesh& mesh);
  void create_collider();
  void stats();
  void bad_call();
  void arm();
  static void near(void* data, dGeomID a, dGeomID b);

  ByteSource bytes_;
  Colliders& colliders_;
  World world_;
  Judge judge_;
  Collider own_;
  std::vector<dTriMeshDataID> marked_;
};

void Program::near(void* data, dGeomID a, dGeomID b) {
  const auto& callback = *static_cast<Callback*>(data);
  Program& program = *callback.program;
  if (!program.judge_.flaw().empty()) return;
  if (dGeomIsSpace(a) != 0 || dGeomIsSpace(b) != 0) {
    if (callback.nested && callback.collider != nullptr)
      dBatchColliderSpaceCollide2(callback.collider->id, a, b, data, &near);
    else
      dSpaceCollide2(a, b, data, &near);
    return;
  }
  switch (callback.near) {
    case Near::AskSwapped:
      program.judge_.ask(b, a, callback.limit, callback.collider);
      break;
    case Near::Nothing:
      break;
    case Near::AskTwice:
      program.judge_.ask(a, b, callback.limit, callback.collider);
      program.judge_.ask(a, b, callback.limit, callback.collider);
      break;
    case Near::AskOther: {
      Geom *first = program.world_.find(a), *second = program.world_.find(b);
      if (first != nullptr && second != nullptr)
        program.judge_.ask_pairs_inside({first, second, second, first}, callback.limit,
                                        program.colliders_.kept(1));
      break;
    }
    case Near::Forbidden:  // refused, and the pass goes on
      if (callback.collider != nullptr) dBatchColliderDestroy(callback.collider->id);
      [[fallthrough]];
    default:
      program.judge_.ask(a, b, callback.limit, callback.collider);
  }
}

void Program::pass(bool two) {
  const int choice = bytes_.byte();
  const Collider* collider = (choice & 31) == 31 ? nullptr : &choose_collider();
  Callback callback{this, static_cast<Near>((choice >> 5) % static_cast<int>(Near::Count)), limit(),
                    collider, (choice & 16) != 0};
  const dBatchColliderID id = collider == nullptr ? nullptr : collider->id;
  int result = 1;
  if (two) {
    const auto object = [&]() -> dGeomID {
      Geom* geom = world_.choose_geom(bytes_);
      if (geom == nullptr || bytes_.coin())
        return reinterpret_cast<dGeomID>(world_.choose_space(bytes_)->id);
      return geom->id;
    };
    const dGeomID a = object(), b = object();
    if (a == b && dGeomIsSpace(a) == 0) return;
    judge_.timed("dBatchColliderSpaceCollide2",
                 [&] { result = dBatchColliderSpaceCollide2(id, a, b, &callback, &near); });
  } else {
    const Space* space = world_.choose_space(bytes_);
    judge_.timed("dBatchColliderSpaceCollide",
                 [&] { result = dBatchColliderSpaceCollide(id, space->id, &callback, &near); });
  }
  const bool may_deliver_nothing = collider == &own_;
  if (result != 1 && !judge_.device_fails && !may_deliver_nothing)
    judge_.report("a pass returned " + std::to_string(result) + ": " +
                  dBatchColliderGetLastErrorMessage());
}

void Program::pairs() {
  std::vector<Geom*> geoms;
  for (int i = 2 * bytes_.between(0, 6); i > 0; --i) {
    Geom* geom = world_.choose_geom(bytes_);
    if (geom == nullptr) break;
    geoms.push_back(geom);
  }
  if (geoms.size() % 2 != 0) geoms.pop_back();
  const Collider& collider = choose_collider();
  judge_.ask_pairs(geoms, limit(), collider);
}

// What has come of it in the end, each geom with every other.
void Program::ask_all() {
  std::vector<Geom*> geoms;
  for (const auto& a : world_.geoms()) {
    for (const auto& b : world_.geoms()) {
      if (a == b) break;
      if (a->inner == nullptr && b->inner == nullptr) geoms.insert(geoms.end(), {a.get(), b.get()});
    }
  }
  judge_.ask_pairs(geoms, 64, colliders_.kept(0));
}

void Program::announce(Mesh& mesh) {
  dBatchColliderTriMeshDataUpdate(nullptr, mesh.id);
  mesh.unseen = false;
}

void Program::edit(Mesh& mesh) {
  world_.edit(mesh, bytes_);
  mesh.unseen = true;
  if (bytes_.coin()) announce(mesh);
}

void Program::destroy(Mesh& mesh) {
  const dTriMeshDataID id = mesh.id;
  world_.destroy(mesh);
  if (std::erase(marked_, id) > 0 || bytes_.coin()) dBatchColliderTriMeshDataDestroyed(nullptr, id);
}

void Program::create_collider() {
  dBatchColliderDestroy(own_.id);
  own_ = decode_collider(bytes_);
  if (own_.id == nullptr && dBatchColliderGetLastErrorMessage()[0] == '\0')
    judge_.report("dBatchColliderCreate returned 0 and no message");
  judge_.incomplete = own_.id != nullptr && !own_.complete;
}

void Program::stats() {
  const int which = bytes_.coin() ? int{dBatchBufferHits} : int{bytes_.byte()};
  const dBatchColliderID collider = choose_collider().id;
  dBatchColliderGetStatus(collider);
  dBatchColliderGetCount(collider, which);
  dBatchColliderGetTime(collider, which);
  dBatchColliderGetWork(collider, which, which % 5);
}

void Program::bad_call() {
  const auto wrong =
      reinterpret_cast<dBatchColliderID>(static_cast<std::uintptr_t>(16 + bytes_.byte()));
  dContactGeom contact{};
  dBatchContactId contact_id;
  dBatchContactRegion region;
  int count = 0, meshlet = 0;
  Callback callback{this, Near::Nothing, 1, nullptr, false};
  const dSpaceID space = world_.choose_space(bytes_)->id;
  const Geom* geom = world_.choose_geom(bytes_);
  const dGeomID pair[] = {geom == nullptr ? nullptr : geom->id, nullptr};
  const dBatchColliderID collider = colliders_.kept(0).id;
  int result = -1;
  switch (bytes_.below(10)) {
    case 0:
      dBatchColliderDestroy(wrong);
      break;
    case 1:
      result = dBatchColliderSpaceCollide(wrong, space, &callback, &near);
      if (result == -1)
        result = dBatchColliderGetContactIds(wrong, &contact, 1, sizeof contact, &contact_id);
      if (result == -1)
        result = dBatchColliderGetContactRegions(wrong, &contact, 1, sizeof contact, &region);
      if (result == -1) result = dBatchColliderGetMeshlets(collider, nullptr, 1, &meshlet);
      break;
    case 2:
      result = dBatchColliderSpaceCollide(collider, nullptr, &callback, &near);
      break;
    case 3:
      result = dBatchColliderSpaceCollide(collider, space, &callback, nullptr);
      break;
    case 4:
      result = dBatchColliderCollidePairs(collider, pair, 1, 1, &contact, sizeof contact, &count);
      break;
    case 5:
      result = dBatchColliderCollidePairs(collider, pair, -1, 1, &contact, sizeof contact, &count);
      // Of a contact that nobody gave none is known.
      contact.g1 = pair[0];
      if (result == -1)
        result =
            dBatchColliderGetContactIds(collider, &contact, 1, sizeof contact, &contact_id) - 1;
      if (result == -1)
        result =
            dBatchColliderGetContactRegions(collider, &contact, 1, sizeof contact, &region) - 1;
      break;
    case 6:
      result = dBatchColliderCollidePairs(collider, pair, 1, 0x10000, &contact, 1, &count);
      if (result == -1) result = dBatchColliderGetContactIds(collider, &contact, 1, 1, &contact_id);
      if (result == -1) result = dBatchColliderGetContactRegions(collider, &contact, 1, 1, &region);
      break;
    case 7:
      dBatchColliderTriMeshDataUpdate(wrong, nullptr);
      break;
    case 8:
      if (dBatchColliderGetDeviceName(wrong) == nullptr) result = dBatchColliderGetStatus(wrong);
      break;
    default:
      result = dBatchColliderSpaceCollide2(collider, nullptr, pair[0], &callback, &near);
  }
  if (result != -1) judge_.report("a call that makes no sense returned " + std::to_string(result));
}

// The nth OpenCL call of a pass fails.
void Program::arm() {
  constexpr int kCodes[] = {CL_OUT_OF_RESOURCES, CL_OUT_OF_HOST_MEMORY,
                            CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_DEVICE_NOT_AVAILABLE,
                            CL_INVALID_COMMAND_QUEUE};
  const int nth = bytes_.between(1, 100), code = kCodes[bytes_.below(5)];
  if (!world_.all_tame()) return;  // ODE answers instead, and must be able to
  judge_.device_fails = judge_.device_failed = true;
  fault_injector::arm(nth, code);
  pass(false);
  fault_injector::disarm();
  judge_.device_fails = false;
}

void Program::step(Operation operation) {
  switch (operation) {
    case Operation::MakeMesh:
      world_.make_mesh(bytes_);
      break;
    case Operation::MakeGeom:
      world_.make_geom(bytes_);
      break;
    case Operation::MakeSpace:
      world_.make_space(bytes_);
      break;
    case Operation::Pose:
      if (Geom* geom = world_.choose_geom(bytes_)) world_.pose(*geom, bytes_);
      break;
    case Operation::Pass:
      pass(false);
      break;
    case Operation::CollidePairs:
      pairs();
      break;
    case Operation::Collide: {
      Geom *a = world_.choose_geom(bytes_), *b = world_.choose_geom(bytes_);
      if (a == nullptr) break;
      judge_.timed("dCollide", [&] { judge_.ask(a->id, b->id, limit(), nullptr); });
      break;
    }
    case Operation::Pass2:
      pass(true);
      break;
    case Operation::Shake:
      world_.shake(bytes_);
      break;
    case Operation::Edit:
      if (Mesh* mesh = world_.choose_mesh(bytes_)) edit(*mesh);
      break;
    case Operation::Rebuild:
      if (Mesh* mesh = world_.choose_mesh(bytes_)) {
        world_.rebuild(*mesh, bytes_);
        mesh->unseen = true;
        if (bytes_.coin()) announce(*mesh);
      }
      break;
    case Operation::DestroyMesh:
      if (Mesh* mesh = world_.choose_mesh(bytes_)) destroy(*mesh);
      break;
    case Operation::DestroyGeom:
      if (Geom* geom = world_.choose_geom(bytes_)) world_.destroy(*geom);
      break;
    case Operation::MoveToSpace: {
      Geom* geom = world_.choose_geom(bytes_);
      if (geom != nullptr) world_.move_to(*geom, *world_.choose_space(bytes_));
      break;
    }
    case Operation::GiveMesh: {
      Geom* geom = world_.choose_geom(bytes_);
      if (geom != nullptr) world_.give(*geom, *world_.choose_mesh(bytes_));
      break;
    }
    case Operation::Deformable:
      if (Mesh* mesh = world_.choose_mesh(bytes_)) {
        dBatchColliderTriMeshDataSetDeformable(nullptr, mesh->id, bytes_.coin());
        std::erase(marked_, mesh->id);
        marked_.push_back(mesh->id);
      }
      break;
    case Operation::CreateCollider:
      create_collider();
      break;
    case Operation::DestroyCollider:
      dBatchColliderDestroy(own_.id);
      own_ = {};
      judge_.incomplete = false;
      break;
    case Operation::Stats:
      stats();
      break;
    case Operation::BadCall:
      bad_call();
      break;
    case Operation::Fault:
      arm();
      break;
    default:
      if (Mesh* mesh = world_.choose_mesh(bytes_)) announce(*mesh);
  }
}

}  // namespace

Verdict run_program(std::span<const std::uint8_t> bytes, Colliders& colliders,
                    const ProgramOptions& options) {
  return Program(ByteSource(bytes), colliders, options).run();
}

}  // namespace ode_ext::fuzz
