#pragma once

#include <cstdlib>
#include <string>

namespace ros {

/// Reads a variable of the environment; false where it is not set.
inline bool get_environment_variable(std::string& value, const char* name) {
  const char* found = std::getenv(name);
  if (!found) {
    value.clear();
    return false;
  }
  value = found;
  return true;
}

}  // namespace ros
