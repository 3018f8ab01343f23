#pragma once

#include <map>
#include <string>

#include "gazelle/core.hpp"

namespace ament_index_cpp {

inline std::map<std::string, std::string> get_packages_with_prefixes() {
  std::map<std::string, std::string> found;
  const gazelle::Json answer = gazelle::call("ament/packages");
  for (const auto& member : answer.members()) found[member.first] = member.second.as_string();
  return found;
}

}  // namespace ament_index_cpp
