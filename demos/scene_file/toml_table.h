// SPDX-License-Identifier: BSD-3-Clause
// A table of a TOML file whose keys are ticked off as they are read: one that nobody knows is an
// error, with the file and the line (SceneFileError).
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshes/triangle_mesh.h"
#include "scene_file/scene_file.h"

namespace falling_objects {

struct Bounds {
  double least = -1e9, most = 1e9;
};
inline constexpr Bounds kPositive{1e-9, 1e9}, kNotNegative{0, 1e9}, kShare{0, 1};

class TomlTable {
 public:
  // `name` is how the table is called in messages.
  TomlTable(const toml::table& table, std::string file, std::string name);

  bool has(const char* key) const { return table_.contains(key); }
  std::string text(const char* key);
  std::string text(const char* key, const std::string& fallback);
  // One of `values`, which the message lists.
  std::string choice(const char* key, const std::string& fallback,
                     const std::vector<std::string>& values);
  bool flag(const char* key, bool fallback);
  double number(const char* key, double fallback, Bounds bounds = {});
  double number(const char* key);  // must be there
  std::optional<double> optional_number(const char* key, Bounds bounds);
  int whole(const char* key, int fallback, int least, int most);
  Point point(const char* key, const Point& fallback);
  Point point(const char* key);
  std::vector<double> numbers(const char* key, std::size_t count);
  std::optional<std::vector<double>> optional_numbers(const char* key, std::size_t count);
  std::vector<std::string> texts(const char* key);
  // Absent: empty.
  std::optional<TomlTable> table(const char* key);
  std::vector<TomlTable> tables(const char* key);                                // [[key]]
  std::vector<std::pair<std::string, TomlTable>> named_tables(const char* key);  // [key.name]

  // To be called when all is read: a key that nobody asked for is an error.
  void finish() const;
  [[noreturn]] void fail(const std::string& sentence) const;
  [[noreturn]] void fail(const char* key, const std::string& sentence) const;

 private:
  const toml::node* find(const char* key);
  const toml::node& need(const char* key);
  [[noreturn]] void fail_at(const toml::node& node, const std::string& sentence) const;

  const toml::table& table_;
  std::string file_, name_;
  std::vector<std::string> known_;
};

// "a, b, c".
std::string list(const std::vector<std::string>& values);

}  // namespace falling_objects
