// SPDX-License-Identifier: BSD-3-Clause
// What the trials print and write: tables, targets, and all of it as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace ode_ext::stability {

// A line of a table: an object whose keys are the columns. Numbers are printed to four digits; the
// JSON file has all of them.
using Row = nlohmann::ordered_json;

class Report {
 public:
  explicit Report(std::ostream& out) : out_(out) {}

  // What holds for the tables that follow.
  void note(const std::string& text) { out_ << '\n' << text << '\n'; }
  // All rows have the same keys.
  void table(const std::string& title, const std::vector<Row>& rows);
  // What the contacts should achieve; --check fails where one is not met.
  void target(const std::string& what, bool met);

  bool all_met() const { return all_met_; }
  // Throws std::runtime_error if the file cannot be written.
  void write(const std::string& path) const;

 private:
  std::ostream& out_;
  bool all_met_ = true;
  nlohmann::ordered_json document_ = {{"tables", nlohmann::ordered_json::array()},
                                      {"targets", nlohmann::ordered_json::array()}};
};

}  // namespace ode_ext::stability
