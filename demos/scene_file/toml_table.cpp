// SPDX-License-Identifier: BSD-3-Clause
#include "scene_file/toml_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

namespace falling_objects {
namespace {

// Of places, speeds and accelerations: beyond, their squares soon are no numbers.
constexpr double kFarthest = 1e9;

std::string short_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

std::string list(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return text;
}

TomlTable::TomlTable(const toml::table& table, std::string file, std::string name)
    : table_(table), file_(std::move(file)), name_(std::move(name)) {}

void TomlTable::fail_at(const toml::node& node, const std::string& sentence) const {
  throw SceneFileError(file_ + ':' + std::to_string(node.source().begin.line) + ": " + sentence);
}

void TomlTable::fail(const std::string& sentence) const { fail_at(table_, sentence); }

void TomlTable::fail(const char* key, const std::string& sentence) const {
  const toml::node* node = table_.get(key);
  fail_at(node != nullptr ? *node : table_, sentence);
}

const toml::node* TomlTable::find(const char* key) {
  known_.emplace_back(key);
  return table_.get(key);
}

const toml::node& TomlTable::need(const char* key) {
  const toml::node* node = find(key);
  if (node == nullptr) fail(name_ + " needs '" + key + "'");
  return *node;
}

std::string TomlTable::text(const char* key) {
  const toml::node& node = need(key);
  const auto value = node.value_exact<std::string>();
  if (!value) fail_at(node, std::string("'") + key + "' must be text in quotes");
  return *value;
}

std::string TomlTable::text(const char* key, const std::string& fallback) {
  return find(key) == nullptr ? fallback : text(key);
}

std::string TomlTable::choice(const char* key, const std::string& fallback,
                              const std::vector<std::string>& values) {
  const std::string value = text(key, fallback);
  if (std::find(values.begin(), values.end(), value) == values.end()) {
    fail(key, std::string("'") + key + "' is '" + value + "', expected one of " + list(values));
  }
  return value;
}

bool TomlTable::flag(const char* key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const auto value = node->value_exact<bool>();
  if (!value) fail_at(*node, std::string("'") + key + "' must be true or false");
  return *value;
}

double TomlTable::number(const char* key, double fallback, Bounds bounds) {
  return optional_number(key, bounds).value_or(fallback);
}

double TomlTable::number(const char* key) {
  need(key);
  return number(key, 0);
}

std::optional<double> TomlTable::optional_number(const char* key, Bounds bounds) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !(*value >= bounds.least && *value <= bounds.most)) {
    fail_at(*node, std::string("'") + key + "' must be a number from " +
                       short_number(bounds.least) + " to " + short_number(bounds.most));
  }
  return value;
}

int TomlTable::whole(const char* key, int fallback, int least, int most) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const auto value = node->value_exact<std::int64_t>();
  if (!value || *value < least || *value > most) {
    fail_at(*node, std::string("'") + key + "' must be a whole number from " +
                       std::to_string(least) + " to " + std::to_string(most));
  }
  return static_cast<int>(*value);
}

std::vector<double> TomlTable::numbers(const char* key, std::size_t count) {
  const toml::node& node = need(key);
  const toml::array* array = node.as_array();
  std::vector<double> result;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const toml::node& element = *array->get(i);
    const auto value = element.is_number() ? element.value<double>() : std::nullopt;
    if (value && std::isfinite(*value)) result.push_back(*value);
  }
  if (array == nullptr || array->size() != count || result.size() != count) {
    fail_at(node,
            std::string("'") + key + "' must be " + std::to_string(count) + " numbers in brackets");
  }
  return result;
}

std::optional<std::vector<double>> TomlTable::optional_numbers(const char* key, std::size_t count) {
  if (find(key) == nullptr) return std::nullopt;
  return numbers(key, count);
}

Point TomlTable::point(const char* key) {
  const std::vector<double> v = numbers(key, 3);
  for (const double x : v) {
    if (std::abs(x) > kFarthest) {
      fail(key, std::string("'") + key + "' must not be beyond " + short_number(kFarthest));
    }
  }
  return {v[0], v[1], v[2]};
}

Point TomlTable::point(const char* key, const Point& fallback) {
  return find(key) == nullptr ? fallback : point(key);
}

std::vector<std::string> TomlTable::texts(const char* key) {
  const toml::node& node = need(key);
  const toml::array* array = node.as_array();
  std::vector<std::string> result;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    if (const auto value = array->get(i)->value_exact<std::string>()) result.push_back(*value);
  }
  if (array == nullptr || array->empty() || result.size() != array->size()) {
    fail_at(node, std::string("'") + key + "' must be texts in brackets");
  }
  return result;
}

std::optional<TomlTable> TomlTable::table(const char* key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) fail_at(*node, std::string("'") + key + "' must be a table");
  return TomlTable(*node->as_table(), file_, std::string("[") + key + "]");
}

std::vector<TomlTable> TomlTable::tables(const char* key) {
  const toml::node* node = find(key);
  std::vector<TomlTable> result;
  if (node == nullptr) return result;
  const std::string name = std::string("[[") + key + "]]";
  const toml::array* array = node->as_array();
  if (array == nullptr) fail_at(*node, std::string("'") + key + "' must be tables, as " + name);
  for (const toml::node& element : *array) {
    if (!element.is_table()) {
      fail_at(element, std::string("'") + key + "' must be tables, as " + name);
    }
    result.emplace_back(*element.as_table(), file_, name);
  }
  return result;
}

std::vector<std::pair<std::string, TomlTable>> TomlTable::named_tables(const char* key) {
  std::vector<std::pair<std::string, TomlTable>> result;
  const toml::node* node = find(key);
  if (node == nullptr) return result;
  const std::string form = std::string("[") + key + ".NAME]";
  if (!node->is_table()) fail_at(*node, std::string("'") + key + "' must be tables, as " + form);
  for (const auto& [name, element] : *node->as_table()) {
    const std::string_view text = name.str();
    if (!element.is_table())
      fail_at(element, std::string("'") + key + "' must be tables, as " + form);
    result.emplace_back(std::string(text),
                        TomlTable(*element.as_table(), file_,
                                  std::string("[") + key + '.' + std::string(text) + "]"));
  }
  return result;
}

void TomlTable::finish() const {
  for (const auto& [key, node] : table_) {
    const std::string_view name = key.str();
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    std::vector<std::string> sorted = known_;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    fail_at(node, name_ + " knows no '" + std::string(name) + "', only " + list(sorted));
  }
}

}  // namespace falling_objects
