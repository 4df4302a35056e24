// SPDX-License-Identifier: BSD-3-Clause
// The layout of the files that ODE_EXT_CAPTURE names and ode_ext-replay reads (docs/capture.md): a
// header, then records, each with a head that says how long it is. Numbers are in the byte order of
// the machine that wrote them, which the header tells. No struct has padding.
#pragma once

#include <cstdint>

namespace ode_ext::capture {

inline constexpr char kMagic[8] = {'O', 'D', 'E', 'X', 'T', 'C', 'A', 'P'};
inline constexpr std::uint32_t kVersion = 1;  // another one where an old reader would go wrong
inline constexpr std::uint32_t kByteOrder = 0x01020304;

struct Header {
  char magic[8];
  std::uint32_t version;
  std::uint32_t byte_order;
};

// A reader passes over kinds that it does not know.
enum Kind : std::uint32_t { kCollider = 1, kMesh = 2, kPass = 3, kContacts = 4 };

struct Head {
  std::uint32_t kind;
  std::uint32_t reserved;  // 0
  std::uint64_t size;      // of what follows [bytes]
};

// Followed by the texts: config, device, version of the library. No terminators.
struct Collider {
  std::uint32_t number;  // counted from 0, as are all numbers below
  std::uint32_t max_contacts;
  std::uint32_t max_contacts_deformable;
  std::uint32_t config_length;
  std::uint32_t device_length;
  std::uint32_t version_length;
  double open_thickness;  // [m]
};

inline constexpr std::uint32_t kNoBase = 0xffffffff;

// Followed by the corners of its triangles, local frame [m]: 9 floats a triangle.
struct Mesh {
  std::uint32_t number;
  std::uint32_t base;  // of a shape of a deformable mesh: that mesh as it was built; else kNoBase
  std::uint32_t deformable;
  std::uint32_t triangles;
};

// Followed by its objects, in the order of their handles, and its pairs. Written before the device
// is given the pass, so that a pass that ends the program is in the file.
struct Pass {
  std::uint32_t number;
  std::uint32_t collider;
  std::uint32_t objects;
  std::uint32_t pairs;
};

// world = rotation * local + position, as ODE has it; row-major.
struct Object {
  std::uint32_t mesh;
  std::uint32_t reserved;  // 0
  double position[3];      // [m]
  double rotation[9];
};

struct Pair {
  std::uint32_t first, second;  // objects of the pass
};

// Followed by the number of contacts of each pair (32 bits each), and all contacts.
struct Contacts {
  std::uint32_t pass;
  std::uint32_t pairs;
  std::uint64_t contacts;
};

// As dCollide(first, second) gives it.
struct Contact {
  double position[3];  // world frame [m]
  double normal[3];
  double depth;  // [m]
  std::int32_t side1, side2;
};

}  // namespace ode_ext::capture
