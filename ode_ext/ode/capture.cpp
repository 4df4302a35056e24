// SPDX-License-Identifier: BSD-3-Clause
#include "ode/capture.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ode/capture_format.h"
#include "ode/messages.h"
#include "ode/output_of_environment.h"
#include "opencl/fork_guard.h"

namespace ode_ext {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

// One file, into which the colliders of all threads write their records one by one.
class CaptureFile {
 public:
  explicit CaptureFile(std::FILE* file) : file_(file) {
    capture::Header header{{}, capture::kVersion, capture::kByteOrder};
    std::memcpy(header.magic, capture::kMagic, sizeof(header.magic));
    std::fwrite(&header, sizeof(header), 1, file_.get());
    std::fflush(file_.get());
  }

  void collider(const void* address, const dBatchColliderParams& params,
                const std::string& device) {
    const std::string config = params.config == nullptr ? "" : params.config;
    const std::string version = ODE_EXT_VERSION;
    capture::Collider record{
        .number = next_collider_++,
        .max_contacts = static_cast<std::uint32_t>(params.max_contacts),
        .max_contacts_deformable = static_cast<std::uint32_t>(params.max_contacts_deformable),
        .config_length = static_cast<std::uint32_t>(config.size()),
        .device_length = static_cast<std::uint32_t>(device.size()),
        .version_length = static_cast<std::uint32_t>(version.size()),
        .open_thickness = params.open_thickness};
    colliders_[address] = record.number;
    put(record);
    for (const std::string& text : {config, device, version}) put(text.data(), text.size());
    end_record(capture::kCollider);
  }

  // Nothing of a collider that was made before the file, and is not in it.
  std::optional<std::uint32_t> pass(const void* collider,
                                    std::span<const PairMember* const> members,
                                    std::span<const std::array<std::uint32_t, 2>> pairs) {
    const auto known = colliders_.find(collider);
    if (known == colliders_.end()) return std::nullopt;
    std::vector<std::uint32_t> mesh_of(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) mesh_of[i] = mesh(*members[i]->mesh);

    // By handles, by which two copies at one pose are told apart.
    std::vector<std::uint32_t> by_handle(members.size()), place(members.size());
    std::iota(by_handle.begin(), by_handle.end(), 0u);
    std::ranges::sort(by_handle, std::less<>(), [&](std::uint32_t i) { return members[i]->geom; });
    for (std::size_t i = 0; i < by_handle.size(); ++i)
      place[by_handle[i]] = static_cast<std::uint32_t>(i);

    const capture::Pass record{next_pass_++, known->second,
                               static_cast<std::uint32_t>(members.size()),
                               static_cast<std::uint32_t>(pairs.size())};
    put(record);
    for (const std::uint32_t i : by_handle) put(object(*members[i], mesh_of[i]));
    for (const auto& [first, second] : pairs) put(capture::Pair{place[first], place[second]});
    end_record(capture::kPass);
    return record.number;
  }

  void contacts(std::uint32_t pass, const PairContacts& found) {
    std::uint64_t count = 0;
    for (const PairContacts::Range& range : found.ranges) count += range.count;
    put(capture::Contacts{pass, static_cast<std::uint32_t>(found.ranges.size()), count});
    for (const PairContacts::Range& range : found.ranges) put(range.count);
    for (const PairContacts::Range& range : found.ranges)
      for (std::size_t i = 0; i < range.count; ++i) put(contact(found.contacts[range.first + i]));
    end_record(capture::kContacts);
  }

  bool failed() const { return std::ferror(file_.get()) != 0; }

 private:
  std::uint32_t mesh(const Mesh& mesh) {
    const SourceTriangles& built = mesh.topology->source;
    std::uint32_t base = capture::kNoBase;
    if (mesh.deformable && mesh.finite && compare_soups(mesh.source, built) != 0) {
      const std::uint64_t hash = hash_soup(built);
      base = number_of(built, hash, hash, base, true);
    }
    return number_of(mesh.source, mesh.content_hash, mesh.shape_hash, base, mesh.deformable);
  }

  // Content that was written before has a number already. Two hashes are taken for it: a mesh that
  // is forged to have both of another is not worth keeping every mesh.
  std::uint32_t number_of(const SourceTriangles& source, std::uint64_t hash,
                          std::uint64_t shape_hash, std::uint32_t base, bool deformable) {
    const auto [known, is_new] =
        meshes_.try_emplace({hash, shape_hash, source.size(), base, deformable},
                            static_cast<std::uint32_t>(meshes_.size()));
    if (!is_new) return known->second;
    put(capture::Mesh{known->second, base, deformable ? 1u : 0u,
                      static_cast<std::uint32_t>(source.size() / 3)});
    for (std::size_t i = 0; i < source.size(); ++i) put(source[i]);
    end_record(capture::kMesh);
    return known->second;
  }

  static capture::Object object(const PairMember& member, std::uint32_t mesh) {
    const Vec3d& at = member.given.position;
    capture::Object object{mesh, 0, {at.x, at.y, at.z}, {}};
    std::ranges::copy(member.given.rotation, object.rotation);
    return object;
  }

  static capture::Contact contact(const Contact& c) {
    return {{c.position.x, c.position.y, c.position.z},
            {c.normal.x, c.normal.y, c.normal.z},
            c.depth,
            static_cast<std::int32_t>(c.triangles[0]),
            static_cast<std::int32_t>(c.triangles[1])};
  }

  void put(const void* bytes, std::size_t size) {
    const auto* first = static_cast<const unsigned char*>(bytes);
    record_.insert(record_.end(), first, first + size);
  }
  template <class T>
  void put(const T& value) {
    put(&value, sizeof(value));
  }

  // Flushed, so that the file has what was given to the device when a program is lost there, and a
  // forked child has nothing of it.
  void end_record(std::uint32_t kind) {
    const capture::Head head{kind, 0, record_.size()};
    std::fwrite(&head, sizeof(head), 1, file_.get());
    std::fwrite(record_.data(), 1, record_.size(), file_.get());
    std::fflush(file_.get());
    record_.clear();
  }

  std::unique_ptr<std::FILE, CloseFile> file_;
  std::vector<unsigned char> record_;  // that is being written
  std::unordered_map<const void*, std::uint32_t> colliders_;
  using Content = std::tuple<std::uint64_t, std::uint64_t, std::size_t, std::uint32_t, bool>;
  std::map<Content, std::uint32_t> meshes_;
  std::uint32_t next_collider_ = 0;
  std::uint32_t next_pass_ = 0;
};

std::mutex capture_mutex;
CaptureFile* file = nullptr;
bool is_opened = false;  // and is not again, whatever became of it: that would erase what it has
std::atomic<bool> capturing{false};

// Calls write(file). A file that cannot be written any more, of a full disk for instance, is left;
// so it is where memory is short, which is no reason to lose contacts.
template <class Write>
void write_record(Write write) {
  if (!capturing.load(std::memory_order_relaxed)) return;
  std::string reason;
  {
    const std::lock_guard lock(capture_mutex);
    if (file == nullptr) return;
    try {
      write(*file);
      if (!file->failed()) return;
      reason = std::strerror(errno);
    } catch (const std::bad_alloc&) {
      reason = "memory is short";
    }
    capturing = false;
    delete std::exchange(file, nullptr);
  }
  // Under no lock: the program's message handler may collide.
  log(LogLevel::kError, "the file that ODE_EXT_CAPTURE names cannot be written any more: " +
                            reason + "; the capture ends here");
}

// At the end of the program, in which threads may still make passes.
struct CloseCapture {
  ~CloseCapture() {
    if (is_lost_by_fork()) return;
    const std::lock_guard lock(capture_mutex);
    capturing = false;
    delete std::exchange(file, nullptr);
  }
} close_capture;

}  // namespace

void open_capture_of_environment() {
  const HeldMessages held;
  const std::lock_guard lock(capture_mutex);
  if (is_opened) return;
  std::FILE* opened = open_output_of_environment("ODE_EXT_CAPTURE");
  if (opened == nullptr) return;
  file = new CaptureFile(opened);
  is_opened = capturing = true;
}

void capture_collider(const void* collider, const dBatchColliderParams& params,
                      const std::string& device) {
  write_record([&](CaptureFile& to) { to.collider(collider, params, device); });
}

std::optional<std::uint32_t> capture_pass(const void* collider,
                                          std::span<const PairMember* const> members,
                                          std::span<const std::array<std::uint32_t, 2>> pairs) {
  std::optional<std::uint32_t> number;
  if (!pairs.empty())
    write_record([&](CaptureFile& to) { number = to.pass(collider, members, pairs); });
  return number;
}

void capture_contacts(std::optional<std::uint32_t> pass, const PairContacts& found) {
  if (pass) write_record([&](CaptureFile& to) { to.contacts(*pass, found); });
}

}  // namespace ode_ext
