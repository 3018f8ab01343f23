// The one exception of the core.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "gazelle/export.hpp"

namespace gazelle {

// What went wrong, in words; `kind` is the Python class that said so, such as
// "ServiceUnavailableError" or "IllegalNameError", empty where C++ did.
struct GAZELLE_EXPORT Error : std::runtime_error {
  explicit Error(const std::string& text, std::string error_kind = "")
      : std::runtime_error(text), kind(std::move(error_kind)) {}
  std::string kind;
};

}  // namespace gazelle
