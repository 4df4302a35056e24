// SPDX-License-Identifier: BSD-3-Clause
// Replays what ODE_EXT_CAPTURE wrote, on any device, and compares the contacts byte for byte.
#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/replay/capture_file.h"
#include "tools/replay/comparison.h"
#include "tools/replay/player.h"

namespace {

using namespace ode_ext::replay;

enum ExitCode { kExitSame = 0, kExitDifferent = 1, kExitUsage = 2, kExitNoDevice = 3 };

struct Options {
  std::string file, device, config;
  bool has_device = false, has_config = false, partial = false;
  int repeat = 1;
};

struct Totals {
  long long passes = 0, pairs = 0, contacts = 0;
  long long passes_compared = 0, passes_differing = 0, pairs_differing = 0;
  double ms = 0;
  std::uint64_t captured = kHashStart, replayed = kHashStart;
  std::string first_difference;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

// The capture, played while it is read: of several threads contacts may come after later passes.
class Replay {
 public:
  explicit Replay(const Options& options) : options_(options), file_(options.file) {}

  void run() {
    try {
      while (take(file_.next())) {
      }
    } catch (const CaptureTruncated& truncated) {
      if (!options_.partial)
        throw CaptureError(std::string(truncated.what()) +
                           "; --partial replays what is before that");
      std::printf("%s\n", truncated.what());
    }
    for (const auto& [number, pass] : open_) play_without_contacts(pass);
  }
  const Totals& totals() const { return totals_; }

 private:
  bool take(const Record& record) {
    if (std::holds_alternative<EndOfCapture>(record)) return false;
    if (const auto* collider = std::get_if<ColliderRecord>(&record)) add(*collider);
    if (const auto* mesh = std::get_if<MeshRecord>(&record)) meshes_.push_back(*mesh);
    if (const auto* pass = std::get_if<PassRecord>(&record)) open_[pass->number] = *pass;
    if (const auto* contacts = std::get_if<ContactsRecord>(&record)) {
      const auto pass = open_.find(contacts->pass);
      if (pass == open_.end()) throw CaptureError("a pass has its contacts twice in the capture");
      play(pass->second, *contacts);
      open_.erase(pass);
    }
    return true;
  }

  void add(const ColliderRecord& record) {
    players_.push_back(std::make_unique<Player>(
        record, meshes_, options_.has_device ? options_.device.c_str() : nullptr,
        options_.has_config ? options_.config.c_str() : nullptr));
    std::printf("collider %u  captured by ode_ext %s on %s%s%s, replayed on %s\n", record.number,
                record.version.c_str(), record.device.c_str(),
                record.config.empty() ? "" : ", config ", record.config.c_str(),
                players_.back()->device_name());
    std::fflush(stdout);  // before what standard error says
  }

  std::vector<Played> play_all(const PassRecord& pass) {
    std::vector<Played> played = players_[pass.collider]->play(pass, options_.repeat);
    std::vector<double> ms;
    ms.reserve(played.size());
    for (const Played& one : played) ms.push_back(one.ms);
    ++totals_.passes;
    totals_.pairs += pass.pairs;
    totals_.contacts += static_cast<long long>(played.back().contacts.size());
    totals_.ms += median(ms);
    return played;
  }

  void play(const PassRecord& pass, const ContactsRecord& captured) {
    const std::vector<Played> all = play_all(pass);
    ++totals_.passes_compared;
    totals_.captured = mix(totals_.captured, captured.counts, captured.contact_list);
    totals_.replayed = mix(totals_.replayed, all.back().counts, all.back().contacts);
    for (const Played& played : all) {
      const Difference difference = compare(pass, captured, played);
      if (difference.pairs == 0) continue;
      if (totals_.first_difference.empty()) totals_.first_difference = difference.first;
      ++totals_.passes_differing;
      totals_.pairs_differing += difference.pairs;
      break;
    }
  }

  void play_without_contacts(const PassRecord& pass) {
    const std::vector<Played> all = play_all(pass);
    std::printf(
        "pass %u of %u pairs has no contacts in the capture: the program ended in it, or its "
        "device failed. Replayed: %zu contacts\n",
        pass.number, pass.pairs, all.back().contacts.size());
  }

  const Options& options_;
  CaptureFile file_;
  std::vector<MeshRecord> meshes_;
  std::vector<std::unique_ptr<Player>> players_;
  std::map<std::uint32_t, PassRecord> open_;  // passes whose contacts have not come yet
  Totals totals_;
};

int report(const Options& options, const Totals& totals) {
  if (totals.passes == 0) throw CaptureError("there is no whole pass in '" + options.file + "'");
  std::printf("replayed    %lld passes, %lld pairs, %lld contacts, %.3f ms\n", totals.passes,
              totals.pairs, totals.contacts, totals.ms);
  if (totals.passes_compared == 0) {
    std::printf("not compared: no pass has its contacts in the capture\n");
    return kExitUsage;
  }
  std::printf("captured    hash %016llx\n", static_cast<unsigned long long>(totals.captured));
  std::printf("replayed    hash %016llx\n", static_cast<unsigned long long>(totals.replayed));
  if (totals.passes_differing == 0) {
    std::printf("the same, byte for byte\n");
    return kExitSame;
  }
  std::printf("different   %lld pairs in %lld passes; the first:\n%s\n", totals.pairs_differing,
              totals.passes_differing, totals.first_difference.c_str());
  return kExitDifferent;
}

int replay(const Options& options) {
  int exit_code = kExitUsage;
  dInitODE2(0);
  try {
    Replay replay(options);
    replay.run();
    exit_code = report(options, replay.totals());
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw std::runtime_error("the report could not be written");
  } catch (const DeviceError& error) {
    std::fprintf(stderr, "ode_ext-replay: %s\n", error.what());
    exit_code = kExitNoDevice;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ode_ext-replay: %s\n", error.what());
    exit_code = kExitUsage;
  }
  dCloseODE();
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  setenv("POCL_AFFINITY", "1", 0);  // or its threads may share a core; read when OpenCL starts
  unsetenv("ODE_EXT_CAPTURE");      // it may be the file that is read
  CLI::App app(
      "Replays a file that ODE_EXT_CAPTURE wrote: collides every pair that was collided then, in "
      "the same poses, and compares the contacts byte for byte.",
      "ode_ext-replay");
  app.footer(
      "The time is that of the calls that collide; meshes are made in the first that meets them.\n"
      "Settings whose contacts depend on passes before are not replayed to the byte:\n"
      "rays=iterative-paper, misprediction=ignore, misprediction=backtrack.\n"
      "Exit codes: 0 the same, 1 different, 2 wrong usage, no capture, nothing to compare or a\n"
      "report that could not be written, 3 no device.");
  Options options;
  app.add_option("file", options.file, "The capture (required)");
  const auto* device = app.add_option("--device", options.device,
                                      "As ODE_EXT_DEVICE: platform:type:name, or an index");
  const auto* config =
      app.add_option("--config", options.config,
                     "In place of the captured one; ode_ext-info --settings")
          ->check([](const std::string& text) {
            return dBatchConfigCheck(text.c_str()) == 0 ? "" : dBatchColliderGetLastErrorMessage();
          });
  app.add_option("--repeat", options.repeat, "Times that each pass is collided; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--partial", options.partial, "Replay what is whole of a capture that was cut off");
  app.set_version_flag("--version", ODE_EXT_VERSION);
  try {
    app.parse(argc, argv);
    if (options.file.empty()) throw CLI::RequiredError("file");
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kExitSame : kExitUsage;
  }
  options.has_device = device->count() > 0;
  options.has_config = config->count() > 0;
  return replay(options);
}
