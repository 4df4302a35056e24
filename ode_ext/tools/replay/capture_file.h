// SPDX-License-Identifier: BSD-3-Clause
// Reads a capture (docs/capture.md) record by record. Nothing in the file is trusted: lengths and
// numbers are checked before they are used, and what is wrong throws CaptureError with a sentence.
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "ode/capture_format.h"

namespace ode_ext::replay {

class CaptureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The file ends within a record: the program that wrote it was stopped there, or the file was cut.
class CaptureTruncated : public CaptureError {
 public:
  using CaptureError::CaptureError;
};

struct ColliderRecord : capture::Collider {
  std::string config, device, version;
};

struct MeshRecord : capture::Mesh {
  std::vector<float> corners;  // 9 a triangle [m]
};

struct PassRecord : capture::Pass {
  std::vector<capture::Object> object_list;
  std::vector<capture::Pair> pair_list;
};

struct ContactsRecord : capture::Contacts {
  std::vector<std::uint32_t> counts;  // a pair
  std::vector<capture::Contact> contact_list;
};

struct EndOfCapture {};

using Record = std::variant<EndOfCapture, ColliderRecord, MeshRecord, PassRecord, ContactsRecord>;

class CaptureFile {
 public:
  explicit CaptureFile(const std::string& path);
  // The next record of a kind that is known here. That it fits those before is checked too.
  Record next();

 private:
  class Payload;
  [[noreturn]] void fail(const std::string& what) const;
  void read(void* to, std::uint64_t size, const char* what);
  ColliderRecord collider(Payload& payload);
  MeshRecord mesh(Payload& payload);
  PassRecord pass(Payload& payload);
  ContactsRecord contacts(Payload& payload);

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0, position_ = 0;  // [bytes]
  std::uint64_t record_ = 0;               // counted from 1
  std::vector<unsigned char> bytes_;       // of the record
  std::uint32_t colliders_ = 0;
  std::vector<std::uint32_t> triangles_;        // of each mesh so far
  std::vector<bool> is_base_;                   // whether it may have shapes
  std::vector<std::uint32_t> pairs_of_passes_;  // of each pass so far
};

}  // namespace ode_ext::replay
