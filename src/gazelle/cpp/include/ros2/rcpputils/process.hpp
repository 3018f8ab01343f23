#pragma once

#include <fstream>
#include <string>

namespace rcpputils {

inline std::string get_executable_name() {
  std::string name;
  std::getline(std::ifstream("/proc/self/comm") >> std::ws, name);
  return name;
}

}  // namespace rcpputils
