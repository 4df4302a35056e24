// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stability/report.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <stdexcept>

namespace ode_ext::stability {
namespace {

std::string text_of(const Row& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number_float()) return value.dump();
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value.get<double>());
  return text;
}

}  // namespace

void Report::table(const std::string& title, const std::vector<Row>& rows) {
  document_["tables"].push_back({{"title", title}, {"rows", rows}});
  out_ << '\n' << title << '\n';
  if (rows.empty()) return;
  std::vector<std::size_t> widths;
  for (const auto& [key, value] : rows.front().items()) {
    std::size_t width = key.size();
    for (const Row& row : rows) width = std::max(width, text_of(row.at(key)).size());
    widths.push_back(width);
  }
  const auto print = [&](const Row& row, bool header) {
    std::size_t column = 0;
    for (const auto& [key, value] : row.items()) {
      out_ << "  " << std::setw(static_cast<int>(widths[column++]))
           << (header ? key : text_of(value));
    }
    out_ << '\n';
  };
  print(rows.front(), true);
  for (const Row& row : rows) print(row, false);
  out_.flush();
}

void Report::target(const std::string& what, bool met) {
  document_["targets"].push_back({{"target", what}, {"met", met}});
  out_ << (met ? "  met:    " : "  MISSED: ") << what << '\n';
  all_met_ = all_met_ && met;
}

void Report::write(const std::string& path) const {
  std::ofstream file(path);
  file << document_.dump(1) << '\n';
  file.close();
  if (!file) throw std::runtime_error("cannot write '" + path + "'");
}

}  // namespace ode_ext::stability
