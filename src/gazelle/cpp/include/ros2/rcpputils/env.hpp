#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace rcpputils {

inline std::string get_env_var(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

inline bool set_env_var(const char* name, const char* value) {
  const int failed = value ? setenv(name, value, 1) : unsetenv(name);
  if (failed) throw std::runtime_error(std::string("cannot set the variable ") + name);
  return true;
}

}  // namespace rcpputils
