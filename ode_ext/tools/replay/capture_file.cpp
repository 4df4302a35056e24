// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/capture_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>

namespace ode_ext::replay {

// What is left of a record.
class CaptureFile::Payload {
 public:
  Payload(const CaptureFile& file, const std::vector<unsigned char>& bytes)
      : file_(file), next_(bytes.data()), left_(bytes.size()) {}

  template <class T>
  void take(T* to, std::uint64_t count) {
    if (count > left_ / sizeof(T)) file_.fail("is shorter than what it says it holds");
    if (count == 0) return;
    std::memcpy(to, next_, count * sizeof(T));
    next_ += count * sizeof(T);
    left_ -= count * sizeof(T);
  }
  template <class T>
  std::vector<T> take_list(std::uint64_t count) {
    if (count > left_ / sizeof(T)) file_.fail("is shorter than what it says it holds");
    std::vector<T> list(count);
    take(list.data(), count);
    return list;
  }
  std::string take_text(std::uint64_t length) {
    const std::vector<char> text = take_list<char>(length);
    return {text.begin(), text.end()};
  }
  bool is_empty() const { return left_ == 0; }

 private:
  const CaptureFile& file_;
  const unsigned char* next_;
  std::uint64_t left_;
};

CaptureFile::CaptureFile(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw CaptureError("cannot read '" + path + "': " + std::strerror(errno));
  file_.seekg(0, std::ios::end);
  const std::streamoff end = file_.tellg();
  file_.seekg(0);
  if (end < 0) throw CaptureError("'" + path + "' is not a file that can be read");
  size_ = static_cast<std::uint64_t>(end);
  capture::Header header{};
  if (size_ < sizeof(header.magic)) throw CaptureError("'" + path + "' is not a capture");
  read(header.magic, sizeof(header.magic), "its header");
  if (std::memcmp(header.magic, capture::kMagic, sizeof(header.magic)) != 0)
    throw CaptureError("'" + path + "' is not a capture; ODE_EXT_CAPTURE=FILE makes one");
  read(&header.version, sizeof(header) - sizeof(header.magic), "its header");
  if (header.byte_order != capture::kByteOrder)
    throw CaptureError("'" + path +
                       "' was written on a machine of another byte order; replay it there");
  if (header.version != capture::kVersion)
    throw CaptureError("'" + path + "' is a capture of version " + std::to_string(header.version) +
                       ", and this program reads version " + std::to_string(capture::kVersion) +
                       "; use the ode_ext-replay of the library that wrote it");
}

void CaptureFile::fail(const std::string& what) const {
  throw CaptureError("'" + path_ + "' is damaged: record " + std::to_string(record_) + " " + what);
}

void CaptureFile::read(void* to, std::uint64_t size, const char* what) {
  if (size > size_ - position_)
    throw CaptureTruncated("'" + path_ + "' ends within " + what + ", at byte " +
                           std::to_string(size_));
  file_.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
  if (!file_) throw CaptureError("cannot read '" + path_ + "': " + std::strerror(errno));
  position_ += size;
}

Record CaptureFile::next() {
  while (position_ < size_) {
    ++record_;
    const std::string what = "record " + std::to_string(record_);
    capture::Head head{};
    read(&head, sizeof(head), what.c_str());
    if (head.size > size_ - position_) read(nullptr, head.size, what.c_str());  // truncated
    bytes_.resize(head.size);
    read(bytes_.data(), head.size, what.c_str());
    Payload payload(*this, bytes_);
    Record record;
    switch (head.kind) {
      case capture::kCollider:
        record = collider(payload);
        break;
      case capture::kMesh:
        record = mesh(payload);
        break;
      case capture::kPass:
        record = pass(payload);
        break;
      case capture::kContacts:
        record = contacts(payload);
        break;
      default:
        continue;
    }
    if (!payload.is_empty()) fail("is longer than what it says it holds");
    return record;
  }
  return EndOfCapture{};
}

ColliderRecord CaptureFile::collider(Payload& payload) {
  ColliderRecord record;
  payload.take<capture::Collider>(&record, 1);
  record.config = payload.take_text(record.config_length);
  record.device = payload.take_text(record.device_length);
  record.version = payload.take_text(record.version_length);
  if (record.number != colliders_++) fail("is a collider out of order");
  // What no collider was ever made with.
  if (record.max_contacts < 1 || record.max_contacts > 64 || record.max_contacts_deformable > 64 ||
      !(record.open_thickness == 0 || (record.open_thickness >= std::numeric_limits<float>::min() &&
                                       record.open_thickness <= std::numeric_limits<float>::max())))
    fail("is a collider with settings that there are none of");
  return record;
}

MeshRecord CaptureFile::mesh(Payload& payload) {
  MeshRecord record;
  payload.take<capture::Mesh>(&record, 1);
  record.corners = payload.take_list<float>(std::uint64_t{9} * record.triangles);
  if (record.number != triangles_.size()) fail("is a mesh out of order");
  // ODE takes neither of these.
  if (record.triangles == 0) fail("is a mesh of no triangles");
  if (!std::ranges::all_of(record.corners, [](float x) { return std::isfinite(x); }))
    fail("is a mesh with a corner that is not finite");
  if (record.base != capture::kNoBase) {
    if (record.base >= triangles_.size() || !is_base_[record.base])
      fail("is a shape of a mesh that is not there");
    if (triangles_[record.base] != record.triangles)
      fail("is a shape of a mesh of another number of triangles");
  }
  triangles_.push_back(record.triangles);
  is_base_.push_back(record.deformable != 0 && record.base == capture::kNoBase);
  return record;
}

PassRecord CaptureFile::pass(Payload& payload) {
  PassRecord record;
  payload.take<capture::Pass>(&record, 1);
  record.object_list = payload.take_list<capture::Object>(record.objects);
  record.pair_list = payload.take_list<capture::Pair>(record.pairs);
  if (record.number != pairs_of_passes_.size()) fail("is a pass out of order");
  if (record.collider >= colliders_) fail("is a pass of a collider that is not there");
  for (const capture::Object& object : record.object_list) {
    if (object.mesh >= triangles_.size()) fail("has an object of a mesh that is not there");
    const auto is_finite = [](double x) { return std::isfinite(x); };
    if (!std::ranges::all_of(object.position, is_finite) ||
        !std::ranges::all_of(object.rotation, is_finite))
      fail("has an object whose pose is not finite");
  }
  for (const capture::Pair& pair : record.pair_list)
    if (pair.first >= record.objects || pair.second >= record.objects || pair.first == pair.second)
      fail("has a pair of objects that are not there");
  pairs_of_passes_.push_back(record.pairs);
  return record;
}

ContactsRecord CaptureFile::contacts(Payload& payload) {
  ContactsRecord record;
  payload.take<capture::Contacts>(&record, 1);
  record.counts = payload.take_list<std::uint32_t>(record.pairs);
  record.contact_list = payload.take_list<capture::Contact>(record.contacts);
  if (record.pass >= pairs_of_passes_.size()) fail("has contacts of a pass that is not there");
  if (record.pairs != pairs_of_passes_[record.pass])
    fail("has contacts of another number of pairs than its pass");
  std::uint64_t sum = 0;
  for (const std::uint32_t count : record.counts) sum += count;
  if (sum != record.contacts) fail("has another number of contacts than its pairs have");
  return record;
}

}  // namespace ode_ext::replay
