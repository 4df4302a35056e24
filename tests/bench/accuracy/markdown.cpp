// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/markdown.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace ode_ext::accuracy {
namespace {

// Three digits or so.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", value < 10 ? 2 : value < 100 ? 1 : 0, value);
  return text;
}

std::string both(const nlohmann::json& one, const nlohmann::json& other, const char* key) {
  return number(one.at(key)) + " / " + number(other.at(key));
}

std::string heading(double share) {
  char text[512];
  std::snprintf(text, sizeof text,
                "\n%g %% of the smaller size deep:\n\n"
                "| g1 on g2 | no contact [%%] | depth off [%%], 99th percentile | worst "
                "| angle off [degrees], 99th percentile | worst "
                "| contacts per pair |\n"
                "|---|---|---|---|---|---|---|\n",
                100 * share);
  return text;
}

}  // namespace

std::string markdown_of(const nlohmann::json& ode_ext, const nlohmann::json& stock) {
  std::string text = "The deepest contact against the truth, ode_ext / stock ODE; " +
                     std::to_string(ode_ext.at(0).at("pairs").get<int>()) + " pairs a row.\n";
  double share = -1;
  for (std::size_t i = 0; i < ode_ext.size(); ++i) {
    const auto &one = ode_ext[i], &other = stock[i];
    if (one.at("share") != share) {
      share = one.at("share");
      text += heading(share);
    }
    text += "| " + one.at("pair").get<std::string>();
    for (const char* key :
         {"none", "depth_99", "depth_worst", "angle_99", "angle_worst", "contacts"})
      text += " | " + both(one, other, key);
    text += " |\n";
  }
  return text;
}

std::string with_table(const std::string& page, const std::string& table) {
  const auto begin = page.find(kBeginMarker);
  const auto end = page.find(kEndMarker, begin == std::string::npos ? 0 : begin);
  if (begin == std::string::npos || end == std::string::npos)
    throw std::runtime_error(std::string("the page lacks '") + kBeginMarker + "' or '" +
                             kEndMarker + "' after it");
  return page.substr(0, begin) + kBeginMarker + "\n" + table + page.substr(end);
}

void write_table(const std::string& path, const std::string& table) {
  std::string page = std::string(kBeginMarker) + "\n" + kEndMarker + "\n";
  if (std::ifstream old(path); old)
    page = {std::istreambuf_iterator<char>(old), std::istreambuf_iterator<char>()};
  const std::string text = with_table(page, table);
  std::ofstream file(path);
  if (!(file << text << std::flush)) throw std::runtime_error("cannot write " + path);
}

}  // namespace ode_ext::accuracy
