// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

namespace ode_ext::test {

// What ODE's message handler is given.
class Messages {
 public:
  Messages() {
    said_.clear();
    dSetMessageHandler([](int, const char* format, va_list arguments) {
      char text[1024];
      std::vsnprintf(text, sizeof text, format, arguments);
      said_.emplace_back(text);
    });
  }
  ~Messages() { dSetMessageHandler(nullptr); }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;
  const std::vector<std::string>& said() const { return said_; }

 private:
  static inline std::vector<std::string> said_;
};

}  // namespace ode_ext::test
