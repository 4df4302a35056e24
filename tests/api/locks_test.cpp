// SPDX-License-Identifier: BSD-3-Clause
// Code of the program's runs under no lock of the library's: wherever it is called from, it may
// call dCollide, and may wait for another thread that does.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "opencl/error.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

// Ends the program with a failure if it is not gone in time: a test that hangs says nothing.
class Deadline {
 public:
  explicit Deadline(const char* what)
      : thread_([this, what] {
          std::unique_lock lock(mutex_);
          if (gone_.wait_for(lock, std::chrono::seconds(100), [this] { return done_; })) return;
          std::fprintf(stderr, "deadlock: %s\n", what);
          std::abort();
        }) {}
  ~Deadline() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    gone_.notify_all();
    thread_.join();
  }

 private:
  std::mutex mutex_;
  std::condition_variable gone_;
  bool done_ = false;
  std::thread thread_;
};

// Two threads, and what each does when it is called: it waits until the other is called too, and
// then asks for contacts, from whoever has them.
class Meeting {
 public:
  void arrive_and_ask(dGeomID o1, dGeomID o2) {
    {
      std::unique_lock lock(mutex_);
      ++here_;
      all_here_.notify_all();
      all_here_.wait(lock, [this] { return here_ >= 2; });
    }
    contacts += static_cast<int>(collide(o1, o2).size());
  }
  std::atomic<int> contacts{0};

 private:
  std::mutex mutex_;
  std::condition_variable all_here_;
  int here_ = 0;
};

struct Caller {
  Meeting* meeting = nullptr;
  dGeomID o1 = nullptr, o2 = nullptr;
  void call() {
    Meeting* const once = std::exchange(meeting, nullptr);
    if (once != nullptr) once->arrive_and_ask(o1, o2);
  }
};
thread_local Caller caller;

dColliderFn* no_collider(int) { return nullptr; }
void box_of_own_class(dGeomID, dReal box[6]) {
  caller.call();
  for (int i = 0; i < 6; ++i) box[i] = i % 2 == 0 ? -9 : 9;
}
int own_class() {
  static const int id = [] {
    dGeomClass made{};
    made.bytes = sizeof(int);
    made.collider = &no_collider;
    made.aabb = &box_of_own_class;
    return dCreateGeomClass(&made);
  }();
  return id;
}

void message_that_calls(int, const char*, va_list) { caller.call(); }

int merge_that_calls(dGeomID, int first, int) {
  caller.call();
  return first;
}

// A thread of the program with a space and a collider of its own.
struct LockedTask {
  explicit LockedTask(OdeWorld& world)
      : space(world.space(SpaceKind::Simple)),
        pile(world, space, 6, 11),
        mesh(world.mesh(make_cube(1))) {
    mark = world.own(dCreateGeom(own_class()));
    dSpaceAdd(space, mark);
    TestPose near;
    near.position = {0.3, 0.2, 0.9};
    o1 = world.geom(mesh, {});
    o2 = world.geom(mesh, near);
  }
  template <class Run>
  std::thread start(Meeting& meeting, Run run) {
    return std::thread([this, &meeting, run] {
      dAllocateODEDataForThread(dAllocateMaskAll);
      caller = {&meeting, o1, o2};
      run(*this);
      dCleanupODEAllDataForThread();
    });
  }

  dSpaceID space;
  Pile pile;
  OdeMesh& mesh;
  dGeomID mark, o1, o2;
  BatchCollider collider;
};

class ApiLocks : public ::testing::Test {
 protected:
  template <class Run>
  void run_both(const char* what, Run run) {
    const Deadline deadline(what);
    Meeting meeting;
    std::thread one = first.start(meeting, run);
    std::thread two = second.start(meeting, run);
    one.join();
    two.join();
    EXPECT_GT(meeting.contacts, 0);
  }

  OdeWorld world;
  LockedTask first{world}, second{world};
};

TEST_F(ApiLocks, AreNotHeldWhileAProgramsGeomClassIsAskedForABox) {
  run_both("box functions of geom classes", [](LockedTask& task) {
    dGeomSetPosition(task.mark, 1, 0, 0);
    task.collider.pass(task.space);
  });
}

TEST_F(ApiLocks, AreNotHeldWhileAProgramsMessageHandlerRuns) {
  dSetMessageHandler(&message_that_calls);
  run_both("message handlers", [](LockedTask& task) {
    TestMesh broken = make_cube(1);
    broken.vertices[0] = NAN;
    OdeMesh mesh(broken);
    const dGeomID geom = dCreateTriMesh(nullptr, mesh.id(), nullptr, nullptr, nullptr);
    const dGeomID pair[] = {geom, task.o1};
    dContactGeom contact;
    dBatchColliderCollidePairs(task.collider, pair, 1, 1, &contact, sizeof contact, nullptr);
    dGeomDestroy(geom);
  });
  dSetMessageHandler(nullptr);
}

TEST_F(ApiLocks, AreNotHeldWhileAProgramsMergeCallbackRuns) {
  for (const LockedTask* task : {&first, &second})
    for (const dGeomID geom : task->pile.geoms)
      dGeomTriMeshSetTriMergeCallback(geom, &merge_that_calls);
  run_both("merge callbacks", [](LockedTask& task) { task.collider.pass(task.space); });
}

// Asks for another pair, once.
struct Nested {
  static int merge(dGeomID, int first, int) {
    const GeomPair pair = std::exchange(next, {});
    if (pair.first != nullptr)
      contacts += static_cast<int>(collide(pair.first, pair.second).size());
    return first;
  }
  static inline GeomPair next;
  static inline int contacts = 0;
};

// ODE's own collider calls merge callbacks while it stands in, and after the last collider is gone.
// They may ask for other meshes, in their own thread: it is not made for two.
TEST_F(ApiLocks, AreNotHeldWhileOdesOwnColliderCallsBack) {
  for (const dGeomID geom : first.pile.geoms) dGeomTriMeshSetTriMergeCallback(geom, &Nested::merge);
  const auto nested_in = [&](const auto& pass) {
    const Deadline deadline("merge callbacks of ODE's own collider");
    Nested::next = {first.o1, first.o2};
    Nested::contacts = 0;
    pass();
    return Nested::contacts;
  };
  EXPECT_GT(nested_in([&] {
              fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
              first.collider.pass(first.space);
              fault_injector::disarm();
            }),
            0);
  first.collider.destroy();
  second.collider.destroy();
  EXPECT_GT(nested_in([&] {
              Collected collected;
              dSpaceCollide(first.space, &collected, &collect);
            }),
            0);
}

// ODE's own collider says what bothers it through the message handler, which may ask for meshes.
TEST_F(ApiLocks, LetTheThreadInAgainThatOdesOwnColliderSpeaksIn) {
  first.collider.destroy();
  second.collider.destroy();
  OdeMesh& fine = world.mesh(make_torus(1, 0.4, 96, 48));
  TestPose deep;
  deep.position = {0.1, 0.05, 0.1};
  const dGeomID one = world.geom(fine, {}), other = world.geom(fine, deep);
  static int messages = 0, contacts = 0;
  static GeomPair asked;
  messages = contacts = 0;
  asked = {first.o1, first.o2};
  dSetMessageHandler([](int, const char*, va_list) {
    if (messages++ == 0) contacts += static_cast<int>(collide(asked.first, asked.second).size());
  });
  const Deadline deadline("the message handler of ODE's own collider");
  // So many contacts that its table of them overflows, which it says.
  std::vector<dContactGeom> many(50000);
  dCollide(one, other, static_cast<int>(many.size()), many.data(), sizeof(dContactGeom));
  dSetMessageHandler(nullptr);
  EXPECT_GT(messages, 0);
  EXPECT_GT(contacts, 0);
}

}  // namespace
}  // namespace ode_ext::test
