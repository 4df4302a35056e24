// SPDX-License-Identifier: BSD-3-Clause
// The C API under libFuzzer. scripts/fuzz runs it; given files in place of folders it runs those,
// in order and in one process. What it found goes to stderr, with the bytes in a file, as libFuzzer
// has it; at the end it says how much was judged.
//
// Colliders live for many programs, since making them takes longer than all else. A flaw is looked
// for again with new ones, and said to depend on the past if it is gone then; ODE_EXT_FUZZ_HISTORY
// names a folder that keeps the programs since the colliders were made, for this and for crashes.
#include <ode/ode.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "fuzz/program.h"

namespace {

using namespace ode_ext::fuzz;

constexpr int kProgramsPerColliders = 200;

void say_nothing(int, const char*, va_list) {}

// LLVM, in PoCL, takes the signals that libFuzzer writes its artifacts at when it first compiles a
// kernel, and lets an abort pass. If that was before libFuzzer began, it leaves them to LLVM. So
// they are free when it begins, and given back to it before every program.
class Signals {
 public:
  static void free() {
    for (const int fatal : kFatal) std::signal(fatal, SIG_DFL);
  }
  Signals() {
    for (std::size_t i = 0; i < std::size(kFatal); ++i) sigaction(kFatal[i], nullptr, &actions_[i]);
  }
  void give_back() const {
    for (std::size_t i = 0; i < std::size(kFatal); ++i) sigaction(kFatal[i], &actions_[i], nullptr);
  }

 private:
  static constexpr int kFatal[] = {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV};
  struct sigaction actions_[std::size(kFatal)];
};

class Session {
 public:
  Session() {
    dInitODE2(0);
    dSetMessageHandler(&say_nothing);
    if (const char* folder = std::getenv("ODE_EXT_FUZZ_HISTORY")) history_ = folder;
    renew();
  }

  void run(std::span<const std::uint8_t> bytes) {
    if (programs_++ == kProgramsPerColliders) renew();
    remember(bytes);
    if (!signals_) signals_.emplace();
    signals_->give_back();
    const Verdict verdict = run_program(bytes, colliders_);
    tally_ += verdict.tally;
    if (verdict.flaw.empty()) return;
    colliders_.renew();  // the history stays: its last program is this one
    const Verdict again = run_program(bytes, colliders_);
    // Kernels that were compiled while the clock ran are there the second time.
    if (verdict.slow && again.flaw.empty()) return;
    std::fprintf(stderr, "FLAW: %s\n", verdict.flaw.c_str());
    if (again.flaw.empty())
      std::fprintf(stderr, "... but not with new colliders: it depends on the programs before\n");
    else if (again.flaw != verdict.flaw)
      std::fprintf(stderr, "... and with new colliders: %s\n", again.flaw.c_str());
    signals_->give_back();
    std::abort();
  }

  void report() const { std::fprintf(stderr, "%s", to_text(tally_).c_str()); }

 private:
  void renew() {
    programs_ = 1;
    colliders_.renew();
    for (std::size_t i = 0; i < Colliders::kKept; ++i) colliders_.kept(i);
    if (history_.empty()) return;
    std::filesystem::remove_all(history_);
    std::filesystem::create_directories(history_);
  }

  void remember(std::span<const std::uint8_t> bytes) const {
    if (history_.empty()) return;
    char name[16];
    std::snprintf(name, sizeof name, "%06d", programs_);
    std::ofstream(history_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }

  std::optional<Signals> signals_;
  Colliders colliders_;
  Tally tally_;
  int programs_ = 0;
  std::filesystem::path history_;
};

Session* session = nullptr;

void start() {
  try {
    session = new Session;
    Signals::free();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "no collider to fuzz: %s\n", error.what());
    std::exit(1);
  }
  std::atexit([] {  // libFuzzer ends with exit()
    session->report();
    delete session;
  });
}

}  // namespace

// What compiling kernels leaves behind in PoCL and LLVM, if its cache did not have them already.
// That this library gives its OpenCL objects back is tried by the tests under AddressSanitizer.
extern "C" const char* __lsan_default_suppressions() { return "leak:libpocl\nleak:libLLVM\n"; }

// Compiles the kernels, which can take longer than a program may.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  dInitODE2(0);
  try {
    Colliders colliders;
    for (std::size_t i = 0; i < Colliders::kKept; ++i) colliders.kept(i);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "no collider to fuzz: %s\n", error.what());
    std::exit(1);
  }
  dCloseODE();
  return 0;
}

// The session starts with the first program: libFuzzer has its signals by then.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (session == nullptr) start();
  session->run({data, size});
  return 0;
}
