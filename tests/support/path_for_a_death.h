// SPDX-License-Identifier: BSD-3-Clause
// A file that a process writes which a death test starts, and this one reads.
#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include "support/temporary_folder.h"

namespace ode_ext::test {

// In a folder of this process's own, gone with this object. A death test of the style "threadsafe"
// runs its test once more, in a new process: there it is the file of the process that waits.
class PathForADeath {
 public:
  explicit PathForADeath(const std::string& name) {
    if (const char* given = std::getenv(kVariable)) {
      name_ = given;
      return;
    }
    folder_ = std::make_unique<TemporaryFolder>(name);
    name_ = *folder_ / name;
    setenv(kVariable, name_.c_str(), 1);
  }
  ~PathForADeath() {
    if (folder_ != nullptr) unsetenv(kVariable);
  }
  PathForADeath(const PathForADeath&) = delete;
  PathForADeath& operator=(const PathForADeath&) = delete;

  const std::string& name() const { return name_; }

 private:
  static constexpr const char* kVariable = "ODE_EXT_TEST_PATH_FOR_A_DEATH";
  std::unique_ptr<TemporaryFolder> folder_;
  std::string name_;
};

}  // namespace ode_ext::test
