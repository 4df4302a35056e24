// SPDX-License-Identifier: BSD-3-Clause
// Files that a run writes. What cannot be written is refused before the run, which may take hours.
#pragma once

#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace falling_objects {

// Why no file of that name can be written, or "". A folder that is not there is no reason: it is
// made.
std::string why_not_written(const std::string& path);

// Of a file's name: "", or that it must have one of these endings.
std::function<std::string(const std::string&)> ends_in(const std::vector<std::string>& endings);

// An empty file, and its folder. Throws UsageError.
std::ofstream open_output(const std::string& path);

}  // namespace falling_objects
