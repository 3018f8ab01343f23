// The one exception of the core.
#pragma once

#include <stdexcept>
#include <string>

namespace gazelle {

// What went wrong, in words; `kind` is the Python class that said so, such as
// "ServiceUnavailableError" or "IllegalNameError", empty where C++ did.
struct Error : std::runtime_error {
  explicit Error(const std::string &text, std::string error_kind = "")
      : std::runtime_error(text), kind(std::move(error_kind)) {}
  std::string kind;
};

}  // namespace gazelle
