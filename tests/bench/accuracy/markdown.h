// SPDX-License-Identifier: BSD-3-Clause
// The accuracy table as Markdown, in a file of its own or between two markers of a page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ode_ext::accuracy {

inline constexpr const char* kBeginMarker = "<!-- contact_accuracy table: begin -->";
inline constexpr const char* kEndMarker = "<!-- contact_accuracy table: end -->";

// A table for each share of penetration; each cell is "ode_ext / stock ODE".
std::string markdown_of(const nlohmann::json& ode_ext, const nlohmann::json& stock);

// `page` with what is between the markers replaced. Throws where one of them is missing.
std::string with_table(const std::string& page, const std::string& table);

// A file that exists keeps all but what is between its markers.
void write_table(const std::string& path, const std::string& table);

}  // namespace ode_ext::accuracy
